//! The program as a user meets it: every test is a story of commands and what comes of them.

mod attributes;
mod base;
mod batch;
mod displacement;
mod failures;
mod outputs;
mod progress;
mod remesh;
mod sizes;
mod streams;
mod summaries;
mod tools;
mod trouble;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// A folder of its own for every story.
struct Story {
    folder: TempDir,
}

/// How a command ended.
struct Ended {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Story {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Puts a file into the folder.
    fn write(&self, name: &str, content: &str) {
        std::fs::write(self.path(name), content).expect("a file in the temporary folder");
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Names of all files and folders in the folder.
    fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).expect("the temporary folder");
        let mut names: Vec<_> = entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Runs `semireg` in the folder; arguments are split at spaces, and `@name` is a fixture.
    fn run(&self, line: &str) -> Ended {
        let output = self.command(line).output().expect("semireg starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        Ended { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }

    fn command(&self, line: &str) -> Command {
        let fixture = |word: &str| word.strip_prefix('@').map_or(word.into(), |name| fixtures().join(name));
        let mut command = Command::new(env!("CARGO_BIN_EXE_semireg"));
        command.args(line.split(' ').map(fixture)).current_dir(self.folder.path());
        command
    }

    /// Runs a command whose output nobody reads; its exit code.
    fn unread(&self, line: &str) -> Option<i32> {
        let mut command = self.command(line);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("semireg starts");
        drop((child.stdout.take(), child.stderr.take()));
        child.wait().expect("semireg ends").code()
    }

    /// Runs a command that must succeed and say nothing on standard error.
    fn done(&self, line: &str) -> String {
        let ended = self.run(line);
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "semireg {line}");
        ended.stdout
    }

    /// Runs a command that must succeed, with all figures; what it says of its stages goes to standard error.
    fn verbose(&self, line: &str) -> Ended {
        let ended = self.run(&format!("{line} --verbose"));
        assert_eq!(ended.code, Some(0), "semireg {line}: {}", ended.stderr);
        ended
    }

    /// Runs a command that must end with 1 and one error line that holds `part`.
    fn refused(&self, line: &str, part: &str) -> Ended {
        let ended = self.run(line);
        assert_eq!(ended.code, Some(1), "semireg {line}: {}", ended.stderr);
        assert!(ended.stderr.starts_with("error: ") && ended.stderr.trim_end().lines().count() == 1, "{}", ended.stderr);
        assert!(ended.stderr.contains(part), "semireg {line}: {}", ended.stderr);
        ended
    }

    fn json(&self, line: &str) -> serde_json::Value {
        serde_json::from_str(&self.done(line)).unwrap_or_else(|e| panic!("semireg {line}: {e}"))
    }
}

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/data")
}
