//! What is written beside the finest level: other levels, other orders, the map, variants.

use super::Story;
use std::path::PathBuf;
use std::process::Command;

const CUBE: &str = "--base-vertices 50";

/// The faces of an obj of ours, as vertex numbers.
fn faces(story: &Story, name: &str) -> Vec<[u32; 3]> {
    let text = String::from_utf8(story.bytes(name)).unwrap();
    let lines = text.lines().filter_map(|line| line.strip_prefix("f "));
    let face =
        |line: &str| -> Vec<u32> { line.split(' ').map(|corner| corner.split('/').next().unwrap().parse().unwrap()).collect() };
    lines.map(|line| face(line).try_into().unwrap()).collect()
}

#[test]
fn every_level_is_written_beside_the_finest() {
    let story = Story::new();
    story.done(&format!("remesh @cube.obj -o out.obj {CUBE} --all-levels"));
    assert_eq!(story.files(), ["out.0.obj", "out.1.obj", "out.2.obj", "out.obj"]);
    for level in 0..3 {
        story.done(&format!("check out.{level}.obj --levels {level}"));
    }
    assert!(story.bytes("out.2.obj") == story.bytes("out.obj"));
    story.done(&format!("remesh @cube.obj -o one.obj {CUBE} --level 1"));
    assert!(story.bytes("one.obj") == story.bytes("out.1.obj"));
    // The vertices of a level are the first ones of the finest.
    let [coarse, fine] = ["out.0.obj", "out.obj"].map(|name| String::from_utf8(story.bytes(name)).unwrap());
    let vertices = |text: &str| text.lines().filter(|line| line.starts_with("v ")).map(String::from).collect::<Vec<_>>();
    assert!(vertices(&fine).starts_with(&vertices(&coarse)));
    let ended = story.run(&format!("remesh @cube.obj -o out.obj {CUBE} --level 3"));
    assert!(ended.code == Some(2) && ended.stderr.contains("above the finest level, 2"), "{}", ended.stderr);
}

#[test]
fn a_glb_holds_all_levels() {
    let story = Story::new();
    story.done(&format!("remesh @cube.obj -o all.glb {CUBE} --all-levels"));
    story.done(&format!("remesh @cube.obj -o one.glb {CUBE}"));
    assert_eq!(story.files(), ["all.glb", "one.glb"]);
    // What reads no levels of detail has the finest.
    story.done("check all.glb");
    assert!(story.bytes("all.glb").len() > story.bytes("one.glb").len());
    let text = String::from_utf8_lossy(&story.bytes("all.glb")).into_owned();
    for part in ["MSFT_lod", r#""name":"level 0""#, r#""name":"level 2""#] {
        assert!(text.contains(part), "{part}");
    }
}

/// Pools as SubdivNet does, in blocks, from three levels down to the base, with the files of these levels in its order.
#[test]
fn subdivnet_pools_a_result_down_to_its_base() {
    let story = Story::new();
    story.done(&format!("remesh @cube.obj -o net.obj {CUBE} --levels 3 --all-levels --order subdivnet"));
    story.done(&format!("remesh @cube.obj -o ours.obj {CUBE} --levels 3 --all-levels"));
    assert_eq!(faces(&story, "net.0.obj"), faces(&story, "ours.0.obj"));
    for level in 0..3 {
        let [coarse, fine] = [level, level + 1].map(|k| faces(&story, &format!("net.{k}.obj")));
        let n = coarse.len();
        assert_eq!(fine.len(), 4 * n);
        for (f, &[a, b, c]) in coarse.iter().enumerate() {
            let [first, second, third, centre] = [fine[f], fine[f + n], fine[f + 2 * n], fine[f + 3 * n]];
            let ([_, ab, ca], bc) = (first, second[1]);
            let expected = [[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]];
            assert_eq!([first, second, third, centre], expected, "face {f} of level {level}");
        }
    }
    story.done("check net.obj --levels 3 --order subdivnet");
    story.refused("check net.obj --levels 3", "not the children");
}

