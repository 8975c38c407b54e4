//! What stages take of a run.

use super::program::Run;
use crate::cost::Cost;
use crate::markdown::table;
use serde_json::Value;
use std::collections::BTreeMap;

/// Stages that take this many processor seconds in no run are summed up as the rest: their exponents would be those of noise.
const LEAST_SECONDS: f64 = 0.2;
/// Likewise in the table of shares, of the whole run.
const LEAST_SHARE: f64 = 0.03;

/// Stages that take time in any run, the longest first.
pub(super) fn longest<'a>(runs: impl Iterator<Item = &'a Run>) -> Vec<String> {
    greatest(runs, LEAST_SECONDS, &processor_seconds)
}

/// Shares of the stages in percent, a row for each run with a result.
pub(super) fn profile(runs: &[(String, &Run)]) -> String {
    let of_whole = |cost: Cost, report: &Value, stage: &str| processor_seconds(cost, report, stage) / cost.processor_seconds;
    let stages = greatest(runs.iter().map(|(_, run)| *run), LEAST_SHARE, &of_whole);
    let rows = runs.iter().filter_map(|(name, run)| {
        let report = run.report()?;
        let shares: Vec<f64> = stages.iter().map(|stage| 100.0 * of_whole(run.cost(), report, stage)).collect();
        let rest = (100.0 - shares.iter().sum::<f64>()).max(0.0);
        Some([name.clone()].into_iter().chain(shares.iter().chain([&rest]).map(|x| format!("{x:.0}"))).collect())
    });
    let columns = [&["% of the run"], &stages.iter().map(String::as_str).collect::<Vec<_>>()[..], &["rest"]].concat();
    table(&columns, &rows.collect::<Vec<_>>())
}

/// Stages whose value is `least` or more in any run, the greatest first.
fn greatest<'a>(runs: impl Iterator<Item = &'a Run>, least: f64, value: &dyn Fn(Cost, &Value, &str) -> f64) -> Vec<String> {
    let mut greatest: BTreeMap<String, f64> = BTreeMap::new();
    for (run, report) in runs.filter_map(|run| Some((run, run.report()?))) {
        for stage in report["seconds"].as_object().into_iter().flat_map(|seconds| seconds.keys()).filter(|s| *s != "total") {
            let greatest = greatest.entry(stage.clone()).or_default();
            *greatest = greatest.max(value(run.cost(), report, stage));
        }
    }
    let mut stages: Vec<_> = greatest.into_iter().filter(|(_, value)| *value >= least).collect();
    stages.sort_by(|a, b| b.1.total_cmp(&a.1));
    stages.into_iter().map(|(stage, _)| stage).collect()
}

/// A stage's share of the clock, times the processor time of the whole run: on one thread the two differ by what other programs
/// took of the processor.
pub(super) fn processor_seconds(cost: Cost, report: &Value, stage: &str) -> f64 {
    let by_clock = |key: &str| report["seconds"][key].as_f64().unwrap_or(0.0);
    let total = by_clock("total");
    if total > 0.0 { cost.processor_seconds * by_clock(stage) / total } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use std::path::PathBuf;

    #[test]
    fn shares_add_up_to_the_whole() {
        let report = json!({ "seconds": { "relax": 3.0, "read": 0.01, "fit": 0.99, "total": 4.0 } });
        let cost = Cost { processor_seconds: 2.0, seconds: 4.0, megabytes: 100.0 };
        let done = Run::Done { report, cost, output: PathBuf::new() };
        let without = Run::Without { reason: "refused".into(), cost };
        let text = profile(&[("a".into(), &done), ("b".into(), &without)]);
        assert_eq!(text, "| % of the run | relax | fit | rest |\n|---|---|---|---|\n| a | 75 | 25 | 0 |\n");
        assert_eq!(longest([&done, &without].into_iter()), ["relax", "fit"]);
    }
}
