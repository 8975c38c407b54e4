//! How long the gaps between neighbours on an arc may get.
//!
//! The triangles beside a chord across a bend or a hole are cheap, and far from the arc. What a gap may grow by is bounded in each relaxation, and
//! what it may grow to in all of them together.

use mesh_core::{Id as _, IdVec, TriMesh};
use region_map::{Arc, ArcId, Domain, Surface};

/// Gaps between neighbours on an arc get longer than at the start by at most this factor. More lets shapes get better, and lets
/// arcs be cut short by long edges.
const STRETCH: f64 = 3.0;
/// But no gap grows so long that the arc turns by more than this within it, in degrees, unless [`LEAST_STRETCH`] allows it: more
/// gives better shapes, less keeps nearer to curved arcs. Measured: without this rule, rims of holes lost up to a third of their
/// circle to one edge (Brun_joint missed the input by 27e-3 of the diagonal at a mean AR of .889, with it by 3.4e-3 at .887).
/// With 30 degrees camelhead has .004 more of mean AR, casting .973 to .975 of its creases instead of .980.
const MOST_TURN: f64 = 45.0;
/// Every gap may grow by this factor, however much the arc turns there: with less, vertices on tight curves hardly move.
const LEAST_STRETCH: f64 = 1.5;
/// The turn is measured over so many gaps on both sides: over more of them noise counts less, and curves farther away count, too.
const WINDOW: f64 = 2.0;
/// No gap grows to more than so many shares of its arc, however often it is relaxed. More gives better shapes, less keeps arcs whole. Measured: without
/// this rule half of a rim of casting went to one edge over five relaxations (greatest error 11.8e-3 of the diagonal, with it 3.6e-3); with 2 fandisk
/// loses .0017 of its mean AR and .029 of its first percentile.
const MOST_SHARES: f64 = 2.5;
/// An arc that turns by much less than this in all, in radians, counts as straight: where it turns is rounding. More makes less difference between the
/// bends of an arc and the rest of it.
const STRAIGHT: f64 = 0.1;

/// How long gaps may get on each arc of a domain.
pub(crate) struct LongestGaps {
    /// One over the number of gaps of every arc.
    shares: IdVec<ArcId, f64>,
    /// How far every arc turns in all, in radians.
    turns: IdVec<ArcId, f64>,
}

impl LongestGaps {
    pub(crate) fn new(surface: &Surface, domain: &Domain) -> Self {
        let arcs = &surface.network().arcs;
        let mut n_gaps = vec![0usize; arcs.len()];
        domain.region.spans.values().for_each(|span| n_gaps[span.arc.index()] += 1);
        Self {
            shares: n_gaps.into_iter().map(|n| 1.0 / n.max(1) as f64).collect(),
            turns: arcs.iter().map(|arc| total_turn(surface.mesh(), arc)).collect(),
        }
    }

    /// How long a gap of length `present` about arc length `t` of an arc may get.
    pub(crate) fn about(&self, surface: &Surface, (id, t): (ArcId, f64), present: f64) -> f64 {
        let (mesh, arc) = (surface.mesh(), &surface.network().arcs[id]);
        (stretch(mesh, arc, t, present) * present).min(MOST_SHARES * self.share(mesh, id, arc, t)).max(present)
    }

    /// The length of a gap about arc length `t` that takes its share of the arc: of its length and of its turn together, so that bends have more
    /// gaps than what is straight between them.
    fn share(&self, mesh: &TriMesh, id: ArcId, arc: &Arc, t: f64) -> f64 {
        let even = self.shares[id] * arc.length();
        let most = self.turns[id] + STRAIGHT;
        even * (1.0 + self.turns[id] / most) / (1.0 + turn_of_gap(mesh, arc, t, even) / (self.shares[id] * most))
    }
}

/// The factor by which a gap on an arc may grow about arc length `t`: the more the arc turns there, the less.
fn stretch(mesh: &TriMesh, arc: &Arc, t: f64, gap: f64) -> f64 {
    (MOST_TURN.to_radians() / turn_of_gap(mesh, arc, t, gap)).clamp(LEAST_STRETCH, STRETCH)
}

/// By how much an arc turns within a gap about arc length `t`, in radians.
fn turn_of_gap(mesh: &TriMesh, arc: &Arc, t: f64, gap: f64) -> f64 {
    let window = if arc.is_loop() { (WINDOW * gap).min(0.5 * arc.length()) } else { WINDOW * gap };
    let [behind, here, ahead] = [t - window, t, t + window].map(|t| arc.position(mesh, t));
    // On a circle the angle between two chords is that which either spans. Zigzags don't count.
    let turn = (here - behind).angle_between(ahead - here);
    // Next to the end of an arc one chord has no length.
    if turn > 0.0 { turn * gap / window } else { 0.0 }
}