#[test]
fn variants_are_other_meshes_of_the_same_shape() {
    let story = Story::new();
    let line = "remesh @blob_small.obj -o out.obj --base-vertices 120 --levels 1";
    let report = story.json(&format!("{line} --seed 1 --variants 2 --json"));
    story.done(&format!("{line} --variants 1"));
    assert_eq!(story.files(), ["out-0.obj", "out-1.obj", "out-2.obj"]);
    let [a, b, c] = [0, 1, 2].map(|seed| story.bytes(&format!("out-{seed}.obj")));
    assert!(a != b && b != c && c != a);
    for (i, variant) in report["variants"].as_array().unwrap().iter().enumerate() {
        assert_eq!((&variant["seed"], &variant["output"]), (&(i + 1).into(), &format!("out-{}.obj", i + 1).into()));
        assert!(!variant["warnings"].to_string().contains("gives the same result"), "{variant}");
        story.done(&format!("check out-{}.obj --levels 1", i + 1));
    }
    // The seeds are those of single runs.
    story.done(&format!("{line} --seed 2"));
    assert!(story.bytes("out.obj") == c);
}

#[test]
fn variants_that_cannot_differ_are_told() {
    let story = Story::new();
    // Four corners, and no edge that could be another one.
    std::fs::write(story.path("tetrahedron.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
        .unwrap();
    let report = story.json("remesh tetrahedron.obj -o out.obj --base-vertices 4 --levels 1 --variants 2 --json");
    assert!(report["variants"][1]["warnings"].to_string().contains("gives the same result as seed 0"), "{report}");
}

/// A Python with numpy: that of the variable, else the first on the path.
pub(super) fn python() -> Option<PathBuf> {
    let python = std::env::var_os("SEMIREG_PYTHON").map_or("python3".into(), PathBuf::from);
    let has_numpy = Command::new(&python).args(["-c", "import numpy"]).output().is_ok_and(|output| output.status.success());
    has_numpy.then_some(python)
}

#[test]
fn the_example_of_the_map_finds_everything_right() {
    let story = Story::new();
    for (input, levels, says) in [("cube.obj", 2, "(0 of "), ("wreck.obj", 2, "of "), ("tap_small.obj", 1, "(0 of ")] {
        story.done(&format!("remesh @{input} -o out.obj --base-vertices 60 --levels {levels} --all-levels --map map.npz"));
        let Some(python) = python() else {
            eprintln!("skipped: there is no python3 with numpy (SEMIREG_PYTHON names one)");
            continue;
        };
        let script = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/examples/map.py");
        let files = [super::fixtures().join(input), story.path("out.obj"), story.path("map.npz"), story.path("out.0.obj")];
        let output = Command::new(python).arg(script).args(files).output().unwrap();
        let [said, wrong] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        assert!(output.status.success(), "{input}:\n{said}{wrong}");
        let taken_away = said.lines().find(|line| line.contains("took away")).unwrap();
        assert!(taken_away.contains(says), "{input}: {taken_away}");
        assert_eq!(said.lines().filter(|line| line.starts_with("ok")).count(), 6 + 2 * levels, "{input}:\n{said}");
    }
}

#[test]
fn the_map_is_the_same_on_any_number_of_threads() {
    let story = Story::new();
    for threads in [1, 3] {
        story.done(&format!("remesh @wreck.obj -o out.obj {CUBE} --threads {threads} --map m{threads}.npz --order subdivnet"));
    }
    assert!(story.bytes("m1.npz") == story.bytes("m3.npz"));
    let ended = story.run(&format!("remesh @cube.obj -o out.obj {CUBE} --map map.txt"));
    assert!(ended.code == Some(2) && ended.stderr.contains(".npz"), "{}", ended.stderr);
}
