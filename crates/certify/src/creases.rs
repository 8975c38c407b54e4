//! Are the creases and borders of the original still edges of the remeshed surface?

use crate::distance::Stats;
use crate::edges::Side;
use crate::sampling;
use crate::surface::Surface;
use glam::DVec3;
use mesh_core::{SurfaceIndex, TriMesh, VertexId};
use rayon::prelude::*;

/// An edge of the original is a crease when its dihedral angle is greater, degrees. This and the three figures below are those
/// of the judge that ours must agree with.
pub const ORIGINAL_CREASE_DEGREES: f64 = 40.0;
/// An edge of the remeshed surface is a crease when its dihedral angle is greater, degrees: less than of the original, so that a
/// crease that came out a little rounder counts.
pub const REMESHED_CREASE_DEGREES: f64 = 25.0;
/// A point of a crease is covered when an output crease lies within this share of the diagonal.
pub const COVER_DISTANCE: f64 = 1e-3;
/// Points on all creases, and on all borders.
const SAMPLES: usize = 20_000;

/// How the creases of the original are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CreaseCover {
    /// Share of the original's crease length with a crease of the remeshed surface within [`COVER_DISTANCE`].
    pub share: f64,
    /// Mean and greatest distance from the original's creases to those of the remeshed surface, in parts of the original's
    /// diagonal; `None` when the remeshed surface has no creases.
    pub distance: Option<Stats>,
}

/// Measures the creases; `None` when the original has none.
pub fn crease_cover(original: &Surface, remeshed: &Surface) -> Option<CreaseCover> {
    let samples = sampling::on_segments(&creases(original, ORIGINAL_CREASE_DEGREES), SAMPLES);
    if samples.is_empty() {
        return None;
    }
    let Some(distances) = distances(&samples, &creases(remeshed, REMESHED_CREASE_DEGREES), original.diagonal) else {
        return Some(CreaseCover { share: 0.0, distance: None });
    };
    let covered = distances.iter().filter(|d| **d < COVER_DISTANCE).count();
    Some(CreaseCover { share: covered as f64 / distances.len() as f64, distance: Some(Stats::of(&distances)) })
}

/// Mean and greatest distance from the border of the original to that of the remeshed surface, in parts of the original's
/// diagonal; `None` when one of them has no border.
pub fn border_distance(original: &Surface, remeshed: &Surface) -> Option<Stats> {
    let samples = sampling::on_segments(&borders(original), SAMPLES);
    let distances = distances(&samples, &borders(remeshed), original.diagonal)?;
    (!samples.is_empty()).then(|| Stats::of(&distances))
}

/// The edges with two faces whose dihedral angle is greater.
fn creases(surface: &Surface, degrees: f64) -> Vec<[DVec3; 2]> {
    let mesh = &surface.welded;
    let sharp = surface.welded_edges.iter().filter(|sides| dihedral(mesh, sides).is_some_and(|d| d > degrees));
    sharp.map(|sides| segment(mesh, sides[0].ends)).collect()
}

fn borders(surface: &Surface) -> Vec<[DVec3; 2]> {
    surface.welded_edges.border().map(|ends| segment(&surface.welded, ends)).collect()
}

fn segment(mesh: &TriMesh, ends: [VertexId; 2]) -> [DVec3; 2] {
    ends.map(|v| mesh.position(v))
}

/// The angle in degrees by which two sheets bend at their common edge, whichever way each faces; `None` unless there are two.
fn dihedral(mesh: &TriMesh, sides: &[Side]) -> Option<f64> {
    let [a, b] = sides else { return None };
    let cosine = mesh.normal(a.face).dot(mesh.normal(b.face));
    let facing_alike = if a.forward == b.forward { -cosine } else { cosine };
    Some(facing_alike.clamp(-1.0, 1.0).acos().to_degrees())
}

/// Distances from points to the nearest segment over `unit`; `None` without segments.
fn distances(points: &[DVec3], segments: &[[DVec3; 2]], unit: f64) -> Option<Vec<f64>> {
    let index = segment_index(segments)?;
    points.par_iter().map(|&p| index.closest(p).map(|c| c.distance / unit)).collect()
}

/// Segments as triangles without area, which a surface index takes as what they are.
fn segment_index(segments: &[[DVec3; 2]]) -> Option<SurfaceIndex> {
    let positions = segments.iter().flat_map(|&[a, b]| [a, b, b]).collect();
    let faces = (0..segments.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = TriMesh::new(positions, faces).ok()?;
    (!segments.is_empty()).then(|| SurfaceIndex::new(&mesh))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{cube, moved, sphere, square, subdivide, with_face_turned};

    fn cover(original: &TriMesh, remeshed: &TriMesh) -> Option<CreaseCover> {
        crease_cover(&Surface::new(original).unwrap(), &Surface::new(remeshed).unwrap())
    }

    #[test]
    fn a_finer_cube_keeps_all_creases() {
        let c = cover(&cube(), &subdivide(&subdivide(&cube()))).unwrap();
        assert_eq!(c.share, 1.0);
        assert!(c.distance.unwrap().max < 1e-12);
    }

    #[test]
    fn a_cube_with_one_side_moved_keeps_the_creases_of_the_other() {
        // Raised, the four creases at z = 1 are lost but for their ends; lowered, they are and half of the upright ones but for
        // what is within reach.
        let reach = COVER_DISTANCE * 3f64.sqrt();
        let raised = cover(&cube(), &moved(&cube(), |p| p * DVec3::new(1.0, 1.0, 2.0))).unwrap();
        assert!((raised.share - (8.0 + 8.0 * reach) / 12.0).abs() < 1e-4, "{}", raised.share);
        let lowered = cover(&cube(), &moved(&cube(), |p| p * DVec3::new(1.0, 1.0, 0.5))).unwrap();
        let expected = (4.0 + 4.0 * (0.5 + reach)) / 12.0;
        assert!((lowered.share - expected).abs() < 1e-4, "{}", lowered.share);
        assert!((lowered.distance.unwrap().max - 0.5 / 3f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn without_creases_on_either_side() {
        assert_eq!(cover(&sphere(3), &cube()), None);
        assert_eq!(cover(&cube(), &sphere(3)), Some(CreaseCover { share: 0.0, distance: None }));
    }

    #[test]
    fn a_dihedral_angle_does_not_ask_which_way_a_face_looks() {
        assert!(cover(&with_face_turned(&square(), 0), &cube()).is_none());
        assert_eq!(cover(&with_face_turned(&cube(), 3), &cube()).unwrap().share, 1.0);
    }

    #[test]
    fn borders_of_two_squares() {
        let (a, b) = (square(), moved(&square(), |p| p + 0.1 * DVec3::Z));
        let (a, b, c) = (Surface::new(&a).unwrap(), Surface::new(&b).unwrap(), cube());
        assert!((border_distance(&a, &b).unwrap().max - 0.1 / 2f64.sqrt()).abs() < 1e-12);
        assert_eq!(border_distance(&a, &Surface::new(&c).unwrap()), None);
    }
}
