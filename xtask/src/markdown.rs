//! Tables of figures in documents whose text is by hand.

use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// What is written here goes between these lines; the text around them is by hand and stays.
const MARKS: [&str; 2] = [
    "<!-- From here to the next mark it is written by a chore of xtask: changes are lost. -->",
    "<!-- From here on by hand. -->",
];

/// Longest reason in a table.
const REASON_CHARS: usize = 150;

/// Replaces what is between the marks of a document.
pub(crate) fn put(path: &Path, text: &str) -> Result<()> {
    let document = fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    let document = put_between(&document, text).with_context(|| path.display().to_string())?;
    fs::write(path, document).with_context(|| format!("cannot write {}", path.display()))
}

/// Whether the text is what is between the marks of a document.
pub(crate) fn holds(path: &Path, text: &str) -> Result<bool> {
    let document = fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    Ok(put_between(&document, text).with_context(|| path.display().to_string())? == document)
}

fn put_between(document: &str, text: &str) -> Result<String> {
    let Some((before, rest)) = document.split_once(MARKS[0]) else { bail!("the mark is missing: put in the line {}", MARKS[0]) };
    let Some((_, after)) = rest.split_once(MARKS[1]) else { bail!("the mark is missing: put in the line {}", MARKS[1]) };
    Ok([before, MARKS[0], "\n\n", text.trim(), "\n\n", MARKS[1], after].concat())
}

/// A table; nothing without rows.
pub(crate) fn table<C: AsRef<str>>(columns: &[C], rows: &[Vec<String>]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let columns: Vec<&str> = columns.iter().map(AsRef::as_ref).collect();
    let mut text = format!("| {} |\n|{}\n", columns.join(" | "), "---|".repeat(columns.len()));
    for row in rows {
        let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
        text += &format!("| {} |\n", cells.join(" | "));
    }
    text
}

/// Columns of [`figures`].
pub(crate) const FIGURES: [&str; 8] =
    ["AR mean", "AR p01", "Agl", "area CV", "error mean", "error max", "crease cover", "flipped"];

/// A mean error, a share of the diagonal, as tables have it.
pub(crate) fn error(share: f64) -> String {
    format!("{:.2}e-5", 1e5 * share)
}

/// Cells of the figures of a report; `-` for one that it does not have.
pub(crate) fn figures(report: &Value) -> Vec<String> {
    let real = |key: &str, text: &dyn Fn(f64) -> String| report[key].as_f64().map_or("-".to_owned(), text);
    vec![
        real("ar_mean", &|x| format!("{x:.3}")),
        real("ar_p01", &|x| format!("{x:.3}")),
        real("agl", &|x| format!("{x:.2}")),
        real("area_cv", &|x| format!("{x:.2}")),
        real("err_mean", &error),
        real("err_max", &|x| format!("{:.2}e-3", 1e3 * x)),
        real("crease_cover", &|x| format!("{x:.3}")),
        real("flipped", &|x| format!("{x}")),
    ]
}

/// A message cut to a line. One that begins with the path of the first file loses it; else paths become file names.
pub(crate) fn reason(message: &str, files: &[&Path]) -> String {
    let mut line = message.strip_prefix("error: ").unwrap_or(message).lines().next().unwrap_or_default().to_owned();
    if let Some(rest) = files.first().and_then(|file| line.strip_prefix(&format!("{}: ", file.display()))) {
        line = rest.to_owned();
    }
    for file in files {
        line = line.replace(&file.display().to_string(), &file.file_name().unwrap_or_default().to_string_lossy());
    }
    match line.char_indices().nth(REASON_CHARS) {
        Some((end, _)) => format!("{} ...", line[..end].trim_end()),
        None => line,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn only_what_is_between_the_marks_is_replaced() {
        let [begin, end] = MARKS;
        let document = format!("By hand.\n{begin}\n\nold\n\n{end}\nBy hand too.\n");
        let new = put_between(&document, "new\n").unwrap();
        assert_eq!(new, format!("By hand.\n{begin}\n\nnew\n\n{end}\nBy hand too.\n"));
        assert_eq!(put_between(&new, "new").unwrap(), new);
        assert!(put_between("no marks", "new").is_err());
        assert!(put_between(begin, "new").is_err());
    }

    #[test]
    fn tables_are_markdown() {
        let rows = [vec!["a|b".to_owned(), "1".to_owned()]];
        assert_eq!(table(&["model", "n"], &rows), "| model | n |\n|---|---|\n| a\\|b | 1 |\n");
        assert_eq!(table(&["model"], &[]), "");
    }

    #[test]
    fn figures_have_a_cell_for_each_column() {
        let report = json!({ "ar_mean": 0.9021, "agl": 6.78, "err_mean": 1.966e-5, "err_max": 1.3e-3, "flipped": 0, "crease_cover": null });
        assert_eq!(figures(&report), ["0.902", "-", "6.78", "-", "1.97e-5", "1.30e-3", "-", "0"]);
        assert_eq!(figures(&report).len(), FIGURES.len());
    }

    #[test]
    fn reasons_are_cut_between_characters() {
        assert_eq!(reason("error: no surface\nmore", &[]), "no surface");
        let long = reason(&"ä".repeat(REASON_CHARS + 1), &[]);
        assert_eq!(long.chars().filter(|&c| c == 'ä').count(), REASON_CHARS);
        assert!(long.ends_with(" ..."));
    }

    #[test]
    fn reasons_hold_no_path() {
        let files = ["models/a.obj", "bases/b.ply"].map(Path::new);
        assert_eq!(reason("error: models/a.obj: it is folded", &files), "it is folded");
        assert_eq!(reason("error: models/a.obj:6: no number", &files), "a.obj:6: no number");
        assert_eq!(reason("error: bases/b.ply does not fit models/a.obj", &files), "b.ply does not fit a.obj");
    }
}
