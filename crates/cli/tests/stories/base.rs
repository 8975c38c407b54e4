//! The base mesh alone, the stages before it, and marked edges.

use super::Story;

/// A flat square of two triangles whose diagonal 1-3 nobody would take for a crease.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

#[test]
fn the_base_mesh_is_written_and_told() {
    let story = Story::new();
    let report = story.json("base @cube.obj -o base.ply --base-vertices 50 --json");
    assert_eq!(report["base_vertices"]["made"], report["vertices"]);
    for key in ["ar_mean", "err_mean"] {
        assert!(report[key].is_number(), "{key}");
    }
    assert_eq!((&report["cells"]["corners"], &report["cells"]["arcs"]), (&8.into(), &12.into()));
    assert_eq!(report["crease_length"]["share"], 1.0);
    assert!(report["seconds"]["base"].is_number());
    story.done("check base.ply --levels 0");
    let table = story.verbose("base @cube.obj -o base.obj --base-vertices 50").stdout;
    for name in ["base vertices", "network", "crease length", "aspect ratio", "error", "seconds"] {
        assert!(table.lines().any(|line| line.starts_with(name)), "{name} is missing in\n{table}");
    }
}

#[test]
fn the_base_mesh_is_that_of_a_remeshing() {
    let story = Story::new();
    story.done("base @cylinder.ply -o base.off --base-vertices 60");
    story.done("remesh @cylinder.ply -o fine.off --base-vertices 60 --levels 0");
    let [base, fine] = ["base.off", "fine.off"].map(|f| story.json(&format!("inspect {f} --json"))["counts"].clone());
    assert_eq!(base, fine);
}

#[test]
fn stages_up_to_the_base_mesh_are_drawn() {
    let story = Story::new();
    let table = story.done("stages @cube.obj --dir a/b --base-vertices 50");
    assert!(table.contains("base mesh"), "{table}");
    for stage in ["01-input", "02-features", "03-patches", "04-sites", "05-base"] {
        assert!(story.bytes(&format!("a/b/{stage}.png")).starts_with(b"\x89PNG"), "{stage}");
        story.done(&format!("inspect a/b/{stage}.ply"));
    }
    let charts = String::from_utf8(story.bytes("a/b/05-charts.svg")).unwrap();
    assert!(charts.starts_with("<svg") && charts.matches("<polygon").count() >= 12);
}

#[test]
fn a_marked_edge_is_kept() {
    let story = Story::new();
    story.write("square.obj", SQUARE);
    story.write("marks.obj", "v 1 1 0\nv 0 0 0\nl 1 2\n");
    let plain = story.json("base square.obj -o base.obj --base-vertices 30 --json");
    let marked = story.json("base square.obj -o marked.obj --base-vertices 30 --marked-edges marks.obj --json");
    assert_eq!((&plain["cells"]["arcs"], &marked["cells"]["arcs"]), (&4.into(), &5.into()));
    // Every base vertex on the diagonal has another one on it.
    let on_diagonal = |line: &&str| line.starts_with("v ") && line.split(' ').nth(1) == line.split(' ').nth(2);
    let text = String::from_utf8(story.bytes("marked.obj")).unwrap();
    assert!(text.lines().filter(on_diagonal).count() >= 3, "{text}");
}

#[test]
fn marks_that_do_not_fit_are_refused() {
    let story = Story::new();
    story.write("square.obj", SQUARE);
    let refused = |marks: &str, part: &str| {
        story.write("marks.obj", marks);
        story.refused("base square.obj -o base.obj --marked-edges marks.obj", part);
    };
    refused("v 1 1 0\nv 0 0 0\n", "marks.obj has no lines");
    refused("v 1 1 0\nv 0 0 0\nl 1 2 5\n", "line segment 2 has an end that is no vertex");
    refused("v 1 1 0\nv 0 0 0\nv 0.5 0 0\nl 1 2 3\n", "marked edge 2 from [0.0, 0.0, 0.0] to [0.5, 0.0, 0.0] is no edge");
    let ended = story.run("base square.obj -o base.obj --crease-angle 30 --weak-angle 35");
    assert!(ended.code == Some(2) && ended.stderr.contains("lower it or raise --crease-angle"), "{}", ended.stderr);
    assert_eq!(story.files(), ["marks.obj", "square.obj"]);
}

#[test]
fn our_own_base_mesh_given_back_gives_the_same_mesh() {
    let story = Story::new();
    for input in ["cylinder.ply", "l_block.obj"] {
        let direct = story.json(&format!("remesh @{input} -o a.obj --base-vertices 60 --levels 2 --json"));
        story.done(&format!("base @{input} -o base.ply --base-vertices 60"));
        let traced = story.json(&format!("remesh @{input} -o b.obj --base base.ply --levels 2 --json"));
        assert_eq!((&traced["vertices"], &traced["faces"]), (&direct["vertices"], &direct["faces"]));
        assert_eq!((&traced["warnings"], &traced["flipped"]), (&serde_json::json!([]), &0.into()));
        assert_eq!(traced["base_vertices"]["made"], direct["base_vertices"]["made"]);
        for (key, tolerance) in [("ar_mean", 0.02), ("crease_cover", 0.05)] {
            let [a, b] = [&direct, &traced].map(|r| r[key].as_f64().unwrap_or_default());
            assert!((a - b).abs() < tolerance, "{input}: {key} {a} and {b}");
        }
        story.done("check b.obj --levels 2");
    }
}

#[test]
fn a_base_mesh_by_hand_may_have_any_format() {
    let story = Story::new();
    story.done("remesh @cube.obj -o start.obj --base-vertices 20 --levels 0");
    for format in ["stl", "glb", "off"] {
        story.done(&format!("base @cube.obj -o base.{format} --base-vertices 20"));
        let report = story.json(&format!("remesh @cube.obj -o out.obj --base base.{format} --levels 1 --stages drawn --json"));
        assert_eq!((&report["crease_length"]["share"], &report["base_vertices"]["asked"]), (&1.0.into(), &20.into()));
        assert!(report["parameters"]["base"].as_str().is_some_and(|name| name.ends_with(format)));
        assert!(story.bytes("drawn/05-charts.svg").starts_with(b"<svg"));
    }
}

#[test]
fn base_meshes_that_do_not_fit_are_refused() {
    let story = Story::new();
    story.write("square.obj", SQUARE);
    let book = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    story.write("book.obj", book);
    story.write("empty.obj", "v 0 0 0\n");
    let refused = |base: &str, part: &str| story.refused(&format!("remesh @cube.obj -o out.obj --base {base}"), part);
    refused("square.obj", "1 border loops and Euler number 1, but the input has 1 components, 0 border loops and Euler number 2");
    refused("book.obj", "not an oriented manifold (1 edges");
    refused("empty.obj", "the base mesh cannot be used: no face is left");
    refused("none.obj", "cannot read none.obj");
    assert_eq!(story.run("remesh @cube.obj -o out.obj --base square.obj --base-vertices 9").code, Some(2));
    assert_eq!(story.files(), ["book.obj", "empty.obj", "square.obj"]);
}
