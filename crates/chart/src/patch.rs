//! The chart of a patch: a convex polygon with one corner for every base vertex on its border.

use crate::convex_map::{Weights, solve};
use crate::pieces::PieceMesh;
use crate::polygon::convex_polygon;
use glam::DVec2;
use mesh_core::{IdVec, TriMesh, VertexId};
use region_map::{CellArc, CellArcId, CellCornerId, CellPatch, Cells, Chart, ChartFace, PatchId};
use std::f64::consts::PI;

/// The base vertices on the borders of the patches.
#[derive(Clone, Debug)]
pub struct BorderVertices {
    /// At every corner of the cells.
    pub at_corners: IdVec<CellCornerId, VertexId>,
    /// Along every arc of the cells, rising, without its ends.
    pub on_arcs: IdVec<CellArcId, Vec<ArcVertex>>,
}

/// A base vertex on an arc of the cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcVertex {
    /// Arc length from the start of the arc.
    pub t: f64,
    /// The base vertex.
    pub vertex: VertexId,
}

/// A patch in the plane.
#[derive(Clone, Debug)]
pub struct PatchChart {
    /// The map from the patch into the plane.
    pub chart: Chart,
    /// The corners of the polygon that it covers, counter-clockwise.
    pub polygon: Vec<PolygonCorner>,
}

/// A corner of the polygon that a patch is charted onto.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolygonCorner {
    /// The base vertex that sits there.
    pub vertex: VertexId,
    /// Where it is in the plane.
    pub at: DVec2,
}

/// A chart shrinks a part of a patch where its scale is below this share of the mean scale.
const SHRUNK: f64 = 0.25;
/// Never accepted: a scale so small that points of the piece do not find back through the chart in double precision.
const COLLAPSED: f64 = 1e-8;

/// Charts a patch onto a strictly convex polygon of about perimeter 2 pi, its border by arc length along the sides.
///
/// `max_shrunk`, 0 to 1, is the share of the patch's area that may be shrunk to less than a quarter of the mean scale; a patch of one
/// face may be charted in any way. `None` where that cannot be, where rounding folds every chart, and where the arguments do not belong
/// together.
pub fn chart_patch(mesh: &TriMesh, cells: &Cells, id: PatchId, vertices: &BorderVertices, max_shrunk: f64) -> Option<PatchChart> {
    let patch: &CellPatch = cells.patches.get(id)?;
    let mut pieces = PieceMesh::of_faces(mesh, &patch.faces);
    let mut border = Border::default();
    for &(arc_id, forward) in &patch.border {
        let arc = cells.arcs.get(arc_id)?;
        let mut run = run_along(arc, vertices.on_arcs.get(arc_id)?, &mut pieces)?;
        run.first_mut()?.base = Some(*vertices.at_corners.get(arc.corners[0])?);
        run.last_mut()?.base = Some(*vertices.at_corners.get(arc.corners[1])?);
        border.append(run, arc.length(), forward);
    }
    let mut is_border = vec![false; pieces.positions().len()];
    border.stops.iter().for_each(|s| is_border[s.local as usize] = true);
    cut_dividing_edges(&mut pieces, &is_border);
    let mut fixed = vec![None; pieces.positions().len()];
    let polygon = border.place(&angle_sums(&pieces), &mut fixed);
    for weights in [Weights::Cotangent, Weights::Uniform] {
        let uv = solve(pieces.positions(), pieces.pieces(), &fixed, weights);
        let Ok(chart) = Chart::new(uv, pieces.pieces().to_vec()) else { continue };
        let scales = Scales::of(&pieces, &chart);
        if patch.faces.len() == 1 || (scales.shrunk <= max_shrunk && scales.least >= COLLAPSED) {
            return Some(PatchChart { chart, polygon });
        }
    }
    None
}

/// Cuts, in the middle, every inner edge between two vertices of the border.
///
/// Then no edge joins two vertices of one side of the polygon but those along it: what the injectivity of the chart hangs on.
fn cut_dividing_edges(pieces: &mut PieceMesh, is_border: &[bool]) {
    let divides = |a: u32, b: u32| is_border[a as usize] && is_border[b as usize] && pieces.left(b, a).is_some();
    for [a, b] in pieces.edges_where(divides) {
        pieces.cut(a, b, 0.5);
    }
}

/// How a chart scales areas, relative to its mean scale.
struct Scales {
    /// The share of the patch's area that is shrunk below [`SHRUNK`].
    shrunk: f64,
    /// The least scale of any piece.
    least: f64,
}

