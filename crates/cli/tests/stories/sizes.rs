//! Results of a size that the user names.

use super::Story;
use serde_json::Value;

fn number(report: &Value, key: &str) -> f64 {
    report[key].as_f64().unwrap_or_else(|| panic!("{key} in {report}"))
}

#[test]
fn numbers_are_met_within_three_percent() {
    let story = Story::new();
    for (option, key) in [("--vertices", "vertices"), ("--triangles", "faces")] {
        let report = story.json(&format!("remesh @cylinder.ply -o out.obj {option} 2000 --json"));
        assert!((number(&report, key) / 2000.0 - 1.0).abs() < 0.03, "{option}: {}", report[key]);
        assert_eq!(report["parameters"][&option[2..]], 2000.0);
    }
    // The levels that are asked for are kept, and every one is written.
    let report = story.json("remesh @cylinder.ply -o out.obj --vertices 2000 --levels 3 --all-levels --json");
    assert_eq!(report["levels"].as_array().unwrap().len(), 4);
    story.done("check out.3.obj --levels 3");
}

#[test]
fn levels_that_are_chosen_are_all_written() {
    let story = Story::new();
    let report = story.json("remesh @cylinder.ply -o out.obj --vertices 1000 --all-levels --json");
    let levels = report["levels"].as_array().unwrap().len();
    assert_eq!(report["files"].as_array().unwrap().len(), 1 + levels);
    assert_eq!(story.files().iter().filter(|f| f.ends_with(".obj")).count(), 1 + levels, "{:?}", story.files());
}

#[test]
fn an_error_is_kept() {
    let story = Story::new();
    let report = story.json("remesh @cylinder.ply -o out.obj --max-error 2e-3 --json");
    assert!(number(&report, "err_max") <= 2e-3 && !report["sizes"].as_array().unwrap().is_empty());
    let compared = story.json("compare @cylinder.ply out.obj --json");
    assert!(number(&compared, "err_max") <= 2e-3);
}

#[test]
fn a_density_is_followed_and_its_faults_are_told() {
    let story = Story::new();
    let ply = |density: &str, n: usize| {
        let header =
            format!("ply\nformat ascii 1.0\nelement vertex {n}\nproperty float x\nproperty float y\nproperty float z\n{density}");
        let faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        let value = if density.is_empty() { "" } else { " 2" };
        let vertices: String = (0..n).map(|v| format!("{v} {} 0{value}\n", v * v)).collect();
        format!("{header}{faces}{vertices}3 0 1 2\n")
    };
    let size = "--base-vertices 50 --levels 1";
    story.write("some.ply", &ply("property float density\n", 8));
    let wrong = |file: &str, part: &str| {
        let ended = story.run(&format!("remesh @cube.obj -o out.obj {size} --density {file}"));
        assert!(ended.code == Some(2) && ended.stderr.contains(part), "{:?}: {}", ended.code, ended.stderr);
    };
    wrong("some.ply", "the density has 8 values, the input has");
    story.write("none.ply", &ply("", 8));
    wrong("none.ply", "none.ply has no density");
}
