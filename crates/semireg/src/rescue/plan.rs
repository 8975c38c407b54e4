//! The order in which base meshes are tried until a result is right.

use crate::attempt::Remedy;
use crate::base::Setting;

/// The first setting, and what all others differ from.
const FIRST: Setting = Setting { persistence: 1.0, base_vertices: 1.0, as_needed: false, turn: 1.6 };

/// Most models pass at the first setting, with one of its base meshes. A crease that was kept may be noise, or one that was left out may have been
/// needed; and what is too coarse for the shape needs more vertices.
pub(crate) const PLAN: [(Remedy, Setting); 4] = [
    (Remedy::AsAsked, FIRST),
    (Remedy::FewerCreases(1.6), Setting { persistence: 3.0, base_vertices: 1.6, turn: 1.2, as_needed: true }),
    (Remedy::MoreVertices(2.5), Setting { base_vertices: 2.5, turn: 1.2, as_needed: true, ..FIRST }),
    (Remedy::MoreCreases, Setting { persistence: 0.4, ..FIRST }),
];

/// Base vertices at most of a mesh that is made finer for its shape, by the number of its levels: 1 and less, 2 and more.
const MOST_GROWN: [usize; 2] = [8_000, 4_000];
/// How many times the base vertices a mesh with a level less gets: more than the four times that leave the number of triangles.
const FINER: f64 = 6.0;

/// A result with more base vertices, for its shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Growth {
    /// Factor on the base vertices that were asked for.
    pub(crate) times: f64,
    pub(crate) levels: u32,
}

impl Growth {
    pub(crate) fn remedy(self) -> Remedy {
        Remedy::MoreVertices(self.times)
    }

    pub(crate) fn setting(self) -> Setting {
        Setting { base_vertices: self.times, ..FIRST }
    }
}

/// What is tried where a result with so many base vertices and levels has all parts of the input and is too coarse for its shape, as long as
/// that helps. Poor triangles get a base mesh that is finer by a level, where levels are left to us: better ones come of that alone. What is missed
/// needs a finer result.
pub(crate) fn growth(asked: usize, levels: u32, are_levels_ours: bool, are_triangles_poor: bool) -> Vec<Growth> {
    if are_triangles_poor && are_levels_ours && levels > 1 {
        return grown(asked, FINER, levels - 1).into_iter().collect();
    }
    [2.0, 4.0].into_iter().filter_map(|times| grown(asked, times, levels)).collect()
}

/// The finest base mesh that is tried without being asked for, split once less: most of what folds on a coarse one holds there.
pub(crate) fn finest(asked: usize, levels: u32) -> Option<Growth> {
    if levels > 1 { grown(asked, f64::INFINITY, levels - 1) } else { None }
}

/// So many times the base vertices, within bounds; `None` where that is hardly more.
fn grown(asked: usize, times: f64, levels: u32) -> Option<Growth> {
    let most = MOST_GROWN[usize::from(levels > 1)] as f64 / asked.max(1) as f64;
    Some(Growth { times: times.min(most), levels }).filter(|growth| growth.times >= 1.5)
}

/// A result that misses the input by more than this share of a base edge somewhere has lost a part of it. Measured at level 3: good results
/// miss by .01 (fandisk) to .16 (casting); a camel without one fold of its mouth by .5.
const LOST: f64 = 0.25;
/// The level at which that was measured.
const MEASURED_LEVEL: u32 = 3;
/// At a coarser level the chord of a longer edge misses more: by this share of what its edges are longer. More hides lost parts there.
const CHORD: f64 = 0.5;
/// What is smaller than this share of the diagonal is no part. Measured: crank_cse with 1,500 base vertices misses a rim by .008.
const LEAST_LOST: f64 = 0.01;

/// How far a certified result misses the input where it misses it most.
#[derive(Clone, Copy)]
pub(crate) struct Loss {
    /// As a share of the input's diagonal.
    pub(crate) of_diagonal: f64,
    /// In edge lengths of the base mesh that was asked for.
    pub(crate) base_edges: f64,
}

impl Loss {
    /// Whether a part of the input is lost, on a result of so many levels: the same part is lost at any level, and no chord is taken for one.
    pub(crate) fn is_a_part(&self, levels: u32) -> bool {
        let edge = |level: u32| 0.5f64.powi(level.min(MEASURED_LEVEL) as i32);
        let of_chords = CHORD * (edge(levels) - edge(MEASURED_LEVEL));
        self.base_edges > LOST + of_chords && self.of_diagonal > LEAST_LOST
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No step asks for more than is allowed, and poor triangles go to the finer base mesh at once.
    #[test]
    fn base_meshes_grow_within_bounds() {
        let times = |asked, levels, ours, poor| -> Vec<(f64, u32)> {
            growth(asked, levels, ours, poor).into_iter().map(|g| (g.times, g.levels)).collect()
        };
        assert_eq!(times(1_000, 2, true, false), [(2.0, 2), (4.0, 2)]);
        assert_eq!(times(1_000, 2, true, true), [(6.0, 1)]);
        assert_eq!(times(2_000, 2, true, true), [(4.0, 1)]);
        assert_eq!(times(1_000, 3, false, false), [(2.0, 3), (4.0, 3)]);
        assert_eq!(times(6_000, 1, true, false), []);
        assert_eq!(finest(1_000, 2), Some(Growth { times: 8.0, levels: 1 }));
        assert_eq!([finest(1_000, 1), finest(6_000, 2)], [None, None]);
        for asked in [1, 900, 2_500, 4_000, 9_000] {
            for (times, levels) in times(asked, 2, true, false) {
                assert!(times * asked as f64 <= MOST_GROWN[usize::from(levels > 1)] as f64);
            }
        }
    }

    /// The chord of a half circle of one base edge's length around misses it by its radius, a third of a base edge: a part is lost where the
    /// level has edges that could follow it, and not where it has none.
    #[test]
    fn a_chord_is_no_lost_part() {
        let lost = |base_edges, levels| Loss { of_diagonal: 0.1, base_edges }.is_a_part(levels);
        let radius = 1.0 / std::f64::consts::PI;
        assert!(!lost(radius, 0) && !lost(radius, 1) && lost(radius, 2) && lost(radius, 3) && lost(radius, 6));
        assert!(!lost(0.2, 3) && lost(0.9, 0));
        assert!(!Loss { of_diagonal: 0.005, base_edges: 1.0 }.is_a_part(3));
    }
}
