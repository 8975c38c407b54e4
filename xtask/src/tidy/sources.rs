//! Form of the files: module docs, length, no path of a machine, a README for every crate.

use crate::process::output;
use crate::root;
use anyhow::Result;
use std::fs;
use std::process::Command;

/// Lines of a source file beyond which it is cut along a noun.
const MAX_LINES: usize = 400;
/// Files that are longer, each with the reason.
const LONGER: &[(&str, &str)] = &[];
/// Beginnings of absolute paths, in two parts so that this file does not hold them.
const MACHINE_PATHS: &[[&str; 2]] =
    &[["/ho", "me/"], ["/ro", "ot/"], ["/tm", "p/"], ["/wor", "k/"], ["/Use", "rs/"], ["../sha", "red"]];
/// May name the folder of models beside the project.
const MAY_NAME_SHARED: &str = ".ci/run";
/// Library crates that may touch files, and those that may print: the edges of the workspace.
const MAY_READ_FILES: &[&str] = &["crates/mesh-io/", "crates/view/", "crates/cli/", "fixtures/", "fuzz/", "xtask/"];
const MAY_PRINT: &[&str] = &["crates/cli/", "fixtures/src/bin/", "xtask/"];

/// Everything that is out of form in the files that git knows or would take.
pub(super) fn check() -> Result<Vec<String>> {
    let list = output(Command::new("git").args(["ls-files", "--cached", "--others", "--exclude-standard"]).current_dir(root()))?;
    let mut problems = Vec::new();
    for file in list.lines() {
        // Meshes and pictures: not text, or of no interest here. A file that was just deleted is still in the list.
        let Ok(content) = fs::read_to_string(root().join(file)) else { continue };
        if file.starts_with("fixtures/data/") {
            continue;
        }
        problems.extend(paths(file, &content));
        if file.ends_with(".rs") {
            problems.extend(source(file, &content));
        }
        if let Some(folder) = file.strip_suffix("Cargo.toml").filter(|f| f.starts_with("crates/")) {
            let readme = fs::read_to_string(root().join(folder).join("README.md")).unwrap_or_default();
            if readme.trim().is_empty() {
                problems.push(format!("{folder}README.md is missing: say in a paragraph what the crate does"));
            }
        }
    }
    Ok(problems)
}

fn paths(file: &str, content: &str) -> Vec<String> {
    let found = |needle: &String| content.contains(needle.as_str()) && file != MAY_NAME_SHARED;
    let needles = MACHINE_PATHS.iter().map(|parts| parts.concat());
    needles.filter(found).map(|needle| format!("{file} holds a path of one machine: {needle}")).collect()
}

fn source(file: &str, content: &str) -> Vec<String> {
    let mut problems = Vec::new();
    if !content.starts_with("//!") {
        problems.push(format!("{file} does not begin with //! docs"));
    }
    let lines = content.lines().count();
    if lines > MAX_LINES && !LONGER.iter().any(|(f, _)| *f == file) {
        problems.push(format!("{file} has {lines} lines: cut it along a noun, or list it with a reason"));
    }
    let library = file.contains("/src/");
    let may = |list: &[&str]| !library || list.iter().any(|prefix| file.starts_with(prefix));
    // Tests at the end of a file may do both.
    let code = content.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    if !may(MAY_READ_FILES) && ["std::fs", "File::open"].iter().any(|w| code.contains(w)) {
        problems.push(format!("{file} touches files: only mesh-io, view and the programs may"));
    }
    if !may(MAY_PRINT) && ["println!", "print!("].iter().any(|w| code.lines().any(|l| l.trim_start().starts_with(w))) {
        problems.push(format!("{file} prints: only programs may"));
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_out_of_form_is_told() {
        assert_eq!(source("crates/relax/src/a.rs", "//! Docs.\nfn f() {}\n"), [""; 0]);
        assert_eq!(source("crates/relax/src/a.rs", "fn f() {}\n").len(), 1);
        assert_eq!(source("crates/relax/src/a.rs", &format!("//! Docs.\n{}", "\n".repeat(MAX_LINES))).len(), 1);
        assert_eq!(source("crates/relax/src/a.rs", "//! Docs.\nfn f() {\n    println!();\n    std::fs::exists();\n}").len(), 2);
        assert_eq!(source("crates/relax/tests/a.rs", "//! Docs.\nuse std::fs;\n"), [""; 0]);
    }

    #[test]
    fn machine_paths_are_found() {
        let line = format!("see {}", MACHINE_PATHS[0].concat());
        assert_eq!(paths("README.md", &line).len(), 1);
        assert_eq!(paths("README.md", "see docs/method.md"), [""; 0]);
    }
}
