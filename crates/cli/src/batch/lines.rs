//! The file of lines, one for each file that is done.

use super::line::Line;
use crate::failure::{Failure, Kind};
use anyhow::Context as _;
use fs4::{FileExt, TryLockError};
use std::fs::{File, OpenOptions};
use std::io::{Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// What to do with lines that are there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Opening {
    /// Refuse them.
    New,
    /// Keep them, and go on after them.
    Resume,
    /// Drop them.
    Anew,
}

/// The file of lines, open and locked: no other batch writes into it.
pub(super) struct LinesFile {
    path: PathBuf,
    file: Mutex<File>,
}

impl LinesFile {
    /// Opens the file, or makes it; returns the lines that are kept, in brief. A last line that is not complete is dropped: its file is not done.
    pub(super) fn open(path: &Path, opening: Opening) -> anyhow::Result<(Self, Vec<Line>)> {
        let name = path.display();
        if opening == Opening::New && path.exists() {
            let message = format!("{name} is there already; add --resume to go on with it, or --force to lose it and begin anew");
            return Err(Failure::new(Kind::Overwrite, message).into());
        }
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .with_context(|| format!("cannot open {name}; check the permissions of its folder"))?;
        // Named in full: newer versions of std have a method of the same name. Where the file system knows no locks, we do without.
        if let Err(TryLockError::WouldBlock) = FileExt::try_lock(&file) {
            let message = format!("another batch is writing {name}; wait for its end, or name another --out");
            return Err(Failure::new(Kind::Overwrite, message).into());
        }
        let lines = if opening == Opening::Anew { Vec::new() } else { kept(&mut file, path)? };
        if lines.is_empty() {
            file.set_len(0).with_context(|| format!("cannot empty {name}"))?;
        }
        file.seek(SeekFrom::End(0)).with_context(|| format!("cannot write {name}"))?;
        Ok((Self { path: path.to_owned(), file: Mutex::new(file) }, lines))
    }

    /// Appends a line, whole.
    pub(super) fn append(&self, line: &Line) -> anyhow::Result<()> {
        let text = serde_json::to_string(line)? + "\n";
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let written = file.write_all(text.as_bytes()).and_then(|()| file.flush());
        written.with_context(|| format!("cannot write a line into {}; see whether the disk is full", self.path.display()))
    }
}

impl Drop for LinesFile {
    /// Unlocks by name: a child process that is just being started has the open file as well, and would hold the lock a moment longer.
    fn drop(&mut self) {
        let file = self.file.get_mut().unwrap_or_else(PoisonError::into_inner);
        // A lock that cannot be given back ends with the process.
        let _ = FileExt::unlock(file);
    }
}

/// The complete lines of a file, which is cut off after them.
fn kept(file: &mut File, path: &Path) -> anyhow::Result<Vec<Line>> {
    let name = path.display();
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).with_context(|| format!("cannot read {name}"))?;
    let complete = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
    bytes.truncate(complete);
    file.set_len(complete as u64).with_context(|| format!("cannot drop the half-written last line of {name}"))?;
    let lines = bytes.split(|&byte| byte == b'\n').filter(|line| !line.is_empty());
    lines
        .enumerate()
        .map(|(i, line)| {
            let message = |e| format!("{name}:{}: this is no line of a batch ({e}); correct or remove it", i + 1);
            let line: Line = serde_json::from_slice(line).map_err(|e| Failure::new(Kind::Parse, message(e)))?;
            Ok(line.in_brief())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::line::Outcome;
    use super::*;
    use std::fs;

    fn line(input: &str) -> Line {
        let outcome = Outcome::Failed(Failure::new(Kind::Empty, "no face is left"));
        Line { input: input.to_owned(), output: None, seconds: 0.25, options: Vec::new(), outcome }
    }

    fn refused(path: &Path, opening: Opening) -> String {
        LinesFile::open(path, opening).err().map(|e| Failure::of(e).to_string()).expect("an error")
    }

    #[test]
    fn a_half_written_last_line_is_dropped_wherever_it_was_cut() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("results.jsonl");
        let (file, _) = LinesFile::open(&path, Opening::New).unwrap();
        for input in ["a", "b"] {
            file.append(&line(input)).unwrap();
        }
        drop(file);
        let whole = fs::read(&path).unwrap();
        let first = whole.iter().position(|&b| b == b'\n').unwrap() + 1;
        for cut in 0..=whole.len() {
            fs::write(&path, &whole[..cut]).unwrap();
            let (file, lines) = LinesFile::open(&path, Opening::Resume).unwrap();
            let complete = usize::from(cut >= first) + usize::from(cut == whole.len());
            assert_eq!(lines, [line("a"), line("b")][..complete], "cut after {cut} bytes");
            for input in &["a", "b"][complete..] {
                file.append(&line(input)).unwrap();
            }
            assert_eq!(fs::read(&path).unwrap(), whole, "cut after {cut} bytes");
        }
    }

    #[test]
    fn old_lines_are_not_lost_unless_the_user_wants_that() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("results.jsonl");
        LinesFile::open(&path, Opening::New).unwrap().0.append(&line("a")).unwrap();
        assert!(refused(&path, Opening::New).contains("add --resume to go on with it, or --force"));
        assert_eq!(LinesFile::open(&path, Opening::Resume).unwrap().1.len(), 1);
        assert!(LinesFile::open(&path, Opening::Anew).unwrap().1.is_empty());
        assert_eq!(fs::read(&path).unwrap(), b"");
    }

    #[test]
    fn two_batches_do_not_write_one_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("results.jsonl");
        let (_held, _) = LinesFile::open(&path, Opening::New).unwrap();
        assert!(refused(&path, Opening::Resume).contains("another batch is writing"));
    }

    #[test]
    fn what_is_no_line_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("results.jsonl");
        fs::write(&path, serde_json::to_string(&line("a")).unwrap() + "\nnone\n").unwrap();
        assert!(refused(&path, Opening::Resume).contains("results.jsonl:2: this is no line of a batch"));
    }
}
