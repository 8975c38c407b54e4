//! The stored figures of the fixtures: what counts must be, and the best that was ever reached of what is measured.
//!
//! A run is compared with the best, not with the run before: many steps that each lose a little are found as one that loses as much.

use crate::remesher::Outcome;
use anyhow::{Context, Result, bail};
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
#[serde(deny_unknown_fields)]
pub(super) struct Entry {
    pub(super) base_vertices: usize,
    pub(super) levels: u32,
    /// `None` for a fixture that is refused, or new.
    expected: Option<Figures>,
}

/// Figures by name.
#[derive(Serialize, Deserialize, Clone, Debug, Default, PartialEq)]
#[serde(deny_unknown_fields)]
struct Figures {
    /// Must be the same; those of [`COUNTS`].
    counts: BTreeMap<String, i64>,
    /// The best ever recorded; those of [`MEASURED`].
    best: BTreeMap<String, f64>,
}

/// For a fixture without an entry.
const DEFAULT: Entry = Entry { base_vertices: 100, levels: 2, expected: None };

/// Figures that must be the same, and where they are in the report.
const COUNTS: &[(&str, &str)] = &[
    ("base_made", "/base_vertices/made"),
    ("vertices", "/vertices"),
    ("faces", "/faces"),
    ("components", "/topology/components"),
    ("euler", "/topology/euler"),
    ("border_loops", "/topology/border_loops"),
];

/// Parts of the topology that a result has in common with its cleaned input.
const KEPT: &[&str] = &["components", "euler", "border_loops"];

/// A figure that may get better freely. All in all, not in each step, it may be worse than the best by as much as another machine's
/// rounding or a harmless change makes it.
struct Measured {
    name: &'static str,
    more_is_better: bool,
    /// Share of the best.
    relative: f64,
    /// In units of the figure.
    absolute: f64,
}

const MEASURED: &[Measured] = &[
    Measured { name: "ar_mean", more_is_better: true, relative: 0.0, absolute: 0.005 },
    Measured { name: "ar_p01", more_is_better: true, relative: 0.0, absolute: 0.03 },
    // One triangle alone decides these two. Shares: where it is a needle, a degree is all it has.
    Measured { name: "ar_min", more_is_better: true, relative: 0.10, absolute: 0.0 },
    Measured { name: "angle_min", more_is_better: true, relative: 0.10, absolute: 0.0 },
    Measured { name: "agl", more_is_better: false, relative: 0.0, absolute: 0.3 },
    Measured { name: "area_cv", more_is_better: false, relative: 0.05, absolute: 0.01 },
    Measured { name: "err_mean", more_is_better: false, relative: 0.05, absolute: 1e-7 },
    Measured { name: "err_rms", more_is_better: false, relative: 0.10, absolute: 1e-7 },
    Measured { name: "err_max", more_is_better: false, relative: 0.20, absolute: 1e-6 },
    Measured { name: "crease_cover", more_is_better: true, relative: 0.0, absolute: 0.002 },
    // None where there was none; where the input passes through itself, how many triangles meet there depends on where edges run.
    Measured { name: "self_intersecting", more_is_better: false, relative: 0.05, absolute: 0.0 },
    Measured { name: ATTEMPTS, more_is_better: false, relative: 0.0, absolute: 0.0 },
    Measured { name: "warnings", more_is_better: false, relative: 0.0, absolute: 0.0 },
];

/// How many results were made until one was good enough. Programs that do not tell made one.
const ATTEMPTS: &str = "attempts";

impl Measured {
    /// By how much `found` is worse than `than`; negative where it is better.
    fn loss(&self, found: f64, than: f64) -> f64 {
        if self.more_is_better { than - found } else { found - than }
    }

    fn is_worse(&self, found: f64, best: f64) -> bool {
        self.loss(found, best) > self.relative * best.abs() + self.absolute
    }
}

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

    /// Fails where one of the names is no fixture.
    pub(super) fn must_have(&self, names: &[String]) -> Result<()> {
        match names.iter().find(|name| !self.fixtures.contains_key(*name)) {
            Some(name) => bail!("there is no fixture {name}"),
            None => Ok(()),
        }
    }

    pub(super) fn save(&self) -> Result<()> {
        let text = serde_json::to_string_pretty(&self.fixtures)? + "\n";
        fs::write(&self.path, text).with_context(|| format!("cannot write {}", self.path.display()))
    }
}

impl Entry {
    /// What is worse than expected. A result of a fixture that was refused so far has nothing to be compared with but its input.
    pub(super) fn compare(&self, outcome: &Outcome) -> Vec<String> {
        match (&self.expected, outcome) {
            (expected, Outcome::Remeshed { report, .. }) => {
                let found = Figures::of(report);
                let compared = expected.as_ref().map(|expected| expected.compare(&found));
                unsound(report).into_iter().chain(compared.unwrap_or_default()).collect()
            }
            (Some(_), Outcome::Refused { reason, .. }) => vec![format!("refused: {reason}")],
            // A fault is told by itself.
            _ => Vec::new(),
        }
    }

