//! How far a run has come, and how the user ends it.

use super::Story;

#[test]
fn stages_are_told_when_asked_for() {
    let story = Story::new();
    let told = story.verbose("remesh @cube.obj -o out.obj --base-vertices 50 --levels 1").stderr;
    let stages: Vec<&str> = told.lines().filter_map(|line| line.split("%  ").nth(1)).collect();
    assert_eq!(stages.len(), told.lines().count(), "{told}");
    for stage in ["clean", "relax", "certify"] {
        assert!(stages.contains(&stage), "{stage} is missing in\n{told}");
    }
    let shares: Vec<f64> = told.lines().filter_map(|line| line.split('%').next()?.trim().parse().ok()).collect();
    assert!(shares.is_sorted() && shares.len() == stages.len(), "{told}");
}

#[test]
fn the_seconds_add_up() {
    let story = Story::new();
    let report = story.json("remesh @cube.obj -o out.obj --base-vertices 50 --levels 1 --json");
    let seconds = report["seconds"].as_object().unwrap();
    let parts: f64 = seconds.iter().filter(|(part, _)| *part != "total").filter_map(|(_, s)| s.as_f64()).sum();
    assert!((parts - seconds["total"].as_f64().unwrap()).abs() < 1e-6, "{seconds:?}");
    let attempts = report["attempts"].as_array().unwrap();
    assert!(attempts.iter().any(|attempt| attempt["verdict"] == "certified" && attempt["way"] == report["way"]), "{attempts:?}");
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_a_run_and_leaves_nothing() {
    use std::io::{BufRead as _, BufReader, Read as _};
    use std::process::{Command, Stdio};
    let story = Story::new();
    let mut command =
        story.command("remesh @part.obj -o out.obj --base-vertices 400 --levels 4 --stages pictures --verbose --json");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("semireg starts");
    let mut told = BufReader::new(child.stderr.take().expect("standard error"));
    let mut line = String::new();
    told.read_line(&mut line).expect("the first stage");
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(killed.success(), "{line}");
    told.read_to_string(&mut line).expect("the rest");
    let mut json = String::new();
    child.stdout.take().expect("standard output").read_to_string(&mut json).expect("the report");
    assert_eq!(child.wait().expect("semireg ends").code(), Some(130), "{line}");
    assert!(line.ends_with("error: cancelled\n"), "{line}");
    let object: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((&object["kind"], &object["hint"]), (&"cancelled".into(), &"".into()));
    assert_eq!(story.files(), ["pictures"]);
    assert_eq!(std::fs::read_dir(story.path("pictures")).expect("the folder").count(), 0);
}
