//! How many sites every arc and patch gets (eqs. 3 and 4, corrected).
//!
//! The paper's eq. 4 counts a corner once for every arc that ends there, and its absolute value gives *more* inner sites the more
//! the arcs overrun the request. Here: corners once, `k - 1` sites inside an arc of `k` segments, and in a disk patch with `b`
//! border sites `i = max(0, (T - b + 2) / 2)` with `T = integral dA / (sqrt(3)/4 h^2)` equilateral triangles of edge length `h`.

use crate::arc_measure::ArcMeasure;
use crate::candidates::spread;
use mesh_core::{IdVec, TriMesh, equilateral_edge_length};
use region_map::{CellArcId, CellPatch, Cells, PatchId, Sizing};

/// Segments of every arc and inner sites of every patch.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Edge length that the budget was made for, in the units of the mesh, where the sizing field is 1.
    pub edge_length: f64,
    /// Segments of every arc.
    pub segments: IdVec<CellArcId, usize>,
    /// Inner sites of every patch.
    pub inner: IdVec<PatchId, usize>,
    /// Base vertices in all.
    pub total: usize,
    /// What the topology needs at least: no arc can have fewer segments, and no patch an inner site.
    pub needed: usize,
}

/// Steps of the bisection: the edge length is then known to 1e-12 of its first bracket.
const BISECTIONS: usize = 60;

/// The bisection looks between these multiples of the guess by area. A narrower bracket would miss surfaces whose arcs are long for their
/// area.
const BRACKET: [f64; 2] = [1e-3, 1e3];

/// Points of a patch that the sizing field is averaged over: its triangles may be as large as the patch.
const SAMPLES: usize = 256;

/// Area of an equilateral triangle of edge length 1.
const UNIT_TRIANGLE: f64 = 0.433_012_701_892_219_3;

/// Finds the edge length whose total is the request, and hands out the last few sites by largest remainder.
pub(crate) fn budget(
    mesh: &TriMesh,
    cells: &Cells,
    arcs: &IdVec<CellArcId, ArcMeasure>,
    sizing: &Sizing,
    wanted: usize,
) -> Budget {
    let demand = Demand::measure(mesh, cells, arcs, sizing);
    let needed = demand.at(f64::INFINITY).total;
    // eq. 3 for the area in units of the sizing field, of which only ratios matter.
    let guess = equilateral_edge_length(UNIT_TRIANGLE * demand.patches.iter().sum::<f64>(), wanted);
    let [mut short, mut long] = BRACKET.map(|factor| guess * factor);
    // Thin strips have arcs that are longer still.
    while long.is_finite() && long > 0.0 && demand.at(long).total > wanted.max(needed) {
        long *= BRACKET[1];
    }
    for _ in 0..BISECTIONS {
        let middle = (short * long).sqrt();
        *(if demand.at(middle).total > wanted { &mut short } else { &mut long }) = middle;
    }
    let mut budget = demand.at(long);
    budget.needed = needed;
    demand.hand_out(&mut budget, wanted);
    budget
}

/// What arcs and patches ask for at edge length 1.
struct Demand {
    corners: usize,
    /// `integral ds / h` and least number of segments of every arc.
    arcs: IdVec<CellArcId, (f64, usize)>,
    /// `integral dA / (sqrt(3)/4 h^2)` of every patch.
    patches: IdVec<PatchId, f64>,
    borders: IdVec<PatchId, Vec<CellArcId>>,
}

impl Demand {
    fn measure(mesh: &TriMesh, cells: &Cells, arcs: &IdVec<CellArcId, ArcMeasure>, sizing: &Sizing) -> Self {
        let patch = |patch: &CellPatch| {
            let area: f64 = patch.faces.iter().map(|&f| mesh.area(f)).sum();
            let points = spread(mesh, &patch.faces, sizing, SAMPLES, 0);
            // Without area there are no points, and nothing is asked for.
            let mean = points.iter().map(|c| c.weight.sqrt()).sum::<f64>() / points.len().max(1) as f64;
            area * mean / UNIT_TRIANGLE
        };
        Self {
            corners: cells.corners.len(),
            arcs: arcs.iter().map(ArcMeasure::total).zip(&cells.least_segments()).map(|(m, &least)| (m, least)).collect(),
            patches: cells.patches.iter().map(patch).collect(),
            borders: cells.patches.iter().map(|p| p.border.iter().map(|b| b.0).collect()).collect(),
        }
    }

    /// The budget at an edge length; an infinite one gives the least.
    fn at(&self, edge_length: f64) -> Budget {
        let segments: IdVec<CellArcId, usize> =
            self.arcs.iter().map(|&(integral, least)| ((integral / edge_length).round() as usize).max(least)).collect();
        let mut budget = Budget { edge_length, segments, inner: IdVec::new(), total: 0, needed: 0 };
        budget.inner = self.patches.ids().map(|p| self.exact_inner(&budget, p).round().max(0.0) as usize).collect();
        budget.total = self.total(&budget);
        budget
    }

    /// Inner sites of a patch before rounding; may be negative.
    fn exact_inner(&self, budget: &Budget, p: PatchId) -> f64 {
        let border = self.borders[p].iter().map(|&a| budget.segments[a]).fold(0, usize::saturating_add);
        let triangles = self.patches[p] / budget.edge_length.powi(2);
        0.5 * (triangles - border as f64 + 2.0)
    }

    fn total(&self, budget: &Budget) -> usize {
        // No sum overflows where the edge length is tried that is far too short.
        let inside = budget.segments.iter().map(|k| k - 1).chain(budget.inner.iter().copied());
        inside.fold(self.corners, usize::saturating_add)
    }

    /// Gives what is missing to the patches that rounding took most from, round and round.
    fn hand_out(&self, budget: &mut Budget, wanted: usize) {
        let mut by_remainder: Vec<(f64, PatchId)> =
            self.patches.ids().map(|p| (budget.inner[p] as f64 - self.exact_inner(budget, p), p)).collect();
        by_remainder.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let missing = wanted.saturating_sub(budget.total);
        for &(_, p) in by_remainder.iter().cycle().take(missing) {
            budget.inner[p] += 1;
        }
        budget.total = self.total(budget);
    }
}
