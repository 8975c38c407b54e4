//! How a failure is told to programs, what is not written over, and output that nobody reads.

use super::Story;

fn failure(story: &Story, line: &str) -> (Option<i32>, serde_json::Value) {
    let ended = story.run(&format!("{line} --json"));
    let object = serde_json::from_str(&ended.stdout).unwrap_or_else(|e| panic!("semireg {line}: {e} in {:?}", ended.stdout));
    assert!(ended.stderr.starts_with("error: "), "semireg {line}: {}", ended.stderr);
    (ended.code, object)
}

#[test]
fn json_tells_what_kind_of_failure_it_was() {
    let story = Story::new();
    story.write("number.obj", "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2 3\n");
    story.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    story.write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
    story.write("text.txt", "");
    for (line, code, kind, hint) in [
        ("remesh missing.obj -o out.obj", 1, "io", "check the path"),
        ("remesh number.obj -o out.obj", 1, "parse", "export the file again"),
        ("remesh text.txt -o out.obj", 1, "format", "use obj, ply"),
        ("remesh square.obj -o out.xyz", 1, "format", "use obj, ply"),
        ("remesh square.obj -o out.obj.gz", 1, "format", "leave .gz off"),
        ("remesh line.obj -o out.obj", 1, "empty", ""),
        ("remesh @cube.obj -o out.obj --base square.obj", 1, "base", "same topology"),
        ("remesh square.obj -o out.obj --base-vertices 4000000000 --levels 8", 1, "too_large", "lower --base-vertices"),
        ("remesh square.obj -o out.obj --marked-edges square.obj", 1, "marks", "give them as"),
        ("remesh square.obj -o out.obj --weak-angle 50", 2, "usage", "raise --crease-angle"),
        ("remesh square.obj -o out.obj --weights adaptive", 2, "usage", "add that or leave"),
        ("remesh square.obj -o out.obj --method patches --relax-iterations 3", 2, "usage", "add that or leave"),
        ("remesh square.obj -o out.obj --levels -1", 2, "usage", "--help"),
        ("remesh square.obj -o square.obj", 1, "overwrite", "--force"),
        ("inspect missing.obj", 1, "io", "check the path"),
        ("compare line.obj square.obj", 1, "empty", "give files with a surface"),
    ] {
        let (ended, object) = failure(&story, line);
        assert_eq!((ended, object["kind"].as_str()), (Some(code), Some(kind)), "semireg {line}: {object}");
        assert!(object["hint"].as_str().is_some_and(|h| h.contains(hint)), "semireg {line}: {object}");
        assert!(object["error"].as_str().is_some_and(|e| !e.is_empty() && !e.contains(hint) || hint.is_empty()), "{object}");
    }
}

#[test]
fn a_report_and_its_failure_are_one_object() {
    let story = Story::new();
    story.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    let (_, inspected) = failure(&story, "inspect line.obj");
    assert_eq!((&inspected["kind"], &inspected["counts"]["triangles"]), (&"empty".into(), &1.into()));
    let (_, checked) = failure(&story, "check @cube.obj --levels 2");
    assert_eq!((&checked["kind"], &checked["passed"]), (&"check_failed".into(), &false.into()));
}

#[test]
fn the_last_line_is_the_error_with_its_remedy() {
    let ended = Story::new().refused("remesh missing.obj -o out.obj", "No such file");
    assert!(ended.stderr.ends_with("check the path and its permissions\n"), "{}", ended.stderr);
}

#[test]
fn output_that_nobody_reads_is_no_fault() {
    let story = Story::new();
    assert_eq!(story.unread("inspect @cube.obj"), Some(0));
    assert_eq!(story.unread("inspect @cube.obj --json"), Some(0));
    assert_eq!(story.unread("remesh --help"), Some(0));
    assert_eq!(story.unread("inspect missing.obj"), Some(1));
    assert_eq!(story.unread("inspect missing.obj --json"), Some(1));
    assert_eq!(story.unread("inspect"), Some(2));
}

#[test]
fn numbers_out_of_range_are_told_the_range() {
    let story = Story::new();
    for (option, range) in [("--levels -1", "from 0 to 8"), ("--levels 9", "from 0 to 8"), ("--base-vertices -5", "from 1 to")] {
        let ended = story.run(&format!("remesh a.obj -o b.obj {option}"));
        assert_eq!(ended.code, Some(2), "{option}");
        assert!(ended.stderr.contains(range) && !ended.stderr.contains("unexpected argument"), "{}", ended.stderr);
    }
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nl 1 3\n";

#[test]
fn what_is_read_is_not_written_over() {
    let story = Story::new();
    for name in ["in.obj", "base.obj", "marks.obj", "01-input.ply"] {
        story.write(name, SQUARE);
    }
    std::fs::create_dir(story.path("folder")).unwrap();
    let before = story.files();
    for line in [
        "remesh in.obj -o in.obj",
        "remesh in.obj -o ./folder/../in.obj",
        "remesh in.obj -o base.obj --base base.obj",
        "remesh in.obj -o marks.obj --marked-edges marks.obj",
        "base in.obj -o in.obj",
        "remesh 01-input.ply -o out.obj --stages .",
        "stages 01-input.ply --dir .",
    ] {
        story.refused(line, "add --force");
    }
    story.refused("remesh in.obj -o 08-result.ply --stages .", "picture of a stage");
    assert_eq!(story.files(), before);
    assert!(before.iter().filter(|name| name.contains('.')).all(|name| story.bytes(name) == SQUARE.as_bytes()));
    story.done("base in.obj -o in.obj --base-vertices 9 --force");
    assert!(story.bytes("in.obj") != SQUARE.as_bytes());
}

#[cfg(unix)]
#[test]
fn a_link_to_the_input_is_the_input() {
    let story = Story::new();
    story.write("in.obj", SQUARE);
    std::os::unix::fs::symlink(story.path("in.obj"), story.path("link.obj")).unwrap();
    story.refused("remesh in.obj -o link.obj", "add --force");
    story.refused("remesh link.obj -o in.obj", "add --force");
}
