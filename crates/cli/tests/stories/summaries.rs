//! What people see.

use super::Story;

/// The names of the lines; a summary has at most ten.
fn names(summary: &str) -> Vec<&str> {
    assert!(summary.lines().count() <= 10, "{summary}");
    summary.lines().map(|line| line.split("  ").next().unwrap_or_default()).collect()
}

#[test]
fn a_remeshing_is_summed_up_with_verdicts() {
    let story = Story::new();
    let summary = story.done("remesh @cube.obj -o out.obj --base-vertices 50 --levels 1");
    assert_eq!(names(&summary)[..6], ["certified", "base mesh", "mesh", "shape", "distance", "sharp edges"], "{summary}");
    for line in summary.lines().skip(3).take(3) {
        assert!(["good: ", "fair: ", "poor: "].iter().any(|verdict| line.contains(verdict)), "{line}");
    }
    assert!(summary.contains("good: 100.0 % of their length kept"), "{summary}");
    assert_eq!(summary.matches("kept").count(), 1, "one figure for sharp edges\n{summary}");
}

#[test]
fn all_figures_are_there_when_asked_for() {
    let story = Story::new();
    let full = story.verbose("remesh @cube.obj -o out.obj --base-vertices 50 --levels 1").stdout;
    for name in ["base vertices", "vertices, faces", "aspect ratio", "error", "crease cover", "flipped", "degenerate", "seconds"]
    {
        assert!(full.lines().any(|line| line.starts_with(name)), "{name} is missing in\n{full}");
    }
    assert!(story.done("inspect @cube.obj -v").contains("aspect ratio"));
    assert!(story.done("compare @cube.obj @cube.obj --verbose").contains("aspect ratio"));
}

#[test]
fn quiet_is_silent_but_for_errors() {
    let story = Story::new();
    for line in
        ["remesh @cube.obj -o out.obj --base-vertices 50 --levels 1", "base @cube.obj -o out.obj --force", "inspect @cube.obj"]
    {
        assert_eq!(story.done(&format!("{line} -q")), "", "{line}");
    }
    assert_eq!(story.done("compare @cube.obj @cube.obj --quiet"), "");
    assert_eq!(story.refused("check @cube.obj -q --levels 2", "no subdivision connectivity").stdout, "");
    assert!(story.json("inspect @cube.obj --json -q").is_object());
    assert_eq!(story.run("inspect @cube.obj -q -v").code, Some(2));
}

#[test]
fn noise_is_not_called_sharp() {
    // Bumps: three thousand edges over 40 degrees, and none that goes on for a while.
    let story = Story::new();
    let summary = story.done("inspect @organic_raw.obj");
    assert!(names(&summary).contains(&"sharp edges"), "{summary}");
    let inspected = story.json("inspect @organic_raw.obj --json");
    let features = &inspected["cleaned"]["features"];
    let [sharp, all] = ["sharp_length", "crease_length"].map(|key| features[key].as_f64().unwrap());
    assert!(sharp < 0.5 * all, "{sharp} of {all}");
}

#[test]
fn inspect_and_compare_are_short() {
    let story = Story::new();
    let summary = story.done("inspect @wreck.obj");
    assert!(names(&summary).contains(&"defects") && summary.contains("fair: "), "{summary}");
    assert!(story.done("inspect @cube.obj").contains("good: none"));
    let same = story.done("compare @cube.obj @cube.obj");
    assert!(names(&same).contains(&"distance") && same.contains("good: 0 %"), "{same}");
    let other = story.done("compare @cube.obj @torus.off");
    assert!(names(&other).contains(&"topology") && other.contains("poor: "), "{other}");
}

const WITH_EXTRAS: &str =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl a\nf 1/1/1 2/1/1 3/1/1\nusemtl b\nf 1/1/1 3/1/1 4/1/1\n";

#[test]
fn what_a_file_holds_and_the_result_lacks_is_told() {
    let story = Story::new();
    story.write("in.obj", WITH_EXTRAS);
    assert!(story.done("inspect in.obj").contains("also holds        normals, texture coordinates, 2 materials"));
    let holds = story.json("inspect in.obj --json")["also_holds"].clone();
    assert_eq!(holds, serde_json::json!(["normals", "texture coordinates", "2 materials"]));
    let lost = "texture coordinates and 2 materials are not carried over to the result";
    assert!(story.done("remesh in.obj -o out.off --base-vertices 20 --levels 1").contains(lost));
    for line in ["remesh in.obj -o out.obj --base-vertices 20 --levels 1 --plain", "base in.obj -o base.obj --base-vertices 20"] {
        let warnings = story.json(&format!("{line} --json"))["warnings"].clone();
        assert!(warnings.as_array().is_some_and(|w| w.contains(&lost.into())), "{line}: {warnings}");
    }
    let report = story.json("remesh in.obj -o out.obj --base-vertices 20 --levels 1 --json");
    assert_eq!(report["warnings"], serde_json::json!([]), "an obj holds all of it");
    story.write("normals.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
    let report = story.json("remesh normals.obj -o out.obj --base-vertices 20 --levels 1 --json");
    assert_eq!(report["warnings"], serde_json::json!([]), "normals alone are no loss");
}

#[test]
fn compressed_files_are_known_by_their_name() {
    let story = Story::new();
    story.write("in.obj.gz", "no gzip");
    story.refused("inspect in.obj.gz", "in.obj.gz: its name ends in .gz, but it is no gz file");
}