/// By how much an arc turns in all, in radians.
fn total_turn(mesh: &TriMesh, arc: &Arc) -> f64 {
    let mut ways: Vec<_> = arc.vertices.windows(2).map(|edge| mesh.position(edge[1]) - mesh.position(edge[0])).collect();
    if arc.is_loop() {
        ways.push(ways[0]);
    }
    let turns = ways.windows(2).map(|two| two[0].angle_between(two[1]));
    // An edge without length has no direction.
    turns.filter(|turn| turn.is_finite()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::f64::consts::{PI, TAU};

    /// On the rim of a cylinder a gap grows to 45 degrees, or by a half; on its other arcs, which are straight, to three times
    /// itself.
    #[test]
    fn gaps_on_a_circle_grow_less_than_on_a_line() {
        let stretches = |mesh: TriMesh, gap: f64| {
            let surface = Surface::with_creases(mesh, 40.0).unwrap();
            let arcs = surface.network().arcs.iter();
            arcs.map(|arc| stretch(surface.mesh(), arc, 0.5 * arc.length(), gap)).collect::<Vec<f64>>()
        };
        let cylinder = fixtures::cylinder(1.0, 1.0, 360);
        for (degrees, expected) in [(5.0f64, 3.0), (15.0, 3.0), (20.0, 2.25), (60.0, 1.5), (120.0, 1.5)] {
            let found = stretches(cylinder.clone(), degrees.to_radians());
            assert!(found.len() == 2 && found.iter().all(|s| (s - expected).abs() < 0.02), "{degrees}: {found:?}");
        }
        assert!(stretches(fixtures::cuboid(DVec3::ONE, 4), 0.1).into_iter().all(|s| s == STRETCH));
    }

    /// A closed circle turns once, and each of its 360 gaps has a 360th; one of four edges of a box is straight.
    #[test]
    fn every_gap_of_a_circle_or_a_line_has_the_same_share() {
        for (mesh, turn) in [(fixtures::cylinder(1.0, 1.0, 360), TAU), (fixtures::cuboid(DVec3::ONE, 4), 0.0)] {
            let surface = Surface::with_creases(mesh, 40.0).unwrap();
            let gaps = LongestGaps::new(&surface, &Domain::identity(&surface));
            for (id, arc) in surface.network().arcs.enumerate() {
                assert!((gaps.turns[id] - turn).abs() < 1e-6, "{}", gaps.turns[id]);
                let even = arc.length() / arc.halfedges.len() as f64;
                assert!((gaps.share(surface.mesh(), id, arc, 0.4 * arc.length()) - even).abs() < 1e-3 * even);
            }
        }
    }

    /// The rim of half a disc: its arc is a half circle of 32 edges and a straight line of 32. A gap of the bend has its share of all the turn, and
    /// so is shorter than one of the line.
    #[test]
    fn bends_have_shorter_shares_than_what_is_straight() {
        let half_circle = (0..=32).map(|i| DVec3::new((PI * f64::from(i) / 32.0).cos(), (PI * f64::from(i) / 32.0).sin(), 0.0));
        let line = (1..32).map(|i| DVec3::new(-1.0 + f64::from(i) / 16.0, 0.0, 0.0));
        let rim: Vec<DVec3> = half_circle.chain(line).collect();
        let n = rim.len() as u32;
        let faces = (0..n).map(|i| [i, (i + 1) % n, n]).collect::<Vec<_>>();
        let positions: Vec<[f64; 3]> = rim.iter().chain([&DVec3::new(0.0, 0.4, 0.0)]).map(|p| p.to_array()).collect();
        let surface = Surface::smooth(TriMesh::from_slices(&positions, &faces).unwrap()).unwrap();
        let gaps = LongestGaps::new(&surface, &Domain::identity(&surface));
        let (id, arc) = surface.network().arcs.enumerate().next().unwrap();
        let middle_of = |p: DVec3| {
            let at = arc.vertices.iter().position(|&v| surface.mesh().position(v).distance(p) < 1e-9).unwrap();
            gaps.share(surface.mesh(), id, arc, arc.lengths[at])
        };
        let (bend, straight) = (middle_of(DVec3::Y), middle_of(DVec3::ZERO));
        assert!(bend < 0.75 * straight, "{bend} {straight}");
        // However long a gap is already, it may not grow beyond a few shares, and need not shrink.
        assert_eq!(gaps.about(&surface, (id, 0.0), 2.0), 2.0);
    }
}
