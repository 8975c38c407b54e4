//! Convex combination maps: every inner vertex at a weighted mean of its neighbours, the border on a convex polygon.
//!
//! Tutte, *How to draw a graph* (1963); Floater, *Parametrization and smooth approximation of surface triangulations* (1997): with
//! positive weights, a convex border and no dividing edge the map is injective.

use glam::{DVec2, DVec3};
use region_map::{Chart, ChartFace};
use std::collections::BTreeMap;

/// How the neighbours are weighed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Weights {
    /// Half the cotangents of the opposite angles: harmonic, flat regions keep their shape. May fold beside obtuse angles.
    Harmonic,
    /// The same, clamped to [`LEAST_COTANGENT`]..[`GREATEST_COTANGENT`]: little distortion.
    Cotangent,
    /// All the same: blind to shape, hence safest where triangles are bad.
    Uniform,
}

/// Obtuse angles give negative cotangents; a positive weight keeps the map injective.
const LEAST_COTANGENT: f64 = 0.05;
/// Needles give huge ones, which ruin the condition of the system.
const GREATEST_COTANGENT: f64 = 20.0;
/// Triangles without area must not spoil the harmonic system, either.
const GREATEST_HARMONIC: f64 = 1e4;
/// The iteration stops when the residual has fallen to this share of the first one: near to the last bits of a double, because the map
/// must not fold.
const RESIDUAL: f64 = 1e-14;

/// Lays pieces flat, with the vertices that `fixed` gives a place (the border, on a strictly convex polygon) held there.
///
/// `positions` and `fixed` have an entry for every vertex of the pieces. No inner edge may join two fixed vertices. `None` where rounding
/// folds the map with all weights, and where a table is too short.
pub fn lay_flat(positions: &[DVec3], pieces: Vec<ChartFace>, fixed: &[Option<DVec2>]) -> Option<Chart> {
    let are_there = pieces.iter().flat_map(|p| p.vertices).all(|v| (v as usize) < positions.len());
    if !are_there || fixed.len() != positions.len() {
        return None;
    }
    let chart = |weights| Chart::new(solve(positions, &pieces, fixed, weights), pieces.clone()).ok();
    [Weights::Harmonic, Weights::Cotangent, Weights::Uniform].into_iter().find_map(chart)
}

/// Positions in the plane of all vertices, with those that `fixed` gives a position to held there.
pub(crate) fn solve(positions: &[DVec3], pieces: &[ChartFace], fixed: &[Option<DVec2>], weights: Weights) -> Vec<DVec2> {
    let rows = Rows::new(positions, pieces, fixed, weights);
    let mut uv: Vec<DVec2> = fixed.iter().map(|f| f.unwrap_or(DVec2::ZERO)).collect();
    conjugate_gradients(&rows, &mut uv);
    uv
}

/// The weighted graph Laplacian, by rows of the free vertices.
struct Rows {
    free: Vec<u32>,
    start: Vec<usize>,
    neighbours: Vec<(u32, f64)>,
    diagonal: Vec<f64>,
}

impl Rows {
    fn new(positions: &[DVec3], pieces: &[ChartFace], fixed: &[Option<DVec2>], weights: Weights) -> Self {
        let mut edges: BTreeMap<[u32; 2], f64> = BTreeMap::new();
        for piece in pieces {
            for c in 0..3 {
                let [a, b, o] = [0, 1, 2].map(|i| piece.vertices[(c + i) % 3]);
                *edges.entry([a.min(b), a.max(b)]).or_default() += 0.5 * cotangent(positions, [a, b, o], weights);
            }
        }
        let mut lists = vec![Vec::new(); positions.len()];
        for (&[a, b], &w) in &edges {
            lists[a as usize].push((b, w));
            lists[b as usize].push((a, w));
        }
        let free: Vec<u32> = (0..positions.len() as u32).filter(|&v| fixed[v as usize].is_none()).collect();
        let (mut start, mut neighbours, mut diagonal) = (vec![0], Vec::new(), Vec::new());
        for &v in &free {
            neighbours.extend_from_slice(&lists[v as usize]);
            start.push(neighbours.len());
            diagonal.push(lists[v as usize].iter().map(|n| n.1).sum());
        }
        Self { free, start, neighbours, diagonal }
    }

    /// `diagonal * x - sum w x` of row `i`.
    fn apply(&self, i: usize, x: &[DVec2]) -> DVec2 {
        let sum: DVec2 = self.neighbours[self.start[i]..self.start[i + 1]].iter().map(|&(n, w)| w * x[n as usize]).sum();
        self.diagonal[i] * x[self.free[i] as usize] - sum
    }
}

/// The clamped cotangent of the angle at `o`, or 1.
fn cotangent(positions: &[DVec3], [a, b, o]: [u32; 3], weights: Weights) -> f64 {
    if weights == Weights::Uniform {
        return 1.0;
    }
    let (u, v) = (positions[a as usize] - positions[o as usize], positions[b as usize] - positions[o as usize]);
    let cotangent = u.dot(v) / u.cross(v).length();
    if weights == Weights::Harmonic {
        return if cotangent.is_finite() { cotangent.clamp(-GREATEST_HARMONIC, GREATEST_HARMONIC) } else { 0.0 };
    }
    if cotangent.is_nan() { LEAST_COTANGENT } else { cotangent.clamp(LEAST_COTANGENT, GREATEST_COTANGENT) }
}

/// Conjugate gradients with the diagonal as preconditioner, both coordinates at once, each with its own step: they are two systems with
/// one matrix. (The crate `conjugate-gradients` takes one step for all coordinates of an unknown.)
fn conjugate_gradients(rows: &Rows, uv: &mut [DVec2]) {
    let n = rows.free.len();
    let precondition = |r: &[DVec2]| -> Vec<DVec2> { r.iter().zip(&rows.diagonal).map(|(r, d)| *r / *d).collect() };
    let dot = |a: &[DVec2], b: &[DVec2]| -> DVec2 { a.iter().zip(b).map(|(a, b)| *a * *b).sum() };
    let mut residual: Vec<DVec2> = (0..n).map(|i| -rows.apply(i, uv)).collect();
    let mut z = precondition(&residual);
    // Directions live on all vertices, 0 on the fixed ones, so that rows can be applied to them.
    let mut direction = vec![DVec2::ZERO; uv.len()];
    rows.free.iter().zip(&z).for_each(|(&v, z)| direction[v as usize] = *z);
    let mut rz = dot(&residual, &z);
    let stop = rz * RESIDUAL * RESIDUAL;
    let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
    for _ in 0..10 * n + 100 {
        if rz.x <= stop.x && rz.y <= stop.y {
            break;
        }
        let image: Vec<DVec2> = (0..n).map(|i| rows.apply(i, &direction)).collect();
        let curvature: DVec2 = rows.free.iter().zip(&image).map(|(&v, q)| direction[v as usize] * *q).sum();
        let step = DVec2::new(ratio(rz.x, curvature.x), ratio(rz.y, curvature.y));
        for (i, &v) in rows.free.iter().enumerate() {
            uv[v as usize] += step * direction[v as usize];
            residual[i] -= step * image[i];
        }
        z = precondition(&residual);
        let next = dot(&residual, &z);
        let turn = DVec2::new(ratio(next.x, rz.x), ratio(next.y, rz.y));
        for (&v, z) in rows.free.iter().zip(&z) {
            direction[v as usize] = *z + turn * direction[v as usize];
        }
        rz = next;
    }
}
