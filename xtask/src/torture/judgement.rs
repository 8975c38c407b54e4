//! How a run ended, and what its result falls short in.

use serde_json::Value;
use std::fmt::{self, Display, Formatter};

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum End {
    /// Certified, of the input's topology, short of nothing.
    Right,
    /// Certified, but short of what a person expects: each way in a word.
    Short(Vec<String>),
    /// Exit 1, with its reason.
    Refused(String),
    /// It used up the processor time that it may take.
    Stopped,
    /// A panic, an internal error, a signal.
    Panicked(String),
    /// A file that the program's own check does not pass, or a report that contradicts itself.
    Invalid(String),
}

/// What the report's sentences say, in a word: the names of `Shortcoming` in crate `certify`.
const WORDS: [(&str, &str); 5] = [
    ("of the diagonal away", "distance"),
    ("sharp edges are missing", "sharp edges"),
    ("mean quality", "mean shape"),
    ("one triangle in a hundred", "least shape"),
    ("cut others", "cuts"),
];

/// Parts of the topology that a result has in common with its input.
const KEPT: [&str; 3] = ["components", "euler", "border_loops"];

impl End {
    /// Of a run that ended with exit code 0 and a result that passed `check`.
    pub(super) fn of(report: &Value) -> Self {
        let sound = ["flipped", "degenerate"].into_iter().all(|name| report[name] == 0);
        let Some(shortcomings) = report["shortcomings"].as_array().filter(|_| sound) else {
            return Self::Invalid("the report has flipped or degenerate triangles, or no verdict".to_owned());
        };
        let mut causes: Vec<String> = shortcomings.iter().map(|s| word(s.as_str().unwrap_or_default())).collect();
        if KEPT.iter().any(|name| report["topology"][name] != report["topology_original"][name]) {
            causes.push("topology".to_owned());
        }
        if causes.is_empty() { Self::Right } else { Self::Short(causes) }
    }

    /// Of a run that ended without a result. `used_up`: it took all the time that it may take.
    pub(super) fn without(code: Option<i32>, last_error: &str, used_up: bool) -> Self {
        match code {
            Some(1) if last_error.starts_with("error: ") && !last_error.contains("internal error") => {
                Self::Refused(last_error.to_owned())
            }
            None if used_up => Self::Stopped,
            Some(code) => Self::Panicked(format!("exit {code}: {last_error}")),
            None => Self::Panicked(format!("ended by a signal: {last_error}")),
        }
    }

    /// What must not happen on any input.
    pub(super) fn is_fault(&self) -> bool {
        matches!(self, Self::Panicked(_) | Self::Invalid(_))
    }

    /// The name of the end alone.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Short(_) => "short",
            Self::Refused(_) => "refused",
            Self::Stopped => "stopped",
            Self::Panicked(_) => "panicked",
            Self::Invalid(_) => "invalid",
        }
    }

    /// Why it is not right: of a refusal and of faults without the numbers, so that equal ones are counted together.
    pub(super) fn causes(&self) -> Vec<String> {
        let without_numbers = |text: &str| text.chars().map(|c| if c.is_ascii_digit() { '#' } else { c }).collect::<String>();
        match self {
            Self::Right => Vec::new(),
            Self::Short(causes) => causes.clone(),
            Self::Stopped => vec!["stopped".to_owned()],
            Self::Refused(text) | Self::Panicked(text) | Self::Invalid(text) => {
                let text = without_numbers(text.strip_prefix("error: ").unwrap_or(text));
                vec![format!("{}: {}", self.name(), text.chars().take(100).collect::<String>())]
            }
        }
    }
}

/// A sentence of the report in a word; one that is not known as it is.
fn word(sentence: &str) -> String {
    WORDS.iter().find(|(part, _)| sentence.contains(part)).map_or(sentence, |(_, word)| word).to_owned()
}

impl Display for End {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Right | Self::Stopped => f.write_str(self.name()),
            Self::Short(causes) => write!(f, "short: {}", causes.join(", ")),
            Self::Refused(text) | Self::Panicked(text) | Self::Invalid(text) => write!(f, "{}: {text}", self.name()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn report(shortcomings: &[&str], components: usize) -> Value {
        let topology = |components: usize| json!({ "components": components, "euler": 2, "border_loops": 0 });
        json!({ "flipped": 0, "degenerate": 0, "shortcomings": shortcomings, "topology": topology(components), "topology_original": topology(1) })
    }

    #[test]
    fn a_result_is_right_when_nothing_is_said_against_it() {
        assert_eq!(End::of(&report(&[], 1)), End::Right);
        assert_eq!(End::of(&report(&[], 2)), End::Short(vec!["topology".to_owned()]));
        let said = ["its triangles have a mean quality of 0.71", "3.1 % of the sharp edges are missing", "it is odd"];
        assert_eq!(End::of(&report(&said, 1)).causes(), ["mean shape", "sharp edges", "it is odd"]);
        assert!(End::of(&json!({})).is_fault());
    }

    #[test]
    fn ends_without_a_result_are_told_apart() {
        let end = |code, text, used_up| End::without(code, text, used_up);
        assert_eq!(end(Some(1), "error: 3 folds", false).causes(), ["refused: # folds"]);
        assert!(!end(Some(1), "error: 3 folds", false).is_fault());
        assert!(end(Some(1), "error: internal error: lost", false).is_fault());
        assert!(end(Some(101), "panicked", false).is_fault());
        assert_eq!(end(None, "", true), End::Stopped);
        assert!(end(None, "", false).is_fault());
    }
}