    /// Takes the counts of a run, and what is better than the best; with `accept_worse` also what is worse. Returns what is worse and
    /// was not taken.
    pub(super) fn update(&mut self, outcome: &Outcome, accept_worse: bool) -> Vec<String> {
        match (&mut self.expected, outcome) {
            (Some(expected), Outcome::Remeshed { report, .. }) if !accept_worse => {
                expected.take_better(Figures::of(report));
                self.compare(outcome)
            }
            (expected, Outcome::Remeshed { report, .. }) => {
                *expected = Some(Figures::of(report));
                unsound(report)
            }
            (expected, Outcome::Refused { .. }) if accept_worse => {
                *expected = None;
                Vec::new()
            }
            _ => self.compare(outcome),
        }
    }
}

impl Figures {
    /// Those of a report; one that is null (no creases) or missing is left out. With six digits: enough to compare, and quiet in a diff.
    fn of(report: &Value) -> Self {
        let count = |pointer: &str| report.pointer(pointer).and_then(Value::as_i64);
        let six_digits = |x: f64| format!("{x:.5e}").parse().unwrap_or(x);
        let measured = |name: &str| match &report[name] {
            Value::Array(list) => Some(list.len() as f64),
            value => value.as_f64().map(six_digits),
        };
        Self {
            counts: COUNTS.iter().filter_map(|(name, pointer)| Some(((*name).to_owned(), count(pointer)?))).collect(),
            best: MEASURED.iter().filter_map(|m| Some((m.name.to_owned(), measured(m.name)?))).collect(),
        }
    }

    /// In which figures another run is worse than these.
    fn compare(&self, found: &Self) -> Vec<String> {
        let mut problems = Vec::new();
        for (name, expected) in &self.counts {
            match found.counts.get(name) {
                Some(found) if found == expected => {}
                Some(found) => problems.push(format!("{name} is {found}, expected {expected}")),
                None => problems.push(format!("{name} is missing from the report")),
            }
        }
        for measured in MEASURED {
            let name = measured.name;
            let found = found.best.get(name).copied();
            match (self.best.get(name), found.or((name == ATTEMPTS).then_some(1.0))) {
                (Some(&best), Some(found)) if measured.is_worse(found, best) => {
                    problems.push(format!("{name} is {found:.6}, the best so far {best:.6}"));
                }
                (Some(_), None) => problems.push(format!("{name} is missing from the report")),
                (None, Some(_)) if found.is_some() => problems.push(format!("{name} is not stored yet: run with --update")),
                _ => {}
            }
        }
        problems
    }

    /// Takes the counts of another run, and the better of each figure.
    fn take_better(&mut self, found: Self) {
        self.counts = found.counts;
        for measured in MEASURED {
            let Some(&found) = found.best.get(measured.name) else { continue };
            let best = self.best.entry(measured.name.to_owned()).or_insert(found);
            if measured.loss(found, *best) < 0.0 {
                *best = found;
            }
        }
    }
}

