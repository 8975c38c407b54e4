//! What an edit would do to the shape of the base triangles.

use crate::editor::{Editor, Face, signed_quality};
use glam::DVec3;
use mesh_core::{VertexId, inverse_mean_ratio};
use region_map::Attachment;
use rustc_hash::FxHashMap;

/// Cost of one edge too many or too few at a vertex, in units of the shape cost of a triangle.
const VALENCE_COST: f64 = 0.12;
/// Cost of a right angle between two neighbouring triangles off the creases.
const FOLD_COST: f64 = 2.0;
/// Cost of a triangle with a straight corner: above two of the worst shapes, so that no flip makes one to mend a needle.
const STRAIGHT_COST: f64 = 300.0;
/// The cost of a flat pair of equilateral triangles.
const LEAST_PAIR_COST: f64 = 2.0;
/// Angle of the surface between two arcs, in degrees, beyond which a triangle's corner between them counts as straight.
const STRAIGHT: f64 = 150.0;

/// True for a face that faces against the surface that it covers, or has no area.
pub(crate) fn is_folded(editor: &Editor<'_>, corners: [VertexId; 3]) -> bool {
    let mut faces = editor.faces_at(corners[0]).filter(|f| f.from(corners[0]) == corners);
    faces.any(|f| signed_quality(editor.triangle(&f), f.normal) <= 0.0)
}

/// What the cost falls by when the edge is flipped; negative infinity where it can't be, or would not fall.
pub(crate) fn flip_gain(editor: &Editor<'_>, ideal: &mut IdealValences, a: VertexId, b: VertexId) -> f64 {
    let [Some((f, c)), Some((g, d))] = editor.faces_beside(a, b) else { return f64::NEG_INFINITY };
    if editor.span(a, b).is_some() || c == d || editor.valence(a) <= 3 || editor.valence(b) <= 3 {
        return f64::NEG_INFINITY;
    }
    let before = pair_cost(editor, ([a, b, c], f.normal), ([b, a, d], g.normal));
    let mut valence_gain = |v: VertexId, change: f64| {
        let excess = editor.valence(v) as f64 - ideal.of(editor, v);
        excess.powi(2) - (excess + change).powi(2)
    };
    let valences = valence_gain(a, -1.0) + valence_gain(b, -1.0) + valence_gain(c, 1.0) + valence_gain(d, 1.0);
    // Most flips are ruled out by the two triangles that are there.
    if before - LEAST_PAIR_COST + VALENCE_COST * valences <= 0.0 || editor.is_edge(c, d) {
        return f64::NEG_INFINITY;
    }
    let normal = (f.normal + g.normal).normalize_or_zero();
    let after = pair_cost(editor, ([a, d, c], normal), ([d, b, c], normal));
    before - after + VALENCE_COST * valences
}

/// What two neighbouring triangles cost: their inverse mean ratios, their angle, and their straight corners.
fn pair_cost(editor: &Editor<'_>, s: ([VertexId; 3], DVec3), t: ([VertexId; 3], DVec3)) -> f64 {
    let [p, q] = [s.0, t.0].map(|f| f.map(|v| editor.position(v)));
    let fold = 1.0 - mesh_core::normal(p).dot(mesh_core::normal(q));
    let straight = [s.0, t.0].into_iter().filter(|&f| has_straight_corner(editor, f)).count();
    inverse_mean_ratio(p, s.1) + inverse_mean_ratio(q, t.1) + FOLD_COST * fold + STRAIGHT_COST * straight as f64
}

/// True for a triangle with a straight corner: the surface between two of its edges on arcs turns by nearly half a circle or more, however near the arcs
/// are to each other in space; or they are on one arc, and their vertex slides along that, and out of any bend. However good the base triangle
/// looks: subdivided along the arcs, its corner there opens to 180 degrees.
pub(crate) fn has_straight_corner(editor: &Editor<'_>, face: [VertexId; 3]) -> bool {
    (0..3).any(|i| {
        let [v, next, last] = [0, 1, 2].map(|k| face[(i + k) % 3]);
        match editor.attachment(v) {
            Attachment::Sheet(_) => false,
            Attachment::Arc { .. } => editor.span(v, next).is_some() && editor.span(v, last).is_some(),
            Attachment::Corner(_) => editor.opening(v, next, last).is_some_and(|degrees| degrees > STRAIGHT),
        }
    })
}

/// The ideal valences of vertices, as long as nothing around them changes: on a screw they took a third of all flips.
#[derive(Default)]
pub(crate) struct IdealValences(FxHashMap<VertexId, f64>);

impl IdealValences {
    fn of(&mut self, editor: &Editor<'_>, v: VertexId) -> f64 {
        match editor.attachment(v) {
            Attachment::Sheet(_) => 6.0,
            _ => *self.0.entry(v).or_insert_with(|| ideal_valence(editor, v)),
        }
    }

    /// Forgets those of the corners of the two faces beside an edge.
    pub(crate) fn forget(&mut self, editor: &Editor<'_>, a: VertexId, b: VertexId) {
        let opposite = editor.faces_beside(a, b).into_iter().flatten().map(|(_, v)| v);
        for v in opposite.chain([a, b]) {
            self.0.remove(&v);
        }
    }
}

/// The number of edges that divides the angle round a vertex on an arc or at a corner into steps of 60 degrees.
fn ideal_valence(editor: &Editor<'_>, v: VertexId) -> f64 {
    let angle_in = |f: Face| {
        let c = f.vertices.iter().position(|&w| w == v).unwrap_or(0);
        mesh_core::angles(editor.triangle(&f))[c]
    };
    let angle: f64 = editor.faces_at(v).map(angle_in).sum();
    angle / 60f64.to_radians() + f64::from(editor.is_on_border(v))
}
