//! Which triangles of a surface run into each other? Exact, as CGAL's `self_intersections` defines it: two faces intersect when
//! they meet in more than an edge or a corner that both have.

use crate::surface::Surface;
use crate::triangle_pair::{Triangle, meet_beyond_corner, meet_beyond_edge, triangles_meet};
use crate::weld::first_at_position;
use mesh_core::{Bounds, FaceId, IdVec, VertexId, exact};
use rayon::prelude::*;

/// The pairs of faces that intersect, the lower one first, in order. Corners at the same position are the same; faces that are
/// exactly degenerate are left out.
pub fn self_intersections(surface: &Surface) -> Vec<[FaceId; 2]> {
    let first = first_at_position(surface.mesh);
    let corners: IdVec<FaceId, [VertexId; 3]> = surface.mesh.faces().iter().map(|f| f.map(|v| first[v])).collect();
    let degenerate = |f: FaceId| {
        let [a, b, c] = surface.mesh.triangle(f);
        exact::collinear(a, b, c)
    };
    let partners = |f: FaceId| {
        let bounds = Bounds::of(surface.mesh.triangle(f)).filter(|_| !degenerate(f));
        let mut faces = bounds.map_or(Vec::new(), |b| surface.index.faces_in_box(&b));
        faces.retain(|&g| g > f && intersect(surface, &corners, f, g) && !degenerate(g));
        faces
    };
    let faces: Vec<FaceId> = corners.ids().collect();
    faces.into_par_iter().flat_map_iter(|f| partners(f).into_iter().map(move |g| [f, g])).collect()
}

/// The number of different faces in some pairs.
pub fn faces_involved(pairs: &[[FaceId; 2]]) -> usize {
    let mut faces = pairs.concat();
    faces.sort_unstable();
    faces.dedup();
    faces.len()
}

fn intersect(surface: &Surface, corners: &IdVec<FaceId, [VertexId; 3]>, f: FaceId, g: FaceId) -> bool {
    // Corners of the triangle from corner `c` on.
    let from = |f: FaceId, c: usize| -> Triangle { [0, 1, 2].map(|k| surface.mesh.triangle(f)[(c + k) % 3]) };
    let shared = |f: FaceId, g: FaceId| [0, 1, 2].map(|c| corners[g].contains(&corners[f][c]));
    let (in_f, in_g) = (shared(f, g), shared(g, f));
    let corner = |shared: [bool; 3], wanted: bool| (0..3).find(|&c| shared[c] == wanted).unwrap_or(0);
    match in_f.into_iter().filter(|s| *s).count() {
        0 => triangles_meet(from(f, 0), from(g, 0)),
        1 => meet_beyond_corner(from(f, corner(in_f, true)), from(g, corner(in_g, true))),
        2 => meet_beyond_edge(from(f, corner(in_f, false) + 1), from(g, corner(in_g, false))[0]),
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{cube, joined, mesh, moved, sphere, square};
    use glam::DVec3;
    use mesh_core::TriMesh;

    fn pairs(m: &TriMesh) -> Vec<[u32; 2]> {
        self_intersections(&Surface::new(m).unwrap()).into_iter().map(|p| p.map(|f| f.0)).collect()
    }

    #[test]
    fn embedded_surfaces_have_none() {
        for m in [cube(), sphere(2), square(), joined(&cube(), &moved(&cube(), |p| p + 1.5 * DVec3::X))] {
            assert!(pairs(&m).is_empty());
        }
    }

    #[test]
    fn crossing_cubes() {
        let both = joined(&cube(), &moved(&cube(), |p| p + DVec3::new(0.5, 0.6, 0.7)));
        let found = self_intersections(&Surface::new(&both).unwrap());
        assert!(found.iter().all(|[f, g]| f.0 < 12 && g.0 >= 12));
        // Each cube has three sides that the other one enters, at one corner of the other.
        assert!(faces_involved(&found) >= 12);
        let apart = joined(&cube(), &moved(&cube(), |p| p + (1.0 + 1e-12) * DVec3::X));
        assert!(pairs(&apart).is_empty());
    }

    #[test]
    fn folds_of_neighbours() {
        let fold = |tip: [f64; 3]| pairs(&mesh(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], tip], &[[0, 1, 2], [1, 0, 3]]));
        assert_eq!(fold([0.3, 0.3, 0.0]), [[0, 1]]);
        assert!(fold([0.3, 0.3, 1e-9]).is_empty());
        assert!(fold([0.3, -0.3, 0.0]).is_empty());
    }

    #[test]
    fn the_same_triangle_twice_and_one_without_area() {
        assert_eq!(pairs(&joined(&square(), &square())), [[0, 2], [1, 3]]);
        let needle =
            mesh(&[[0., 0., 0.], [4., 0., 0.], [0., 4., 0.], [1., 1., -1.], [1., 1., 1.], [1., 1., 2.]], &[[0, 1, 2], [3, 4, 5]]);
        assert!(pairs(&needle).is_empty());
    }
}
