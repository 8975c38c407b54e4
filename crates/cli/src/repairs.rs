//! The repairs of an input, in words and under the names that the JSON has.

use crate::print::Table;
use mesh_core::CleanReport;
use serde::{Serialize, Serializer};

/// One kind of repair.
struct Repair {
    /// In the JSON.
    name: &'static str,
    count: usize,
    /// What was done to so many of what.
    words: &'static str,
}

/// How often each repair was made, those included that were not.
#[derive(Default)]
pub(crate) struct Repairs(Vec<Repair>);

/// Kinds that a summary names; the others are counted.
const MOST_IN_SUMMARY: usize = 3;

impl Repairs {
    /// Those of a report.
    pub(crate) fn new(report: &CleanReport) -> Self {
        // Taken apart, so that the compiler tells when a repair is missing here.
        let &CleanReport {
            bad_index,
            not_finite,
            merged_exactly,
            merged_by_tolerance,
            t_vertices,
            // No repair; a warning tells.
            open_t_vertices: _,
            collapsed,
            flaps,
            // A length; where it is great, a warning tells.
            flap_width: _,
            repeated,
            turned,
            orientation_cuts,
            non_manifold_edges,
            leaf_cuts,
            split_edges,
            vertex_copies,
            zero_area_flipped,
            zero_area_dropped,
            zero_area_opened,
            unused_vertices,
        } = report;
        let repair = |(name, count, words)| Repair { name, count, words };
        let all = [
            ("bad_index", bad_index, "triangles of vertices that do not exist dropped"),
            ("not_finite", not_finite, "triangles with coordinates that are no numbers dropped"),
            ("merged_exactly", merged_exactly, "vertices at the place of another one merged"),
            ("merged_by_tolerance", merged_by_tolerance, "vertices of cracks merged"),
            ("t_vertices", t_vertices, "vertices on edges of triangles beside made theirs, too"),
            ("collapsed", collapsed, "triangles with one vertex twice dropped"),
            ("flaps", flaps, "triangles of folds without inside dropped"),
            ("repeated", repeated, "repeated triangles dropped"),
            ("turned", turned, "triangles turned over"),
            ("orientation_cuts", orientation_cuts, "edges of one-sided surfaces cut"),
            ("non_manifold_edges", non_manifold_edges, "edges of more than 2 triangles taken apart"),
            ("leaf_cuts", leaf_cuts, "edges cut where a sheet of the surface ends"),
            ("split_edges", split_edges, "edges with the ends of another one split"),
            ("vertex_copies", vertex_copies, "copies of vertices made where surfaces touch"),
            ("zero_area_flipped", zero_area_flipped, "triangles without area mended"),
            ("zero_area_dropped", zero_area_dropped, "triangles without area dropped"),
            ("zero_area_opened", zero_area_opened, "triangles without area dropped, which opens the surface"),
            ("unused_vertices", unused_vertices, "unused vertices dropped"),
        ];
        Self(all.into_iter().map(repair).collect())
    }

    fn made(&self) -> impl Iterator<Item = &Repair> {
        self.0.iter().filter(|repair| repair.count > 0)
    }

    /// Appends the most frequent ones, where there are any.
    pub(crate) fn summary(&self, table: &mut Table) {
        let mut made: Vec<_> = self.made().collect();
        made.sort_by_key(|repair| std::cmp::Reverse(repair.count));
        let mut named: Vec<String> = made.iter().map(|repair| format!("{} {}", repair.count, repair.words)).collect();
        if named.len() > MOST_IN_SUMMARY {
            let others = named.split_off(MOST_IN_SUMMARY).len();
            named.push(format!("{others} other kinds"));
        }
        table.row_if("repairs", (!named.is_empty()).then(|| named.join(", ")));
    }

    /// Appends all that were made, one a line.
    pub(crate) fn rows(&self, table: &mut Table) {
        self.made().for_each(|repair| table.row("repair", format!("{} {}", repair.count, repair.words)));
    }

    /// Without those that were not made.
    pub(crate) fn only_made(self) -> Self {
        Self(self.0.into_iter().filter(|repair| repair.count > 0).collect())
    }
}

impl Serialize for Repairs {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|repair| (repair.name, repair.count)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_json_has_all_and_a_summary_the_most_frequent() {
        let report = CleanReport { turned: 5, repeated: 9, unused_vertices: 1, bad_index: 2, ..CleanReport::default() };
        let repairs = Repairs::new(&report);
        let json = serde_json::to_value(&repairs).unwrap();
        assert_eq!((json.as_object().map(|o| o.len()), &json["turned"]), (Some(18), &5.into()));
        let mut table = Table::default();
        repairs.summary(&mut table);
        let words = "9 repeated triangles dropped, 5 triangles turned over, 2 triangles of vertices that do not exist dropped, 1 other kinds";
        assert!(table.text().ends_with(&format!("{words}\n")), "{}", table.text());
        assert_eq!(serde_json::to_value(repairs.only_made()).unwrap().as_object().map(|o| o.len()), Some(4));
    }
}
