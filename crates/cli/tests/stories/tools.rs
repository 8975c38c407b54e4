//! `inspect`, `compare` and `check`.

use super::Story;

#[test]
fn inspect_counts_what_is_there() {
    let story = Story::new();
    let counts = |file: &str| story.json(&format!("inspect {file} --json"))["counts"].clone();
    let cube = counts("@cube.obj");
    for (key, value) in [("vertices", 386), ("triangles", 768), ("components", 1), ("boundary_loops", 0), ("genus", 0)] {
        assert_eq!(cube[key], value, "{key}");
    }
    assert_eq!(counts("@torus.off")["genus"], 1);
    let boxes = counts("@crossing_boxes.stl");
    assert_eq!((&boxes["components"], &boxes["merged_vertices"]), (&2.into(), &304.into()));
    assert_eq!(counts("@shell_small.obj")["boundary_loops"], 4);
}

#[test]
fn inspect_measures_features() {
    let surface = Story::new().json("inspect @cube.obj --json")["cleaned"].clone();
    let features = &surface["features"];
    assert!((features["crease_length"].as_f64().unwrap() - 12.0).abs() < 1e-6);
    assert_eq!((&features["arcs"], &features["corners"]), (&12.into(), &8.into()));
    assert!((surface["area"].as_f64().unwrap() - 6.0).abs() < 1e-6);
}

#[test]
fn inspect_shows_defects_and_their_repair() {
    let story = Story::new();
    // Three triangles on one edge, one of them twice, one with a bad index.
    story.write("book.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 5\nf 1 2 7\n");
    let book = story.json("inspect book.obj --json");
    for (key, value) in [("non_manifold_edges", 1), ("repeated", 1), ("bad_index", 1)] {
        assert_eq!(book["counts"][key], value, "{key}");
    }
    assert_eq!(book["counts"]["genus"], serde_json::Value::Null);
    assert_eq!(book["repairs"]["bad_index"], 1);
    assert!(story.done("inspect book.obj -v").contains("1 triangles with a bad index"));
    story.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    let ended = story.refused("inspect line.obj", "no face is left");
    assert!(ended.stdout.contains("1 triangles without area"), "the counts are still shown");
}

#[test]
fn compare_knows_the_distance_of_two_squares() {
    let story = Story::new();
    let square = |z: f64| format!("v 0 0 {z}\nv 3 0 {z}\nv 3 4 {z}\nv 0 4 {z}\nf 1 2 3\nf 1 3 4\n");
    story.write("low.obj", &square(0.0));
    story.write("high.obj", &square(0.5));
    let figures = story.json("compare low.obj high.obj --json");
    for key in ["err_mean", "err_rms", "err_max"] {
        assert!((figures[key].as_f64().unwrap() - 0.1).abs() < 1e-9, "half a unit over a diagonal of 5: {key}");
    }
    assert_eq!(figures["flipped"], 0);
    assert_eq!(figures["topology"]["border_loops"], 1);
    assert!(story.json("compare low.obj low.obj --json")["err_max"].as_f64().is_some_and(|e| e < 1e-15));
    story.write("points.obj", "v 0 0 0\n");
    story.refused("compare low.obj points.obj", "points.obj");
}

#[test]
fn check_tells_what_is_not_subdivided() {
    let story = Story::new();
    story.done("check @cube.obj --levels 0");
    let ended = story.refused("check @cube.obj --levels 2", "no subdivision connectivity");
    assert!(ended.stdout.contains("FAILED"));
    // Four triangles in the order of the contract, then two of them swapped.
    let corners = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    story.write("good.obj", &format!("{corners}f 1 4 6\nf 2 5 4\nf 3 6 5\nf 5 6 4\n"));
    story.write("swapped.obj", &format!("{corners}f 2 5 4\nf 1 4 6\nf 3 6 5\nf 5 6 4\n"));
    let good = story.json("check good.obj --levels 1 --json");
    assert_eq!((&good["passed"], &good["levels"]), (&true.into(), &serde_json::json!([[3, 1], [6, 4]])));
    story.refused("check swapped.obj --levels 1", "no subdivision connectivity");
    story.write("unused.obj", &format!("{corners}v 9 9 9\nf 1 4 6\nf 2 5 4\nf 3 6 5\nf 5 6 4\n"));
    story.refused("check unused.obj --levels 1", "1 vertices belong to no face");
}