impl Scales {
    fn of(pieces: &PieceMesh, chart: &Chart) -> Self {
        let areas = |f: &ChartFace| {
            let [a, b, c] = f.vertices.map(|v| chart.uv()[v as usize]);
            (mesh_core::area(f.vertices.map(|v| pieces.positions()[v as usize])), 0.5 * (b - a).perp_dot(c - a))
        };
        let both: Vec<(f64, f64)> = chart.faces().iter().map(areas).collect();
        let (area, flat) = both.iter().fold((0.0, 0.0), |sum, b| (sum.0 + b.0, sum.1 + b.1));
        let scale = |&(a, f): &(f64, f64)| f * area / (a * flat);
        let shrunk = both.iter().filter(|b| scale(b) < SHRUNK).map(|b| b.0).sum::<f64>() / area;
        // A piece without area is a needle on the surface too.
        let least = both.iter().filter(|b| b.0 > 0.0).map(scale).fold(f64::INFINITY, f64::min);
        Self { shrunk, least }
    }
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

/// A base vertex this close to a vertex of its arc, as a share of the arc's length, sits at the vertex: cutting there would make
/// pieces without area.
const AT_VERTEX: f64 = 1e-9;

/// The vertices along an arc from its first to its last, the edges cut at the base vertices. `None` where the pieces do not have the arc.
fn run_along(arc: &CellArc, on_arc: &[ArcVertex], pieces: &mut PieceMesh) -> Option<Vec<Stop>> {
    let tolerance = AT_VERTEX * arc.length();
    let mut run = Vec::new();
    let mut next_base = on_arc.iter().copied().peekable();
    for (i, (&v, &at)) in arc.vertices.iter().zip(&arc.lengths).enumerate() {
        let local = pieces.number(v)?;
        let base = next_base.next_if(|b| i > 0 && b.t <= at + tolerance).map(|b| b.vertex);
        run.push(Stop { local, at, base });
        let (Some(&next), Some(&after)) = (arc.lengths.get(i + 1), arc.vertices.get(i + 1)) else { break };
        let end = pieces.number(after)?;
        let is_last = i + 2 == arc.vertices.len();
        let (mut from, mut start) = (local, at);
        while let Some(ArcVertex { t, vertex }) = next_base.next_if(|b| is_last || b.t < next - tolerance) {
            from = pieces.cut(from, end, (t - start) / (next - start))?.vertex;
            start = t;
            run.push(Stop { local: from, at: t, base: Some(vertex) });
        }
    }
    Some(run)
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

    /// Fixes the border vertices on the polygon and returns its corners. `angles` are the angles of the patch at its vertices.
    fn place(&self, angles: &[f64], fixed: &mut [Option<DVec2>]) -> Vec<PolygonCorner> {
        let bases: Vec<(usize, VertexId)> = self.stops.iter().enumerate().filter_map(|(i, s)| Some((i, s.base?))).collect();
        let n = bases.len();
        let sides: Vec<Side> = (0..n).map(|k| self.side(bases[k].0, bases[(k + 1) % n].0)).collect();
        let turn = |i: usize| PI - angles[self.stops[i % self.stops.len()].local as usize];
        // A side is straight in the chart: what it turns is added to the corners at its ends.
        let bend: Vec<f64> = sides.iter().map(|s| (1..s.count).map(|i| turn(s.first + i)).sum()).collect();
        let turns: Vec<f64> = (0..n).map(|k| turn(bases[k].0) + 0.5 * (bend[k] + bend[(k + n - 1) % n])).collect();
        let lengths: Vec<f64> = sides.iter().map(|s| s.length).collect();
        let polygon = convex_polygon(&lengths, &turns);
        for (k, side) in sides.iter().enumerate() {
            for step in 0..side.count {
                let stop = self.stops[(side.first + step) % self.stops.len()];
                let along = (stop.at - self.stops[side.first].at).rem_euclid(self.length) / side.length;
                fixed[stop.local as usize] = Some(polygon[k].lerp(polygon[(k + 1) % n], along));
            }
        }
        bases.iter().zip(polygon).map(|(b, at)| PolygonCorner { vertex: b.1, at }).collect()
    }

    /// The side from stop `first` to stop `last`.
    fn side(&self, first: usize, last: usize) -> Side {
        let (count, length) = if last > first {
            (last - first, self.stops[last].at - self.stops[first].at)
        } else {
            (last + self.stops.len() - first, self.stops[last].at + self.length - self.stops[first].at)
        };
        Side { first, count, length }
    }
}

/// A side of the polygon: its first stop, the number of edges along it, and its length on the surface.
struct Side {
    first: usize,
    count: usize,
    length: f64,
}

/// The sum of the angles of all pieces at every vertex.
fn angle_sums(pieces: &PieceMesh) -> Vec<f64> {
    let mut sums = vec![0.0; pieces.positions().len()];
    for piece in pieces.pieces() {
        let angles = mesh_core::angles(piece.vertices.map(|v| pieces.positions()[v as usize]));
        for (v, angle) in piece.vertices.iter().zip(angles) {
            sums[*v as usize] += angle;
        }
    }
    sums
}
