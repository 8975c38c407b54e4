//! What is refused, and how.

use super::Story;

#[test]
fn wrong_usage_ends_with_2() {
    let story = Story::new();
    for line in [
        "",
        "polish a.obj",
        "remesh a.obj",
        "remesh a.obj -o b.obj --levels 9",
        "remesh a.obj -o b.obj --base-vertices 0",
        "remesh a.obj -o b.obj --base-vertices many",
        "remesh a.obj -o b.obj --crease-angle nan",
        "remesh a.obj -o b.obj --threads 0",
        "compare a.obj",
        "inspect a.obj --colour",
    ] {
        let ended = story.run(line);
        assert_eq!(ended.code, Some(2), "semireg {line}");
        assert!(ended.stdout.is_empty() && !ended.stderr.is_empty(), "semireg {line}");
    }
}

#[test]
fn bad_input_is_refused_and_leaves_nothing() {
    let story = Story::new();
    std::fs::create_dir(story.path("folder.obj")).unwrap();
    story.write("empty.obj", "");
    story.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    story.write("number.obj", "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2 3\n");
    story.write("indices.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    story.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    story.write("noise.glb", "this is no glb");
    story.write("short.stl", "solid");
    story.write("text.txt", "v 0 0 0\n");
    let before = story.files();
    for (input, part) in [
        ("missing.obj", "cannot read missing.obj"),
        ("folder.obj", "cannot read folder.obj"),
        ("empty.obj", "empty.obj"),
        ("points.obj", "points.obj"),
        ("number.obj", "number.obj:2"),
        ("indices.obj", "1 with a vertex index out of range"),
        ("line.obj", "1 without area"),
        ("noise.glb", "noise.glb"),
        ("short.stl", "short.stl"),
        ("text.txt", "the extension names no mesh format"),
    ] {
        let ended = story.refused(&format!("remesh {input} -o out.obj"), part);
        assert_eq!(ended.stdout, "", "{input}");
    }
    assert_eq!(story.files(), before);
}

#[test]
fn a_bad_output_is_told_before_the_work() {
    let story = Story::new();
    std::fs::create_dir(story.path("folder.obj")).unwrap();
    // The input does not exist: it would be the next thing to be told.
    for (output, part) in [
        ("no/such/out.obj", "there is no folder no/such"),
        ("out.xyz", "the extension names no mesh format"),
        ("out", "the extension names no mesh format"),
        ("folder.obj", "it is a folder"),
    ] {
        story.refused(&format!("remesh missing.obj -o {output}"), part);
    }
    story.refused("remesh missing.obj -o out.obj --base-vertices 4000000000 --levels 8", "lower --base-vertices or --levels");
    assert_eq!(story.files(), ["folder.obj"]);
}

#[test]
fn a_refusal_leaves_an_old_result_alone() {
    let story = Story::new();
    story.write("out.obj", "old");
    story.refused("remesh missing.obj -o out.obj", "missing.obj");
    assert_eq!(story.bytes("out.obj"), b"old");
}
