//! Text files: decoding, words and numbers.

use crate::error::Fault;
use std::borrow::Cow;
use std::iter::Enumerate;
use std::str::{Lines, SplitWhitespace};

/// The text of a file. Bytes that are not UTF-8 (names in an old encoding) are replaced; a byte order mark is dropped; lines
/// that end in a lone carriage return are made to end in a line feed.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let text = String::from_utf8_lossy(without_mark(bytes));
    if text.contains('\r') && !text.contains('\n') { Cow::Owned(text.replace('\r', "\n")) } else { text }
}

/// The bytes without a UTF-8 byte order mark.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// A coordinate. `nan` and `inf` are numbers here: cleaning deals with them.
pub(crate) fn number(word: &str, line: usize) -> Result<f64, Fault> {
    word.parse().map_err(|_| Fault::line(line, format!("{} is not a number", quoted(word))))
}

/// An index or a count.
pub(crate) fn integer(word: &str, line: usize) -> Result<i64, Fault> {
    word.parse().map_err(|_| Fault::line(line, format!("{} is not an integer", quoted(word))))
}

/// A word for an error message, cut short when the file holds no sensible text.
pub(crate) fn quoted(word: &str) -> String {
    const LONGEST: usize = 40;
    match word.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("\"{}...\"", &word[..end]),
        None => format!("\"{word}\""),
    }
}

/// The words of a text across its lines, with the number of the line.
pub(crate) struct Words<'a> {
    lines: Enumerate<Lines<'a>>,
    words: SplitWhitespace<'a>,
    comments: bool,
    first_line: usize,
    line: usize,
}

impl<'a> Words<'a> {
    /// The words of a text whose first line has the number `first_line`.
    pub(crate) fn new(text: &'a str, first_line: usize) -> Self {
        Self { lines: text.lines().enumerate(), words: "".split_whitespace(), comments: false, first_line, line: first_line }
    }
    /// Without everything from a `#` to the end of its line.
    pub(crate) fn without_comments(self) -> Self {
        Self { comments: true, ..self }
    }
    /// The line of the last word.
    pub(crate) fn line(&self) -> usize {
        self.line
    }
    /// Drops what is left of the line; whether that was anything.
    pub(crate) fn end_line(&mut self) -> bool {
        std::mem::replace(&mut self.words, "".split_whitespace()).next().is_some()
    }
    /// The next word; `reading` says what it should belong to if the text ends here.
    pub(crate) fn expect(&mut self, reading: impl FnOnce() -> String) -> Result<&'a str, Fault> {
        self.next().ok_or_else(|| Fault::line(self.line, format!("the file ends in the middle of {}", reading())))
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(word);
            }
            let (i, line) = self.lines.next()?;
            self.line = self.first_line + i;
            let end = if self.comments { line.find('#') } else { None };
            self.words = line[..end.unwrap_or(line.len())].split_whitespace();
        }
    }
}