/// What must not be of any result, whatever was stored: triangles without area or turned over, another topology than the cleaned input's.
fn unsound(report: &Value) -> Vec<String> {
    let bad = ["flipped", "degenerate"].into_iter().filter(|&name| report[name] != 0);
    let mut problems: Vec<String> = bad.map(|name| format!("{name} is {}, must be 0", report[name])).collect();
    for &name in KEPT {
        let [result, input] = ["topology", "topology_original"].map(|of| &report[of][name]);
        if result != input {
            problems.push(format!("{name} is {result}, of the input {input}"));
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// A sound report with other figures.
    fn report(other: Value) -> Value {
        let topology = json!({ "components": 1, "euler": 2, "border_loops": 0 });
        let mut report =
            json!({ "vertices": 10, "flipped": 0, "degenerate": 0, "topology": topology, "topology_original": topology });
        for (name, value) in other.as_object().into_iter().flatten() {
            report[name] = value.clone();
        }
        report
    }

    fn remeshed(other: Value) -> Outcome {
        Outcome::Remeshed { output: PathBuf::new(), report: report(other), seconds: 1.0 }
    }

    fn refused() -> Outcome {
        Outcome::Refused { reason: "error: folded".to_owned(), seconds: 1.0 }
    }

    fn entry(other: Value) -> Entry {
        Entry { expected: Some(Figures::of(&report(other))), ..DEFAULT }
    }

    #[test]
    fn better_is_fine_and_worse_is_not() {
        for (name, best, fine, bad) in [
            ("ar_mean", 0.9, 0.99, 0.89),
            ("ar_min", 0.03, 0.028, 0.026),
            ("angle_min", 20.0, 18.5, 17.0),
            ("agl", 8.0, 8.2, 8.4),
            ("area_cv", 0.4, 0.42, 0.44),
            ("err_mean", 1e-5, 1e-6, 2e-5),
            ("err_max", 1e-3, 1.1e-3, 1.3e-3),
            ("self_intersecting", 0.0, 0.0, 1.0),
            ("self_intersecting", 100.0, 105.0, 106.0),
        ] {
            let entry = entry(json!({ name: best }));
            assert_eq!(entry.compare(&remeshed(json!({ name: fine }))), [""; 0], "{name}");
            assert_eq!(entry.compare(&remeshed(json!({ name: bad }))).len(), 1, "{name}");
            assert_eq!(entry.compare(&remeshed(json!({}))), [format!("{name} is missing from the report")]);
        }
        assert_eq!(entry(json!({})).compare(&remeshed(json!({ "vertices": 11 }))), ["vertices is 11, expected 10"]);
        assert_eq!(entry(json!({})).compare(&remeshed(json!({ "agl": 8.0 }))), ["agl is not stored yet: run with --update"]);
        assert_eq!(entry(json!({})).compare(&refused()), ["refused: error: folded"]);
    }

    #[test]
    fn attempts_and_warnings_are_counted() {
        let once = entry(json!({ "attempts": [{}], "warnings": [] }));
        assert_eq!(once.compare(&remeshed(json!({ "warnings": [] }))), [""; 0]);
        assert_eq!(once.compare(&remeshed(json!({ "attempts": [{}, {}], "warnings": [] }))).len(), 1);
        assert_eq!(once.compare(&remeshed(json!({ "attempts": [{}], "warnings": ["a"] }))).len(), 1);
        let thrice = entry(json!({ "attempts": [{}, {}, {}] }));
        assert_eq!(thrice.compare(&remeshed(json!({ "attempts": [{}, {}] }))), [""; 0]);
        // A program that does not tell its attempts fixes nothing for one that does.
        assert_eq!(entry(json!({})).expected.unwrap().best.get(ATTEMPTS), None);
    }

    #[test]
    fn quality_does_not_slide_step_by_step() {
        let mut entry = entry(json!({ "ar_mean": 0.9 }));
        let step = |entry: &mut Entry, ar: f64| entry.update(&remeshed(json!({ "ar_mean": ar })), false).len();
        assert_eq!([0.898, 0.896, 0.894, 0.892].map(|ar| step(&mut entry, ar)), [0, 0, 1, 1]);
        // What is better is the new best at once.
        assert_eq!([0.92, 0.918, 0.91].map(|ar| step(&mut entry, ar)), [0, 0, 1]);
        assert_eq!(entry.update(&remeshed(json!({ "ar_mean": 0.8 })), true), [""; 0]);
        assert_eq!(entry.compare(&remeshed(json!({ "ar_mean": 0.8 }))), [""; 0]);
    }

    #[test]
    fn an_update_takes_counts_and_new_figures() {
        let mut entry = entry(json!({}));
        assert_eq!(entry.update(&remeshed(json!({ "vertices": 11, "agl": 8.0 })), false), [""; 0]);
        assert_eq!(entry.compare(&remeshed(json!({ "vertices": 11, "agl": 8.0 }))), [""; 0]);
    }

    #[test]
    fn a_refusal_is_not_taken_unasked() {
        let mut entry = entry(json!({}));
        assert_eq!(entry.update(&refused(), false).len(), 1);
        assert!(entry.expected.is_some());
        assert_eq!(entry.update(&refused(), true), [""; 0]);
        assert_eq!(entry.compare(&refused()), [""; 0]);
    }

    #[test]
    fn what_was_refused_must_be_sound_once_it_is_accepted() {
        let mut entry = Entry { expected: None, ..DEFAULT };
        assert_eq!(entry.compare(&remeshed(json!({ "ar_mean": 0.1 }))), [""; 0]);
        assert_eq!(entry.compare(&remeshed(json!({ "flipped": 1 }))), ["flipped is 1, must be 0"]);
        let torn = json!({ "topology": { "components": 2, "euler": 2, "border_loops": 0 } });
        assert_eq!(entry.compare(&remeshed(torn)), ["components is 2, of the input 1"]);
        assert_eq!(entry.update(&remeshed(json!({ "flipped": 1 })), true).len(), 1);
        entry.update(&remeshed(json!({ "ar_mean": 0.9 })), false);
        assert_eq!(entry.compare(&remeshed(json!({ "ar_mean": 0.8 }))).len(), 1);
    }
}
