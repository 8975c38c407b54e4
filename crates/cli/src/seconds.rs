//! Wall time of the parts of a run.

use crate::print::Table;
use semireg::StageSeconds;
use serde::{Serialize, Serializer};

/// The parts in order; the last is `total`, the sum of all others.
pub(crate) struct Seconds(Vec<(&'static str, f64)>);

impl Seconds {
    /// Of the stages.
    pub(crate) fn new(stages: &StageSeconds) -> Self {
        Self(stages.0.iter().map(|s| (s.stage, s.seconds)).collect())
    }
    /// Appends a part that is no stage.
    pub(crate) fn add(&mut self, what: &'static str, seconds: f64) {
        self.0.push((what, seconds));
    }
    /// Appends the last part, which took what is left of the total, and the total.
    pub(crate) fn end(&mut self, last: &'static str, total: f64) {
        let before: f64 = self.0.iter().map(|(_, seconds)| seconds).sum();
        self.0.extend([(last, (total - before).max(0.0)), ("total", total.max(before))]);
    }
    /// The total.
    pub(crate) fn total(&self) -> f64 {
        self.0.last().map_or(0.0, |(_, seconds)| *seconds)
    }
    /// Appends the line of all parts.
    pub(crate) fn row(&self, table: &mut Table) {
        let parts: Vec<String> = self.0.iter().map(|(what, seconds)| format!("{what} {seconds:.2}")).collect();
        table.row("seconds", parts.join(", "));
    }
}

impl Serialize for Seconds {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_add_up() {
        let mut seconds = Seconds(vec![("relax", 1.5)]);
        seconds.add("read", 0.25);
        seconds.end("report", 2.0);
        assert_eq!(serde_json::to_string(&seconds).unwrap(), r#"{"relax":1.5,"read":0.25,"report":0.25,"total":2.0}"#);
        assert_eq!(seconds.total(), 2.0);
    }
}
