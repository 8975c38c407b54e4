//! Processor time by size and by stage, and how fast it grows.

use super::program::{Job, Program, Run, seconds};
use super::stages::{longest, processor_seconds};
use crate::cost::Cost;
use crate::markdown::table;
use anyhow::Result;
use serde_json::Value;

/// One run: its size, and what it took.
struct Point {
    label: String,
    size: f64,
    run: Run,
}

/// Runs of growing input, by name of the job and its triangles.
pub(super) fn by_input(program: &Program, jobs: &[(Job, usize)]) -> Result<String> {
    let mut points = Vec::new();
    for (job, triangles) in jobs {
        let run = told(&job.name, program.remesh(job, 1)?);
        points.push(Point { label: triangles.to_string(), size: *triangles as f64, run });
    }
    Ok(text("triangles in", &points))
}

/// Runs of growing output.
pub(super) fn by_level(program: &Program, jobs: &[Job]) -> Result<String> {
    let mut points = Vec::new();
    for job in jobs {
        let run = told(&format!("{} at level {}", job.name, job.levels), program.remesh(job, 1)?);
        let vertices = run.report().and_then(|report| report["vertices"].as_u64()).unwrap_or(0);
        points.push(Point { label: format!("{} ({vertices})", job.levels), size: vertices as f64, run });
    }
    Ok(text("level (vertices out)", &points))
}

/// Prints a run as it ends.
pub(super) fn told(name: &str, run: Run) -> Run {
    println!("{name}: {}", run.cells().join("  "));
    run
}

fn text(size: &str, points: &[Point]) -> String {
    let stages = longest(points.iter().map(|point| &point.run));
    let columns = [&[size, "processor s", "MB"], &stages.iter().map(String::as_str).collect::<Vec<_>>()[..], &["rest"]].concat();
    let rows = points.iter().map(|point| row(point, &stages));
    table(&columns, &rows.chain([exponents(points, &stages)]).collect::<Vec<_>>())
}

fn row(point: &Point, stages: &[String]) -> Vec<String> {
    let cost = point.run.cost();
    let (total, of_stages) = match &point.run {
        Run::Done { report, .. } => {
            let parts: Vec<f64> = stages.iter().map(|stage| processor_seconds(cost, report, stage)).collect();
            let rest = cost.processor_seconds - parts.iter().sum::<f64>();
            (seconds(cost.processor_seconds), parts.iter().chain([&rest]).map(|x| format!("{:.2}", x.max(0.0))).collect())
        }
        Run::Without { reason, .. } => (reason.clone(), vec!["-".to_owned(); stages.len() + 1]),
    };
    [vec![point.label.clone(), total, format!("{:.0}", cost.megabytes)], of_stages].concat()
}

/// The last row: exponents of all columns.
fn exponents(points: &[Point], stages: &[String]) -> Vec<String> {
    let growth = |value: &dyn Fn(Cost, &Value) -> f64| {
        let done = points.iter().filter_map(|p| Some([p.size, value(p.run.cost(), p.run.report()?)]));
        exponent(&done.collect::<Vec<_>>()).map_or("-".to_owned(), |x| format!("{x:.2}"))
    };
    let whole = [growth(&|cost, _| cost.processor_seconds), growth(&|cost, _| cost.megabytes)];
    let of_stages = stages.iter().map(|stage| growth(&|cost, report| processor_seconds(cost, report, stage)));
    [&["exponent".to_owned()], &whole[..], &of_stages.collect::<Vec<_>>(), &["-".to_owned()]].concat()
}

/// The exponent of the power of `x` that fits `y` best: the least-squares slope of their logarithms. `None` without two different
/// sizes, or where anything is not positive.
fn exponent(points: &[[f64; 2]]) -> Option<f64> {
    if points.iter().flatten().any(|&x| x <= 0.0) {
        return None;
    }
    let logs: Vec<[f64; 2]> = points.iter().map(|p| p.map(f64::ln)).collect();
    let mean = |i: usize| logs.iter().map(|p| p[i]).sum::<f64>() / logs.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let spread: f64 = logs.iter().map(|p| (p[0] - x).powi(2)).sum();
    (spread > 0.0).then(|| logs.iter().map(|p| (p[0] - x) * (p[1] - y)).sum::<f64>() / spread)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use std::path::PathBuf;

    #[test]
    fn the_exponent_of_a_power_is_its_own() {
        let power = |p: f64| [1e4, 1e5, 1e6].map(|x: f64| [x, 3.0 * x.powf(p)]);
        for p in [0.0, 0.5, 1.0, 2.0] {
            assert!((exponent(&power(p)).unwrap() - p).abs() < 1e-9);
        }
        // Least squares of three points in equal steps: the middle one does not turn the line.
        assert!((exponent(&[[1.0, 1.0], [10.0, 1e3], [100.0, 100.0]]).unwrap() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn without_two_sizes_there_is_no_exponent() {
        assert_eq!(exponent(&[]), None);
        assert_eq!(exponent(&[[5.0, 1.0], [5.0, 2.0]]), None);
        assert_eq!(exponent(&[[5.0, 1.0], [6.0, 0.0]]), None);
    }

    #[test]
    fn stages_are_shares_of_the_processor_time() {
        let run = |n: f64| {
            let report = json!({ "seconds": { "relax": 3.0 * n, "read": 0.001, "total": 4.0 * n } });
            let cost = Cost { processor_seconds: 2.0 * n, seconds: 4.0 * n, megabytes: 100.0 };
            Point { label: n.to_string(), size: n, run: Run::Done { report, cost, output: PathBuf::new() } }
        };
        let cost = Cost { processor_seconds: 9.0, seconds: 9.0, megabytes: 7.0 };
        let stopped = Point { label: "100".into(), size: 100.0, run: Run::Without { reason: "stopped".into(), cost } };
        let text = text("in", &[run(1.0), run(10.0), stopped]);
        assert!(text.contains("| in | processor s | MB | relax | rest |"), "{text}");
        assert!(text.contains("| 10 | 20.0 | 100 | 15.00 | 5.00 |"), "{text}");
        assert!(text.contains("| 100 | stopped | 7 | - | - |"), "{text}");
        assert!(text.contains("| exponent | 1.00 | 0.00 | 1.00 | - |"), "{text}");
    }
}
