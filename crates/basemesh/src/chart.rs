//! The chart of a patch: a convex polygon with one corner for every base vertex on its border.

use crate::BaseError;
use crate::piece_mesh::PieceMesh;
use crate::tutte::{self, Weights};
use glam::DVec2;
use mesh_core::{IdVec, TriMesh, VertexId};
use region_map::{CellArc, CellArcId, CellCornerId, CellPatch, Cells, Chart, PatchId};
use std::f64::consts::TAU;

/// A patch in the plane.
pub(crate) struct PatchChart {
    pub(crate) chart: Chart,
    /// The base vertices round the patch, counter-clockwise, and the corners of the polygon that they sit at.
    pub(crate) border: Vec<(VertexId, DVec2)>,
}

/// The least angle of a side of the polygon, as a share of the mean one: shorter sides would make slivers in the chart.
const LEAST_SIDE: f64 = 0.25;

/// Charts a patch. `on_arcs` gives the sites of every arc (arc length and base vertex), `corner` the base vertex of a cell corner.
pub(crate) fn chart(
    mesh: &TriMesh,
    cells: &Cells,
    id: PatchId,
    on_arcs: &IdVec<CellArcId, Vec<(f64, VertexId)>>,
    corner: impl Fn(CellCornerId) -> VertexId,
) -> Result<PatchChart, BaseError> {
    let patch: &CellPatch = &cells.patches[id];
    let mut pieces = PieceMesh::new(mesh, &patch.faces);
    let mut border = Border::default();
    for &(arc_id, forward) in &patch.border {
        let arc = &cells.arcs[arc_id];
        let mut run = run_along(arc, &on_arcs[arc_id], &mut pieces);
        run[0].base = Some(corner(arc.corners[0]));
        if let Some(last) = run.last_mut() {
            last.base = Some(corner(arc.corners[1]));
        }
        border.append(run, arc.length(), forward);
    }
    let mut is_border = vec![false; pieces.positions.len()];
    border.stops.iter().for_each(|s| is_border[s.local as usize] = true);
    pieces.cut_dividing_edges(&is_border);
    let mut fixed = vec![None; pieces.positions.len()];
    let corners = border.place(&mut fixed);
    for weights in [Weights::Cotangent, Weights::Uniform] {
        let uv = tutte::solve(&pieces.positions, &pieces.pieces, &fixed, weights);
        if let Ok(chart) = Chart::new(uv, pieces.pieces.clone()) {
            return Ok(PatchChart { chart, border: corners });
        }
    }
    Err(BaseError::Collapsed(id))
}

/// A vertex on the border of the pieces.
#[derive(Clone, Copy)]
struct Stop {
    local: u32,
    /// Arc length from the start of the border.
    at: f64,
    /// The base vertex that sits here.
    base: Option<VertexId>,
}

/// A site this close to a vertex of its arc, as a share of the arc's length, sits at the vertex: cutting there would make pieces
/// without area.
const AT_VERTEX: f64 = 1e-9;

/// The vertices along an arc from its first to its last, the edges cut at the sites.
fn run_along(arc: &CellArc, sites: &[(f64, VertexId)], pieces: &mut PieceMesh) -> Vec<Stop> {
    let tolerance = AT_VERTEX * arc.length();
    let mut run = Vec::new();
    let mut sites = sites.iter().copied().peekable();
    for (i, &v) in arc.vertices.iter().enumerate() {
        let Some(local) = pieces.local(v) else { continue };
        let at = arc.lengths[i];
        let base = sites.next_if(|&(t, _)| i > 0 && t <= at + tolerance).map(|s| s.1);
        run.push(Stop { local, at, base });
        let Some(&next) = arc.lengths.get(i + 1) else { break };
        let Some(end) = pieces.local(arc.vertices[i + 1]) else { break };
        let is_last = i + 2 == arc.vertices.len();
        let (mut from, mut start) = (local, at);
        while let Some((t, base)) = sites.next_if(|&(t, _)| is_last || t < next - tolerance) {
            from = pieces.cut(from, end, (t - start) / (next - start));
            start = t;
            run.push(Stop { local: from, at: t, base: Some(base) });
        }
    }
    run
}

/// The border of a patch, vertex by vertex, counter-clockwise.
#[derive(Default)]
struct Border {
    stops: Vec<Stop>,
    length: f64,
}

impl Border {
    /// Adds the vertices along an arc but its end, which the next arc begins with.
    fn append(&mut self, mut run: Vec<Stop>, length: f64, forward: bool) {
        if !forward {
            run.reverse();
            run.iter_mut().for_each(|s| s.at = length - s.at);
        }
        run.pop();
        self.stops.extend(run.into_iter().map(|s| Stop { at: s.at + self.length, ..s }));
        self.length += length;
    }

    /// Fixes the border vertices on the polygon and returns its corners.
    fn place(&self, fixed: &mut [Option<DVec2>]) -> Vec<(VertexId, DVec2)> {
        let bases: Vec<(usize, VertexId)> = self.stops.iter().enumerate().filter_map(|(i, s)| Some((i, s.base?))).collect();
        let n = bases.len();
        let ends = |k: usize| (bases[k].0, bases[(k + 1) % n].0);
        let length = |k: usize| {
            let (i, j) = ends(k);
            if j > i { self.stops[j].at - self.stops[i].at } else { self.stops[j].at + self.length - self.stops[i].at }
        };
        let least = LEAST_SIDE * self.length / n as f64;
        let sides: Vec<f64> = (0..n).map(|k| length(k).max(least)).collect();
        let total: f64 = sides.iter().sum();
        let mut corners = Vec::with_capacity(n);
        let mut angle = 0.0;
        for (k, side) in sides.iter().enumerate() {
            corners.push((bases[k].1, DVec2::from_angle(angle)));
            angle += TAU * side / total;
        }
        for k in 0..n {
            let (i, j) = ends(k);
            let (a, b) = (corners[k].1, corners[(k + 1) % n].1);
            let count = if j > i { j - i } else { j + self.stops.len() - i };
            for step in 0..count {
                let stop = self.stops[(i + step) % self.stops.len()];
                let along = (stop.at - self.stops[i].at).rem_euclid(self.length);
                fixed[stop.local as usize] = Some(a.lerp(b, along / length(k)));
            }
        }
        corners
    }
}
