//! Delaunay flips: for base meshes that keep the vertices and the constraints that they were made with.

use crate::editor::Editor;
use mesh_core::VertexId;
use std::f64::consts::PI;

/// The two angles across an edge must exceed two right ones by this much, in radians, for a flip. Less lets rounding flip the edge of a rectangle
/// back and forth.
const LEAST_EXCESS: f64 = 1e-9;
/// Passes over the edges at most: flips in space could cycle, where those in a plane cannot.
const PASSES: usize = 30;

/// Flips edges whose two opposite angles sum to more than two right ones (Lawson), until there are none, but none of those that are fixed.
///
/// A chart is distorted, and what is Delaunay there has long triangles on the surface: here angles are those of the base triangles in space.
pub(crate) fn delaunay_flips(editor: &mut Editor<'_>, is_fixed: impl Fn([VertexId; 2]) -> bool) {
    for _ in 0..PASSES {
        let mut flips = 0;
        for [a, b] in editor.edges() {
            if editor.is_interrupted() {
                return;
            }
            let may_flip = !is_fixed([a.min(b), a.max(b)]) && excess(editor, a, b) > LEAST_EXCESS;
            flips += usize::from(may_flip && editor.flip(a, b));
        }
        if flips == 0 {
            return;
        }
    }
}

/// By how much the angles across an edge exceed two right ones, in radians; below 0 on a border.
fn excess(editor: &Editor<'_>, a: VertexId, b: VertexId) -> f64 {
    let length = |v: VertexId, w: VertexId| editor.surface_length(v, w);
    let angle = |tip: VertexId| opposite_angle(length(a, b), [length(tip, a), length(tip, b)]);
    match editor.faces_beside(a, b) {
        [Some((_, c)), Some((_, d))] => angle(c) + angle(d) - PI,
        _ => -PI,
    }
}

/// The angle between two sides of a triangle, in radians, by the length of the third one. One that is longer than both together is across a straight
/// angle.
fn opposite_angle(third: f64, [p, q]: [f64; 2]) -> f64 {
    ((p * p + q * q - third * third) / (2.0 * p * q)).clamp(-1.0, 1.0).acos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decimate::identity;
    use mesh_core::TriMesh;
    use region_map::Surface;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn angles_are_those_of_the_law_of_cosines() {
        assert!((opposite_angle(5.0, [3.0, 4.0]) - FRAC_PI_2).abs() < 1e-12);
        assert!((opposite_angle(1.0, [1.0, 1.0]) - PI / 3.0).abs() < 1e-12);
        assert_eq!(opposite_angle(9.0, [3.0, 4.0]), PI);
    }

    /// A flat kite, cut along its long diagonal: that is flipped to the short one, and stays where it is fixed.
    #[test]
    fn the_long_diagonal_of_a_kite_is_flipped_unless_it_is_fixed() {
        let positions = [[-2.0, 0.0, 0.0], [0.0, -0.5, 0.0], [2.0, 0.0, 0.0], [0.0, 0.5, 0.0]];
        let mesh = TriMesh::from_slices(&positions, &[[0, 1, 2], [0, 2, 3]]).unwrap();
        let surface = Surface::smooth(mesh).unwrap();
        for (is_fixed, diagonal) in [(false, [1, 3]), (true, [0, 2])] {
            let mut editor = Editor::new(&surface, identity(&surface).unwrap());
            delaunay_flips(&mut editor, |edge| is_fixed && edge == [0, 2].map(VertexId));
            assert!(editor.is_edge(VertexId(diagonal[0]), VertexId(diagonal[1])), "{is_fixed}");
            assert_eq!(editor.faces().len(), 2);
        }
    }
}
