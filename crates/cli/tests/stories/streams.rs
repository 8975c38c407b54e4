//! Meshes through standard input and output.

use super::Story;
use std::io::Write as _;
use std::process::{Output, Stdio};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
/// The same, as gzip compresses it.
const PACKED_SQUARE: [u8; 46] = [
    0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0x2b, 0x53, 0x30, 0x00, 0x41, 0xae, 0x32, 0x05, 0x43, 0x38, 0x6d,
    0x08, 0xa6, 0x0d, 0xc0, 0x74, 0x1a, 0x90, 0x34, 0x52, 0x30, 0x06, 0xd3, 0xc6, 0x0a, 0x26, 0x5c, 0x00, 0xcb, 0x6b, 0xeb, 0x53,
    0x30, 0x00, 0x00, 0x00,
];
const SMALL: &str = "--base-vertices 9 --levels 1";

impl Story {
    /// Runs a command that is given `input` on standard input.
    fn fed(&self, line: &str, input: &[u8]) -> Output {
        let mut command = self.command(line);
        let command = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("semireg starts");
        // What refuses its arguments does not read.
        child.stdin.take().expect("standard input").write_all(input).ok();
        child.wait_with_output().expect("semireg ends")
    }
}

#[test]
fn a_mesh_goes_through_as_it_goes_from_file_to_file() {
    let story = Story::new();
    story.write("in.obj", SQUARE);
    for format in ["obj", "ply", "stl", "off", "gltf", "glb"] {
        story.done(&format!("remesh in.obj -o out.{format} {SMALL}"));
        let piped = story.fed(&format!("remesh - -o - --input-format obj --format {format} {SMALL}"), SQUARE.as_bytes());
        assert!(piped.status.success() && piped.stdout == story.bytes(&format!("out.{format}")), "{format}");
        let again = story.fed(&format!("inspect - --format {format} --json"), &piped.stdout);
        assert!(again.status.success(), "{format}");
    }
    let piped = story.fed(&format!("remesh - -o - --format obj {SMALL}"), SQUARE.as_bytes());
    assert!(piped.stdout == story.bytes("out.obj"));
    assert!(story.fed("check - --format obj --levels 1", &piped.stdout).status.success());
    assert!(story.fed("compare in.obj - --format obj", &piped.stdout).status.success());
    story.fed(&format!("remesh - -o file.ply --format obj {SMALL}"), SQUARE.as_bytes());
    assert!(story.bytes("file.ply") == story.bytes("out.ply"));
    story.done("base in.obj -o base.off --base-vertices 9");
    let base = story.fed("base in.obj -o - --format off --base-vertices 9", b"");
    assert!(base.stdout == story.bytes("base.off"));
}

#[test]
fn compressed_input_is_known_by_its_first_bytes() {
    let story = Story::new();
    let line = format!("remesh - -o - --format obj {SMALL}");
    let packed = story.fed(&line, &PACKED_SQUARE);
    assert!(packed.status.success() && packed.stdout == story.fed(&line, SQUARE.as_bytes()).stdout);
    let cut = story.fed(&line, &PACKED_SQUARE[..20]);
    assert!(String::from_utf8_lossy(&cut.stderr).contains("standard input: the gz file is cut off"));
}

#[test]
fn what_is_said_goes_to_standard_error_beside_a_mesh() {
    let story = Story::new();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let plain = story.fed(&format!("remesh - -o - --format obj {SMALL}"), SQUARE.as_bytes());
    assert!(text(&plain.stdout).starts_with("v ") && text(&plain.stderr).contains("standard output after"));
    let json = story.fed(&format!("remesh - -o - --format obj {SMALL} --json"), SQUARE.as_bytes());
    assert_eq!(json.stdout, plain.stdout);
    let report: serde_json::Value = serde_json::from_slice(&json.stderr).expect("the report");
    assert_eq!((&report["input"], &report["output"]), (&"standard input".into(), &"standard output".into()));
    let failed = story.fed("remesh - -o - --format obj --json", b"v 0 0 0\nv 0 x 0\n");
    assert_eq!((failed.status.code(), failed.stdout.as_slice()), (Some(1), [].as_slice()));
    assert!(text(&failed.stderr).contains(r#""kind": "parse""#), "{}", text(&failed.stderr));
    assert!(text(&failed.stderr).contains("\nerror: standard input:2: "), "{}", text(&failed.stderr));
}

#[test]
fn a_dash_without_format_and_a_format_without_dash_are_wrong_usage() {
    let story = Story::new();
    story.write("in.obj", SQUARE);
    for (line, part) in [
        ("remesh - -o out.obj", "add --format"),
        ("remesh in.obj -o -", "add --format"),
        ("remesh in.obj -o out.obj --format ply", "leave it out"),
        ("remesh - -o out.obj --input-format obj --format ply", "leave it out"),
        ("remesh in.obj -o - --input-format obj --format ply", "leave it out"),
        ("inspect in.obj --format obj", "leave it out"),
        ("compare - - --format obj", "name a file for one of them"),
        ("check -", "add --format"),
        ("inspect - --format xyz", "invalid value"),
    ] {
        let ended = story.fed(line, SQUARE.as_bytes());
        let said = String::from_utf8_lossy(&ended.stderr).into_owned();
        assert!(ended.status.code() == Some(2) && said.contains(part), "semireg {line}: {said}");
    }
    assert_eq!(story.files(), ["in.obj"]);
}

#[test]
fn a_mesh_that_nobody_reads_is_no_fault() {
    let story = Story::new();
    story.write("in.obj", SQUARE);
    assert_eq!(story.unread(&format!("remesh in.obj -o - --format obj {SMALL}")), Some(0));
}
