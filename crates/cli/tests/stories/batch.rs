//! Many files.

use super::{Ended, Story};
use fixtures::{cone, cube, cylinder, encode, icosphere, l_block, torus};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

const SMALL: &str = "--base-vertices 20 --levels 1";

impl Story {
    /// Puts `n` small meshes into the folder `in` and folders inside; every tenth file is broken.
    fn many(&self, n: usize) {
        for i in 0..n {
            let folder = ["in/a", "in/b", "in/b/c"][i % 3];
            fs::create_dir_all(self.path(folder)).expect("a folder");
            let (name, bytes) = if i % 10 == 4 { broken(i) } else { sound(i) };
            fs::write(self.path(&format!("{folder}/{name}")), bytes).expect("a file");
        }
    }

    /// The lines of a batch that are complete.
    fn lines(&self, out: &str) -> Vec<Value> {
        let text = fs::read_to_string(self.path(&format!("{out}/results.jsonl"))).unwrap_or_default();
        text.split_inclusive('\n').filter(|l| l.ends_with('\n')).map(|l| serde_json::from_str(l).expect("JSON")).collect()
    }

    /// The contents of all files below a folder but for the lines, by their names.
    fn results(&self, out: &str) -> BTreeMap<String, Vec<u8>> {
        let mut results = BTreeMap::new();
        collect(&self.path(out), &self.path(out), &mut results);
        results.retain(|name, _| name != "results.jsonl");
        results
    }
}

fn collect(folder: &Path, root: &Path, results: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, root, results);
        } else {
            let name = path.strip_prefix(root).expect("below").to_string_lossy().replace('\\', "/");
            results.insert(name, fs::read(&path).expect("a file"));
        }
    }
}

/// A mesh of its own for every number.
fn sound(i: usize) -> (String, Vec<u8>) {
    let mesh = match i % 6 {
        0 => cube(2 + i / 60),
        1 => cylinder(1.0, 1.0 + i as f64 / 100.0, 12),
        2 => cone(1.0, 1.0 + i as f64 / 100.0, 12),
        3 => icosphere(2 + i % 4),
        4 => torus(2.0, 0.5 + i as f64 / 1000.0, 24, 12),
        _ => l_block(2),
    };
    let name = format!("{i:03}.{}", ["obj", "stl", "off", "ply"][i % 4]);
    let bytes = encode(&mesh.to_soup(), &name).expect("a format");
    (name, bytes)
}

