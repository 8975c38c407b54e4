//! Curvature of sheets and arcs at the scale of the cells, in radians per length.

use crate::cells::Cells;
use glam::DVec3;
use mesh_core::VertexId;
use region_map::{Arc, Surface};

/// How fast the normal turns between each cell and its neighbours in the sheet: the root mean square over the neighbours, then
/// smoothed once.
pub(crate) fn cell_curvature(surface: &Surface, cells: &Cells) -> Vec<f64> {
    let (normals, centres) = means(surface, cells);
    let pairs = neighbours(surface, cells);
    let mut sums = vec![(0.0, 0.0); cells.n];
    for &(i, j) in &pairs {
        let distance = centres[i].distance(centres[j]);
        if distance > 0.0 {
            let square = (normals[i].angle_between(normals[j]) / distance).powi(2);
            for k in [i, j] {
                sums[k] = (sums[k].0 + square, sums[k].1 + 1.0);
            }
        }
    }
    let curvature: Vec<f64> = sums.iter().map(|s| if s.1 > 0.0 { (s.0 / s.1).sqrt() } else { 0.0 }).collect();
    let mut smooth: Vec<(f64, f64)> = curvature.iter().map(|&c| (c, 1.0)).collect();
    for (i, j) in pairs {
        smooth[i] = (smooth[i].0 + curvature[j], smooth[i].1 + 1.0);
        smooth[j] = (smooth[j].0 + curvature[i], smooth[j].1 + 1.0);
    }
    smooth.into_iter().map(|(sum, n)| sum / n).collect()
}

/// Mean normal and centroid of every cell.
fn means(surface: &Surface, cells: &Cells) -> (Vec<DVec3>, Vec<DVec3>) {
    let mut sums = vec![(DVec3::ZERO, DVec3::ZERO, 0.0); cells.n];
    for (f, &cell) in cells.of_face.enumerate() {
        let vector = mesh_core::vector_area(surface.mesh().triangle(f));
        let sum = &mut sums[cell as usize];
        *sum = (sum.0 + vector, sum.1 + vector.length() * surface.mesh().centroid(f), sum.2 + vector.length());
    }
    let normals = sums.iter().map(|s| s.0.normalize_or(DVec3::Z)).collect();
    (normals, sums.iter().map(|s| if s.2 > 0.0 { s.1 / s.2 } else { DVec3::ZERO }).collect())
}

/// Pairs of cells that share an edge off the arcs, in rising order.
fn neighbours(surface: &Surface, cells: &Cells) -> Vec<(usize, usize)> {
    let pair = |e| {
        let (f, g) = surface.topology().edge_faces(e);
        let (i, j) = (cells.of_face[f] as usize, cells.of_face[g?] as usize);
        (i != j && !surface.network().is_barrier(e)).then_some((i.min(j), i.max(j)))
    };
    let mut pairs: Vec<_> = surface.topology().edge_ids().filter_map(pair).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// How far on each side of a vertex the turn of an arc is measured, in edge lengths: an edge with the vertex in its middle sees as much.
const ARC_REACH: f64 = 0.5;

/// How fast arcs turn at their vertices.
pub(crate) fn arc_curvature(surface: &Surface, edge_length: f64) -> Vec<(VertexId, f64)> {
    let reach = ARC_REACH * edge_length;
    let at_vertex = |arc: &Arc, i: usize| {
        let t = arc.lengths[i];
        if !arc.is_loop() && (t <= 0.0 || t >= arc.length()) {
            return None;
        }
        let position = |t: f64| arc.position(surface.mesh(), t);
        let turn = (position(t) - position(t - reach)).angle_between(position(t + reach) - position(t));
        turn.is_finite().then_some((arc.vertices[i], turn / reach))
    };
    let arcs = surface.network().arcs.iter();
    arcs.flat_map(|arc| (0..arc.vertices.len()).filter_map(move |i| at_vertex(arc, i))).collect()
}
