//! Which triangles of a surface run into each other? Exact, as CGAL's `self_intersections` defines it: two faces intersect when
//! they meet in more than an edge or a corner that both have.

use crate::apart::Triangle;
use crate::triangle_pair::{meet_beyond_corner, meet_beyond_edge, triangles_meet};
use crate::weld::Welded;
use mesh_core::{FaceId, IdVec, SurfaceIndex, TriMesh, VertexId, exact};

/// The faces of a mesh that intersect others, in rising order. Corners at the same position are the same; faces that are exactly
/// degenerate are left out.
pub fn self_intersecting(mesh: &TriMesh) -> Vec<FaceId> {
    among(mesh, &Welded::of(mesh), &SurfaceIndex::new(mesh))
}

/// The same with the welded mesh and the index at hand.
pub(crate) fn among(mesh: &TriMesh, welded: &Welded, index: &SurfaceIndex) -> Vec<FaceId> {
    let degenerate: IdVec<FaceId, bool> = mesh
        .faces()
        .ids()
        .map(|f| {
            let [a, b, c] = mesh.triangle(f);
            exact::collinear(a, b, c)
        })
        .collect();
    // The first partner is enough: in a crumpled surface every face meets thousands.
    index.faces_that_meet(|faces, triangles| {
        !faces.iter().any(|&f| degenerate[f]) && intersect(faces.map(|f| welded.first(mesh.face(f))), triangles)
    })
}

/// Whether two faces meet in more than what they share, by the ids of their corners and their positions.
fn intersect([f, g]: [[VertexId; 3]; 2], [t, u]: [&Triangle; 2]) -> bool {
    let shared = |f: [VertexId; 3], g: [VertexId; 3]| f.map(|v| g.contains(&v));
    let (in_f, in_g) = (shared(f, g), shared(g, f));
    let corner = |shared: [bool; 3], wanted: bool| (0..3).find(|&c| shared[c] == wanted).unwrap_or(0);
    match in_f.into_iter().filter(|s| *s).count() {
        0 => triangles_meet(*t, *u),
        1 => meet_beyond_corner(from(t, corner(in_f, true)), from(u, corner(in_g, true))),
        2 => meet_beyond_edge(from(t, corner(in_f, false) + 1), u[corner(in_g, false)]),
        _ => true,
    }
}

/// The corners of a triangle from corner `c` on.
fn from(t: &Triangle, c: usize) -> Triangle {
    [t[c % 3], t[(c + 1) % 3], t[(c + 2) % 3]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{cube, joined, mesh, moved, sphere, square};
    use glam::DVec3;

    fn found(m: &TriMesh) -> Vec<u32> {
        self_intersecting(m).into_iter().map(|f| f.0).collect()
    }

    #[test]
    fn embedded_surfaces_have_none() {
        for m in [cube(), sphere(2), square(), joined(&cube(), &moved(&cube(), |p| p + 1.5 * DVec3::X))] {
            assert!(found(&m).is_empty());
        }
    }

    #[test]
    fn crossing_cubes() {
        let both = joined(&cube(), &moved(&cube(), |p| p + DVec3::new(0.5, 0.6, 0.7)));
        // Each cube has three sides that the other one enters, at one corner of the other.
        let inside = |faces: std::ops::Range<u32>| found(&both).into_iter().filter(|f| faces.contains(f)).count();
        assert!((6..12).contains(&inside(0..12)) && (6..12).contains(&inside(12..24)));
        let apart = joined(&cube(), &moved(&cube(), |p| p + (1.0 + 1e-12) * DVec3::X));
        assert!(found(&apart).is_empty());
    }

    #[test]
    fn folds_of_neighbours() {
        let fold = |tip: [f64; 3]| found(&mesh(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], tip], &[[0, 1, 2], [1, 0, 3]]));
        assert_eq!(fold([0.3, 0.3, 0.0]), [0, 1]);
        assert!(fold([0.3, 0.3, 1e-9]).is_empty());
        assert!(fold([0.3, -0.3, 0.0]).is_empty());
    }

    #[test]
    fn only_faces_that_meet_others_are_found() {
        let beside = moved(&square(), |p| p + 9.0 * DVec3::X);
        assert_eq!(found(&joined(&joined(&square(), &beside), &square())), [0, 1, 4, 5]);
        let needle =
            mesh(&[[0., 0., 0.], [4., 0., 0.], [0., 4., 0.], [1., 1., -1.], [1., 1., 1.], [1., 1., 2.]], &[[0, 1, 2], [3, 4, 5]]);
        assert!(found(&needle).is_empty());
    }
}
