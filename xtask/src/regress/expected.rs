//! The stored figures of the fixtures.

use crate::remesher::Outcome;
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// All fixtures by file name.
pub(super) struct Expected {
    path: PathBuf,
    pub(super) fixtures: BTreeMap<String, Entry>,
    /// Fixtures that have no entry in the file and got the default.
    pub(super) new: Vec<String>,
}

/// How a fixture is remeshed and what comes of it.
#[derive(Serialize, Deserialize, Clone)]
pub(super) struct Entry {
    pub(super) base_vertices: usize,
    pub(super) levels: u32,
    /// Figures by name; none for a fixture that is refused.
    expected: Option<BTreeMap<String, f64>>,
}

/// For a fixture without an entry.
const DEFAULT: Entry = Entry { base_vertices: 100, levels: 2, expected: None };

/// Figures that must be the same, and where they are in the report.
const EXACT: &[(&str, &str)] = &[
    ("base_made", "/base_vertices/made"),
    ("vertices", "/vertices"),
    ("faces", "/faces"),
    ("components", "/topology/components"),
    ("euler", "/topology/euler"),
    ("border_loops", "/topology/border_loops"),
    ("flipped", "/flipped"),
    ("degenerate", "/degenerate"),
];

/// A figure that may get better freely, and worse by as much as another machine's rounding or a harmless change makes it.
struct Measured {
    name: &'static str,
    more_is_better: bool,
    /// Share of the stored figure.
    relative: f64,
    /// In units of the figure.
    absolute: f64,
}

const MEASURED: &[Measured] = &[
    Measured { name: "ar_mean", more_is_better: true, relative: 0.0, absolute: 0.005 },
    Measured { name: "ar_p01", more_is_better: true, relative: 0.0, absolute: 0.03 },
    Measured { name: "agl", more_is_better: false, relative: 0.0, absolute: 0.3 },
    Measured { name: "err_mean", more_is_better: false, relative: 0.05, absolute: 1e-7 },
    Measured { name: "err_rms", more_is_better: false, relative: 0.10, absolute: 1e-7 },
    Measured { name: "err_max", more_is_better: false, relative: 0.30, absolute: 1e-6 },
    Measured { name: "crease_cover", more_is_better: true, relative: 0.0, absolute: 0.002 },
];

impl Expected {
    /// The entries of all `files`: those stored, and the default for the others.
    pub(super) fn load(path: &Path, files: &[String]) -> Result<Self> {
        let text = fs::read_to_string(path).unwrap_or_else(|_| "{}".to_owned());
        let stored: BTreeMap<String, Entry> =
            serde_json::from_str(&text).with_context(|| format!("{} is not as we wrote it", path.display()))?;
        let entry = |file: &String| (file.clone(), stored.get(file).cloned().unwrap_or(DEFAULT));
        let new = files.iter().filter(|file| !stored.contains_key(*file)).cloned().collect();
        Ok(Self { path: path.to_owned(), fixtures: files.iter().map(entry).collect(), new })
    }

    pub(super) fn save(&self) -> Result<()> {
        let text = serde_json::to_string_pretty(&self.fixtures)? + "\n";
        fs::write(&self.path, text).with_context(|| format!("cannot write {}", self.path.display()))
    }
}

impl Entry {
    /// Takes the figures of a run as the expected ones.
    pub(super) fn take(&mut self, outcome: &Outcome) {
        self.expected = match outcome {
            Outcome::Remeshed { report, .. } => Some(stored_figures(report)),
            _ => None,
        };
    }

    /// What is worse than expected.
    pub(super) fn compare(&self, outcome: &Outcome) -> Vec<String> {
        match (&self.expected, outcome) {
            (Some(expected), Outcome::Remeshed { report, .. }) => worse(expected, &figures(report)),
            (Some(_), Outcome::Refused { reason, .. }) => vec![format!("refused: {reason}")],
            _ => Vec::new(),
        }
    }
}

/// The figures of a report that are compared; one that is null (no creases) is left out.
fn figures(report: &Value) -> BTreeMap<String, f64> {
    let exact = EXACT.iter().map(|(name, pointer)| (*name, report.pointer(pointer)));
    let measured = MEASURED.iter().map(|m| (m.name, report.get(m.name)));
    exact.chain(measured).filter_map(|(name, value)| Some((name.to_owned(), value?.as_f64()?))).collect()
}

/// The figures with six digits: enough to compare, and quiet in a diff.
fn stored_figures(report: &Value) -> BTreeMap<String, f64> {
    let six_digits = |x: f64| format!("{x:.5e}").parse().unwrap_or(x);
    figures(report).into_iter().map(|(name, x)| (name, six_digits(x))).collect()
}

fn worse(expected: &BTreeMap<String, f64>, found: &BTreeMap<String, f64>) -> Vec<String> {
    let mut problems = Vec::new();
    for (name, &expected) in expected {
        let Some(&found) = found.get(name) else {
            problems.push(format!("{name} is missing from the report"));
            continue;
        };
        let is_worse = match MEASURED.iter().find(|m| m.name == name) {
            Some(m) => {
                let loss = if m.more_is_better { expected - found } else { found - expected };
                loss > m.relative * expected.abs() + m.absolute
            }
            None => found != expected,
        };
        if is_worse {
            problems.push(format!("{name} is {found:.6}, expected {expected:.6}"));
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(name: &str, value: f64) -> BTreeMap<String, f64> {
        BTreeMap::from([(name.to_owned(), value)])
    }

    #[test]
    fn better_is_fine_and_worse_is_not() {
        for (name, expected, fine, bad) in
            [("ar_mean", 0.9, 0.99, 0.89), ("err_mean", 1e-5, 1e-6, 2e-5), ("euler", 2.0, 2.0, 0.0), ("agl", 8.0, 8.2, 8.4)]
        {
            assert!(worse(&set(name, expected), &set(name, fine)).is_empty(), "{name}");
            assert_eq!(worse(&set(name, expected), &set(name, bad)).len(), 1, "{name}");
        }
        assert_eq!(worse(&set("agl", 8.0), &BTreeMap::new()).len(), 1);
    }
}
