//! All solids in three tables: how they ended, by kind, and by cause with the seeds.

use super::judgement::End;
use super::solid::Judged;
use crate::markdown::table;
use std::collections::BTreeMap;

/// Ends in the order of the tables.
const ENDS: [&str; 6] = ["right", "short", "refused", "stopped", "panicked", "invalid"];

/// The tables, as text.
pub(super) fn summary(judged: &[Judged]) -> String {
    let seconds: f64 = judged.iter().map(|j| j.seconds).sum();
    let head = format!("{} solids, {:.1} s of processor time each", judged.len(), seconds / judged.len().max(1) as f64);
    let ends = table(&["end", "solids", "share"], &ends(judged));
    let kinds = table(&[&["kind", "solids"], &ENDS[..]].concat(), &kinds(judged));
    let causes = table(&["cause", "solids", "seeds"], &causes(judged));
    [head, ends, kinds, causes]
        .iter()
        .map(|part| part.trim_end())
        .filter(|part| !part.is_empty())
        .collect::<Vec<_>>()
        .join("\n\n")
}

fn count<'a>(judged: impl IntoIterator<Item = &'a Judged>, end: &str) -> usize {
    judged.into_iter().filter(|j| j.end.name() == end).count()
}

fn ends(judged: &[Judged]) -> Vec<Vec<String>> {
    let row = |end: &str| {
        let n = count(judged, end);
        vec![end.to_owned(), n.to_string(), format!("{:.1} %", 100.0 * n as f64 / judged.len() as f64)]
    };
    ENDS.into_iter().map(row).collect()
}

/// A row for each kind, those with the lowest share of right ones first.
fn kinds(judged: &[Judged]) -> Vec<Vec<String>> {
    let mut kinds: BTreeMap<&str, Vec<&Judged>> = BTreeMap::new();
    judged.iter().for_each(|j| kinds.entry(&j.kind).or_default().push(j));
    let mut kinds: Vec<_> = kinds.into_iter().collect();
    let share = |of: &[&Judged]| count(of.iter().copied(), "right") as f64 / of.len() as f64;
    kinds.sort_by(|a, b| share(&a.1).total_cmp(&share(&b.1)));
    let row = |(kind, of): (&str, Vec<&Judged>)| {
        let counts = ENDS.map(|end| count(of.iter().copied(), end).to_string());
        [&[kind.to_owned(), of.len().to_string()], &counts[..]].concat()
    };
    kinds.into_iter().map(row).collect()
}

/// A row for each cause, the most frequent first. A solid has as many as it falls short in.
fn causes(judged: &[Judged]) -> Vec<Vec<String>> {
    let mut causes: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for Judged { seed, end, .. } in judged.iter().filter(|j| j.end != End::Right) {
        end.causes().into_iter().for_each(|cause| causes.entry(cause).or_default().push(seed.to_string()));
    }
    let mut causes: Vec<_> = causes.into_iter().collect();
    causes.sort_by_key(|(_, seeds)| std::cmp::Reverse(seeds.len()));
    causes.into_iter().map(|(cause, seeds)| vec![cause, seeds.len().to_string(), seeds.join(" ")]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn causes_are_counted_with_their_seeds_and_shares_are_of_all() {
        let judged = |seed, kind: &str, end| Judged { seed, kind: kind.to_owned(), end, seconds: 2.0 };
        let short = |causes: &[&str]| End::Short(causes.iter().map(|c| (*c).to_owned()).collect());
        let text = summary(&[
            judged(1, "gear", End::Right),
            judged(2, "plate", short(&["cuts"])),
            judged(3, "gear", short(&["distance", "cuts"])),
            judged(4, "gear", End::Stopped),
        ]);
        assert!(text.starts_with("4 solids, 2.0 s"), "{text}");
        for row in ["| right | 1 | 25.0 % |", "| gear | 3 | 1 | 1 | 0 | 1 | 0 | 0 |", "| cuts | 2 | 2 3 |", "| stopped | 1 | 4 |"]
        {
            assert!(text.contains(row), "{row} is not in\n{text}");
        }
        assert!(text.find("| plate |") < text.find("| gear |"), "the worst kind is first");
    }

    #[test]
    fn no_solids_make_no_rows() {
        assert!(summary(&[]).starts_with("0 solids"));
    }
}