fn broken(i: usize) -> (String, Vec<u8>) {
    let (extension, text) = match i / 10 % 4 {
        0 => ("obj", "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2 3\n"),
        1 => ("stl", "solid"),
        2 => ("obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
        _ => ("glb", "this is no glb"),
    };
    (format!("{i:03}.{extension}"), text.as_bytes().to_vec())
}

/// A story with one file whose reading does not return: a pipe that nobody writes to.
#[cfg(unix)]
fn stuck() -> Story {
    let story = Story::new();
    let made = std::process::Command::new("mkfifo").arg(story.path("stuck.obj")).status().expect("mkfifo");
    assert!(made.success());
    story
}

fn inputs(lines: &[Value]) -> BTreeSet<String> {
    lines.iter().map(|line| line["input"].as_str().expect("an input").to_owned()).collect()
}

fn last_line(ended: &Ended) -> &str {
    ended.stderr.trim_end().lines().last().unwrap_or_default()
}

#[test]
fn every_file_has_a_line_whatever_the_others_are() {
    let story = Story::new();
    story.many(12);
    let ended = story.run(&format!("batch in --out out --format ply --jobs 2 {SMALL}"));
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    assert!(last_line(&ended).starts_with("error: 1 of 12 files did not come out; "), "{}", ended.stderr);
    for part in ["files             12 after", "certified ", "parse             1, such as "] {
        assert!(ended.stdout.contains(part), "{part} is missing in\n{}", ended.stdout);
    }
    let lines = story.lines("out");
    assert_eq!((lines.len(), inputs(&lines).len()), (12, 12));
    let results = story.results("out");
    for line in &lines {
        let output = line["output"].as_str();
        assert_eq!(output.is_some(), line["err_max"].is_number() && line["kind"].is_null(), "{line}");
        assert_eq!(output.is_none(), line["kind"] == "parse" && line["error"].is_string(), "{line}");
        assert!(output.is_none_or(|name| results.contains_key(&name.replace('\\', "/"))), "{line}");
        assert!(line["seconds"].is_number() && line["options"][0] == "--format=ply", "{line}");
    }
    assert_eq!(results.len(), 11, "nothing else is left: {:?}", results.keys());
    // What a file is remeshed to does not depend on its being one of many.
    story.done(&format!("remesh in/b/001.stl -o alone.ply {SMALL}"));
    assert!(results["b/001.ply"] == story.bytes("alone.ply"));
}

#[test]
fn a_killed_batch_is_resumed_and_every_file_is_done_once() {
    let story = Story::new();
    story.many(40);
    let line = |out: &str| format!("batch in --out {out} --jobs 2 {SMALL}");
    let whole = story.run(&line("whole"));
    assert_eq!(whole.code, Some(1), "{}", whole.stderr);
    let mut batch = story.command(&line("killed")).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("semireg starts");
    while story.lines("killed").len() < 10 && batch.try_wait().expect("a process").is_none() {
        thread::sleep(Duration::from_millis(2));
    }
    batch.kill().expect("it is killed");
    batch.wait().expect("it has ended");
    let done = story.lines("killed");
    assert!((10..40).contains(&done.len()), "killed in the middle: {} lines", done.len());
    let results = story.results("whole");
    let visible = |results: BTreeMap<String, Vec<u8>>| results.into_iter().filter(|(name, _)| !name.starts_with('.'));
    assert!(visible(story.results("killed")).all(|(name, bytes)| results[&name] == bytes), "results are complete");
    // As if the kill had come in the middle of a line.
    let path = story.path("killed/results.jsonl");
    fs::write(&path, [fs::read(&path).unwrap().as_slice(), br#"{"input":"/half"#].concat()).unwrap();
    let resumed = story.run(&format!("{} --resume", line("killed")));
    assert_eq!(resumed.code, Some(1), "{}", resumed.stderr);
    assert!(resumed.stdout.contains(&format!("({} done before)", done.len())), "{}", resumed.stdout);
    let lines = story.lines("killed");
    assert_eq!((lines.len(), inputs(&lines)), (40, inputs(&story.lines("whole"))));
    assert_eq!(lines[..done.len()], done[..], "what was done stays as it is");
    assert!(story.results("killed") == results, "the same bytes, and nothing else");
    assert_eq!(lines.iter().filter(|line| line["output"].is_null()).count(), 4);
}

#[test]
fn old_lines_are_kept_or_refused_but_not_lost() {
    let story = Story::new();
    story.many(3);
    // Without lines, there is nothing to resume, and nothing against it.
    story.done(&format!("batch in --out out --resume {SMALL}"));
    let bytes = story.bytes("out/results.jsonl");
    story.refused(&format!("batch in --out out {SMALL}"), "add --resume to go on with it, or --force");
    let ended = story.run("batch in --out out --resume --base-vertices 20 --levels 2");
    assert!(ended.code == Some(2) && ended.stderr.contains("give the same options"), "{}", ended.stderr);
    assert!(story.done(&format!("batch in --out out --resume {SMALL}")).contains("(3 done before)"));
    assert!(story.bytes("out/results.jsonl") == bytes);
    story.done(&format!("batch in --out out --force {SMALL}"));
    assert_eq!(story.lines("out").len(), 3);
}

#[test]
fn shards_are_the_whole_batch() {
    let story = Story::new();
    story.many(4);
    for part in 1..=3 {
        story.done(&format!("batch in --out parts --shard {part}/3 {SMALL}"));
    }
    let mut lines = 0;
    for part in 1..=3 {
        lines += String::from_utf8(story.bytes(&format!("parts/results-{part}-of-3.jsonl"))).unwrap().lines().count();
    }
    story.done(&format!("batch in --out whole {SMALL}"));
    let mut parts = story.results("parts");
    parts.retain(|name, _| !name.ends_with(".jsonl"));
    assert!(lines == 4 && parts == story.results("whole"));
    assert_eq!(story.run("batch in --out parts --shard 4/3").code, Some(2));
}

#[test]
fn a_list_names_the_files_and_equal_names_are_told_apart() {
    let story = Story::new();
    fs::create_dir_all(story.path("in/a")).unwrap();
    fs::create_dir_all(story.path("in/b")).unwrap();
    let cube = cube(2).to_soup();
    for name in ["in/a/x.obj", "in/b/x.stl", "in/b/x.off"] {
        fs::write(story.path(name), encode(&cube, name).unwrap()).unwrap();
    }
    story.write("list.txt", "in/a/x.obj\nin/b/x.stl\n\nin/b/x.off\nin/b/x.stl\n");
    story.done(&format!("batch --list list.txt --out out {SMALL}"));
    assert_eq!(story.results("out").into_keys().collect::<Vec<_>>(), ["a/x.obj", "b/x.off.obj", "b/x.stl.obj"]);
    let summary = story.json(&format!("batch in/a/x.obj in/b/x.stl --out out2 --json {SMALL}"));
    for (key, value) in [("files", 2), ("certified", 2), ("with_shortcomings", 0), ("failed", 0), ("done_before", 0)] {
        assert_eq!(summary[key], value, "{key}");
    }
    assert_eq!(story.results("out2").into_keys().collect::<Vec<_>>(), ["a/x.obj", "b/x.obj"]);
}

#[test]
fn what_cannot_be_a_batch_is_told_before_the_work() {
    let story = Story::new();
    story.many(2);
    fs::create_dir(story.path("empty")).unwrap();
    story.refused("batch in/a/000.obj --out in/a", "which is an input; name another --out");
    story.refused("batch in --out in", "name another --out");
    story.refused("batch empty --out out", "there is no mesh");
    story.refused("batch --list missing.txt --out out", "cannot read the list missing.txt");
    for line in [
        "batch --out out",
        "batch in",
        "batch in --list list.txt --out out",
        "batch - --out out",
        "batch in --out out --resume --force",
        "batch in --out out --timeout 0",
        "batch in --out out --weak-angle 50",
        "batch in --out out --target-quality 0.5",
    ] {
        assert_eq!(story.run(line).code, Some(2), "semireg {line}");
    }
    assert_eq!(story.files(), ["empty", "in"]);
}

#[cfg(unix)]
#[test]
fn a_file_that_does_not_return_is_given_up_at_its_limits() {
    let story = stuck();
    for (limit, kind) in [("--timeout 0.3", "timeout"), ("--memory 0.0001", "memory")] {
        let ended = story.refused(&format!("batch stuck.obj --out {kind} {limit}"), "1 of 1 files did not come out");
        assert!(ended.stdout.contains(kind), "{}", ended.stdout);
        let lines = story.lines(kind);
        assert_eq!((lines.len(), &lines[0]["kind"], &lines[0]["output"]), (1, &kind.into(), &Value::Null));
        assert!(lines[0]["hint"].as_str().is_some_and(|hint| hint.contains(&limit[..8])), "{}", lines[0]);
        assert!(story.results(kind).is_empty());
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_a_batch_and_leaves_what_is_done() {
    let story = stuck();
    story.write("first.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
    let mut command = story.command(&format!("batch stuck.obj first.obj --out out --jobs 1 {SMALL}"));
    let batch = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("semireg starts");
    while story.lines("out").is_empty() {
        thread::sleep(Duration::from_millis(5));
    }
    let killed = std::process::Command::new("kill").args(["-INT", &batch.id().to_string()]).status().expect("kill");
    assert!(killed.success());
    let output = batch.wait_with_output().expect("semireg ends");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(said.contains("cancelled when 1 of 2 files were not done; add --resume"), "{said}");
    assert_eq!((story.lines("out").len(), story.results("out").into_keys().collect::<Vec<_>>()), (1, vec!["first.obj".into()]));
}

#[test]
fn a_process_of_a_batch_ends_with_its_parent() {
    let story = Story::new();
    let mut command = story.command("remesh @part.obj -o out.obj --base-vertices 400 --levels 4 --end-with-stdin");
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("semireg starts");
    // As when the parent is gone.
    drop(child.stdin.take());
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    assert!(story.files().is_empty(), "{:?}", story.files());
}
