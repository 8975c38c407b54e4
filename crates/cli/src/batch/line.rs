//! What is told of one file. Field names are a contract (docs/batch.md).

use crate::failure::Failure;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// A line of `results.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Line {
    /// The absolute path of the input.
    pub(super) input: String,
    /// The result as a path below the output folder; none where there is no result.
    pub(super) output: Option<String>,
    /// Wall time of the process of this file.
    pub(super) seconds: f64,
    /// What it was remeshed with.
    pub(super) options: Vec<String>,
    #[serde(flatten)]
    pub(super) outcome: Outcome,
}

/// How a file came out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(super) enum Outcome {
    /// There is a result.
    Made {
        verdict: String,
        shortcomings: Vec<String>,
        /// All else that is in its report.
        #[serde(flatten)]
        report: Map<String, Value>,
    },
    /// There is none.
    Failed(Failure),
}

impl Line {
    /// Without the figures of its report, which take most of the memory that the lines of many files would.
    pub(super) fn in_brief(mut self) -> Self {
        if let Outcome::Made { report, .. } = &mut self.outcome {
            report.clear();
        }
        self
    }

    /// What is wrong, with the name of the file, which most errors have themselves.
    pub(super) fn named(&self, failure: &Failure) -> String {
        let (input, error) = (&self.input, failure.to_string());
        if error.contains(input.as_str()) { error } else { format!("{input}: {error}") }
    }
}

impl Outcome {
    /// What the JSON of `semireg remesh` says; none where it is no such JSON.
    pub(super) fn of_report(json: &[u8]) -> Option<Self> {
        let mut report: Map<String, Value> = serde_json::from_slice(json).ok()?;
        // The line has its own of these.
        for name in ["input", "output"] {
            report.remove(name);
        }
        if let Some(seconds) = report.remove("seconds") {
            report.insert("stage_seconds".to_owned(), seconds);
        }
        serde_json::from_value(report.into()).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::failure::Kind;

    fn line(json: &str) -> Line {
        let outcome = Outcome::of_report(json.as_bytes()).unwrap();
        let options = vec!["--levels=1".to_owned()];
        Line { input: "/a/x.obj".to_owned(), output: Some("x.obj".to_owned()), seconds: 1.5, options, outcome }
    }

    fn there_and_back(line: &Line) -> (Value, Line) {
        let text = serde_json::to_string(line).unwrap();
        (serde_json::from_str(&text).unwrap(), serde_json::from_str(&text).unwrap())
    }

    #[test]
    fn a_report_becomes_a_line_and_a_line_is_read_again() {
        let json = r#"{"input":"b","output":"c","verdict":"certified","shortcomings":[],"seconds":{"total":1},"err_max":1e-3}"#;
        let line = line(json);
        let (value, again) = there_and_back(&line);
        assert_eq!(again, line);
        assert_eq!((&value["input"], &value["seconds"]), (&"/a/x.obj".into(), &1.5.into()));
        assert_eq!((&value["stage_seconds"]["total"], &value["err_max"]), (&1.into(), &1e-3.into()));
        assert_eq!((&value["verdict"], &value["options"][0]), (&"certified".into(), &"--levels=1".into()));
    }

    #[test]
    fn so_does_a_failure() {
        let line = line(r#"{"error":"no face is left","kind":"empty","hint":"take another"}"#);
        assert_eq!(line.outcome, Outcome::Failed(Failure::new(Kind::Empty, "no face is left; take another")));
        assert_eq!(there_and_back(&line).1, line);
        assert!(Outcome::of_report(b"{\"verdict\": 1}").is_none() && Outcome::of_report(b"thread panicked").is_none());
    }
}
