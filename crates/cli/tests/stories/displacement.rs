//! `remesh --displacement` and `decode`: there and back.

use super::Story;
use mesh_core::TriMesh;
use mesh_io::{Array, Numbers, read_arrays, write_arrays};
use std::path::Path;
use std::process::Command;

fn mesh(story: &Story, name: &str) -> TriMesh {
    let soup = mesh_io::read(&story.path(name)).unwrap().soup;
    TriMesh::new(soup.positions, soup.triangles).unwrap()
}

/// The greatest distance of two vertices of the same number, in parts of the diagonal.
fn off(story: &Story, a: &str, b: &str) -> f64 {
    let [a, b] = [a, b].map(|name| mesh(story, name));
    assert_eq!(a.face_arrays(), b.face_arrays());
    let distances = a.positions().iter().zip(b.positions().iter()).map(|(p, q)| p.distance(*q));
    distances.fold(0.0, f64::max) / a.diagonal()
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn a_result_comes_back_from_its_displacement() {
    let story = Story::new();
    let line = "--base-vertices 80 --levels 3 --displacement d";
    for input in ["part.obj", "blob_small.obj", "plane.off", "tap_small.obj"] {
        let report = story.json(&format!("remesh @{input} -o out.obj {line} --json"));
        story.done("decode d -o back.obj");
        assert!(off(&story, "out.obj", "back.obj") < 1e-12, "{input}");
        story.done("decode d -o rough.obj --no-residual");
        let displacement = &report["displacement"];
        let said = number(&displacement["error_without_residual"]["max"]);
        let rough = off(&story, "out.obj", "rough.obj");
        assert!((rough - said).abs() < 1e-9 && said < 0.25, "{input}: {rough}, said {said}");
        assert!(number(&displacement["error_with_residual"]["max"]) < 1e-12, "{input}");
        assert_eq!(displacement["levels"].as_array().map(Vec::len), Some(3));
        let written: serde_json::Value = serde_json::from_slice(&story.bytes("d/displacement.json")).unwrap();
        assert_eq!(written, *displacement);
        story.done("check back.obj --levels 3");
    }
    let folder = std::fs::read_dir(story.path("d")).unwrap();
    assert_eq!(folder.count(), 4);
}

#[test]
fn numpy_decodes_the_same() {
    let story = Story::new();
    let Some(python) = super::outputs::python() else {
        eprintln!("skipped: there is no python3 with numpy (SEMIREG_PYTHON names one)");
        return;
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/examples/displacement.py");
    for (input, bits) in [("part.obj", ""), ("plane.off", ""), ("blob_small.obj", " --displacement-bits 10")] {
        story.done(&format!("remesh @{input} -o out.obj --base-vertices 60 --displacement d{bits}"));
        for (residual, option) in [("", "with-residual"), (" --no-residual", "without-residual")] {
            let output = Command::new(&python).arg(&script).args([story.path("d"), story.path("py.obj")]).arg(option).output();
            let output = output.unwrap();
            assert!(output.status.success(), "{input}: {}", String::from_utf8_lossy(&output.stderr));
            story.done(&format!("decode d -o back.obj{residual}"));
            assert!(off(&story, "py.obj", "back.obj") < 1e-12, "{input}, {option}");
        }
    }
}

#[test]
fn every_level_is_decoded_and_every_format_written() {
    let story = Story::new();
    let line = "remesh @cube.obj -o out.obj --base-vertices 50 --all-levels --order subdivnet --displacement d";
    story.done(line);
    story.done("remesh @cube.obj -o ours.obj --base-vertices 50 --all-levels");
    for level in 0..3 {
        story.done(&format!("decode d -o back.ply --level {level}"));
        assert!(off(&story, &format!("ours.{level}.obj"), "back.ply") < 1e-12, "level {level}");
    }
    assert!(story.done("decode d -o - --format off -q").starts_with("OFF\n"));
    let decoded = story.json("decode d -o back.glb --level 1 --json");
    assert_eq!((&decoded["level"], &decoded["finest_level"]), (&1.into(), &2.into()));
    // Up to the level that is written.
    story.done("remesh @cube.obj -o one.obj --base-vertices 50 --level 1 --displacement one");
    assert_eq!(story.json("decode one -o back.obj --json")["finest_level"], 1);
    assert!(off(&story, "one.obj", "back.obj") < 1e-12);
    let ended = story.run("decode one -o back.obj --level 2");
    assert!(ended.code == Some(2) && ended.stderr.contains("above the finest level, 1"), "{}", ended.stderr);
}

#[test]
fn quantised_displacements_are_smaller_and_less_exact() {
    let story = Story::new();
    let line = "remesh @blob_small.obj -o out.obj --base-vertices 80 --levels 3";
    let mut last = 1.0;
    for bits in [6, 12, 20] {
        let report = story.json(&format!("{line} --displacement d --displacement-bits {bits} --json"));
        story.done("decode d -o back.obj");
        let off = off(&story, "out.obj", "back.obj");
        let displacement = &report["displacement"];
        assert_eq!(displacement["bits"], bits);
        assert!((number(&displacement["error_with_residual"]["max"]) - off).abs() < 1e-12);
        assert!(off < last / 16.0, "{bits} bits: {off} after {last}");
        last = off;
    }
    assert!(last < 1e-6, "{last}");
    let quantised = story.bytes("d/displacement.npz").len();
    story.done(&format!("{line} --displacement exact"));
    assert!(quantised < story.bytes("exact/displacement.npz").len() * 2 / 3);
    let ended = story.run("remesh @cube.obj -o o.obj --displacement-bits 8");
    assert!(ended.code == Some(2) && ended.stderr.contains("--displacement"), "{}", ended.stderr);
}

#[test]
fn the_report_has_the_sizes_of_all_levels() {
    let story = Story::new();
    let line = "remesh @blob_small.obj -o out.obj --base-vertices 80 --displacement d";
    let said = story.verbose(line).stdout;
    for part in ["displacement 1    ", "displacement 2    ", "tangential residual RMS", "decoded           within "] {
        assert!(said.contains(part), "{part} is not in\n{said}");
    }
    let summary = story.done(line);
    assert!(summary.contains("displacement      RMS ") && summary.lines().count() <= 10, "{summary}");
}

#[test]
fn variants_have_folders_of_their_own() {
    let story = Story::new();
    story.done("remesh @blob_small.obj -o o.obj --base-vertices 80 --levels 1 --variants 2 --displacement d");
    assert_eq!(story.files(), ["d-0", "d-1", "o-0.obj", "o-1.obj"]);
    for seed in 0..2 {
        story.done(&format!("decode d-{seed} -o back.obj"));
        assert!(off(&story, &format!("o-{seed}.obj"), "back.obj") < 1e-12);
    }
}

/// A cube has eight corners and twelve creases; the base mesh as usda and glb says so.
#[test]
fn the_base_mesh_says_what_stays_sharp() {
    let story = Story::new();
    story.done("remesh @cube.obj -o out.obj --base-vertices 50 --displacement d");
    let text = String::from_utf8(story.bytes("d/base.usda")).unwrap();
    let list = |name: &str| -> Vec<usize> {
        let line = text.lines().find_map(|line| line.trim().strip_prefix(name)?.strip_prefix(" = ["));
        let items = line.unwrap_or_else(|| panic!("no {name}")).trim_end_matches(']').split(", ").filter(|s| !s.is_empty());
        items.map(|item| item.parse().unwrap()).collect()
    };
    assert!(text.contains("uniform token subdivisionScheme = \"loop\""));
    assert_eq!(list("int[] cornerIndices").len(), 8);
    assert_eq!(list("float[] cornerSharpnesses"), [10; 8]);
    let lengths = list("int[] creaseLengths");
    assert_eq!(lengths.len(), 12);
    assert_eq!(list("int[] creaseIndices").len(), lengths.iter().sum::<usize>());
    story.done("decode d -o base.obj --level 0");
    let faces: Vec<usize> = mesh(&story, "base.obj").face_arrays().iter().flatten().map(|&v| v as usize).collect();
    assert_eq!(list("int[] faceVertexIndices"), faces);
    let glb = mesh_io::read(&story.path("d/base.glb")).unwrap();
    assert_eq!(glb.soup.triangles, mesh(&story, "base.obj").face_arrays());
    // Lines between pairs of vertices.
    assert!(String::from_utf8_lossy(&story.bytes("d/base.glb")).contains("\"mode\":1"));
    // A border is sharp by itself, and its four corners are told.
    story.done("remesh @plane.off -o out.obj --base-vertices 50 --displacement d");
    let text = String::from_utf8(story.bytes("d/base.usda")).unwrap();
    assert!(text.contains("int[] creaseIndices = []") && text.contains("float[] cornerSharpnesses = [10, 10, 10, 10]"), "{text}");
    assert!(text.contains("token interpolateBoundary = \"edgeAndCorner\""));
}

#[test]
fn broken_folders_are_refused() {
    let story = Story::new();
    story.done("remesh @cube.obj -o out.obj --base-vertices 50 --levels 1 --displacement d");
    story.refused("decode nowhere -o back.obj", "there is no displacement.npz in nowhere");
    let good = read_arrays(&story.path("d/displacement.npz")).unwrap();
    let refused = |change: &dyn Fn(&mut Vec<Array<'static>>), part: &str| {
        let mut arrays = good.clone();
        change(&mut arrays);
        write_arrays(&story.path("d/displacement.npz"), &arrays).unwrap();
        story.refused("decode d -o back.obj", part);
        assert!(!story.path("back.obj").exists());
    };
    let named = |arrays: &[Array<'static>], name: &str| arrays.iter().position(|a| a.name == name).unwrap();
    refused(&|arrays| arrays.clear(), "there is no array base_positions; write the folder again");
    refused(&|arrays| arrays.retain(|a| a.name != "residual_1"), "there is no array residual_1");
    let shorter = |arrays: &mut Vec<Array<'static>>| {
        let at = named(arrays, "scalar_1");
        arrays[at] = Array { name: "scalar_1".into(), shape: vec![2], values: Numbers::Float(vec![0.0; 2].into()) };
    };
    refused(&shorter, "level 1 has 2 scalar displacements where its edges need");
    let infinite = |arrays: &mut Vec<Array<'static>>| {
        let at = named(arrays, "scalar_1");
        arrays[at].values = Numbers::Float(vec![f64::INFINITY; arrays[at].shape[0]].into());
    };
    refused(&infinite, "make no mesh");
    story.write("d/displacement.npz", "nonsense");
    let ended = story.refused("decode d -o back.obj", "displacement.npz: it is no npz file");
    assert!(ended.stderr.contains("; "), "{}", ended.stderr);
}

#[test]
fn nothing_of_the_folder_is_written_over() {
    let story = Story::new();
    story.done("remesh @cube.obj -o out.obj --base-vertices 50 --levels 1 --displacement d");
    story.refused("decode d -o d/base.glb", "would write over d/base.glb");
    story.done("decode d -o d/base.glb --force");
    story.refused("remesh @cube.obj -o d/base.glb --base-vertices 50 --displacement d", "d/base.glb would be written twice");
    story.write("file", "");
    story.refused("remesh @cube.obj -o out.obj --base-vertices 50 --displacement file", "--displacement");
    // What does not fit into all files is in none of them.
    let huge = "v 0 0 0\nv 1e40 0 0\nv 0 1e40 0\nv 0 0 1e40\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    story.write("huge.obj", huge);
    story.refused("remesh huge.obj -o huge_out.obj --base-vertices 4 --displacement huge", "scale the input down");
    assert!(!story.path("huge_out.obj").exists());
    assert_eq!(std::fs::read_dir(story.path("huge")).unwrap().count(), 0);
    // Without a result there is nothing in the folder.
    story.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    story.refused("remesh line.obj -o o.obj --displacement empty", "no face is left");
    assert_eq!(std::fs::read_dir(story.path("empty")).unwrap().count(), 0);
}
