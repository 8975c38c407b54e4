//! Are the creases and borders of the original still edges of the remeshed surface?

use crate::distance::Stats;
use crate::edges::Side;
use crate::sampling;
use crate::weld::Welded;
use glam::DVec3;
use mesh_core::{SurfaceIndex, TriMesh, VertexId};

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

/// Points of the creases of an original, spread by length; none where it has no creases.
pub(crate) fn on_creases(original: &Welded) -> Vec<DVec3> {
    sampling::on_segments(&creases(original, ORIGINAL_CREASE_DEGREES), SAMPLES)
}

/// Points of the border of an original, spread by length; none where it has no border.
pub(crate) fn on_border(original: &Welded) -> Vec<DVec3> {
    sampling::on_segments(&borders(original), SAMPLES)
}

/// How points of the original's creases are covered, in parts of its `diagonal`; `None` without points.
pub(crate) fn crease_cover(on_creases: &[DVec3], remeshed: &Welded, diagonal: f64) -> Option<CreaseCover> {
    if on_creases.is_empty() {
        return None;
    }
    let Some(distances) = distances(on_creases, &creases(remeshed, REMESHED_CREASE_DEGREES), diagonal) else {
        return Some(CreaseCover { share: 0.0, distance: None });
    };
    let covered = distances.iter().filter(|d| **d < COVER_DISTANCE).count();
    Some(CreaseCover { share: covered as f64 / distances.len() as f64, distance: Some(Stats::of(&distances)) })
}

/// From points of the original's border to the border of the remeshed surface, in parts of the original's `diagonal`; `None`
/// without points, or where the remeshed surface has no border.
pub(crate) fn border_distance(on_border: &[DVec3], remeshed: &Welded, diagonal: f64) -> Option<Stats> {
    if on_border.is_empty() {
        return None;
    }
    Some(Stats::of(&distances(on_border, &borders(remeshed), diagonal)?))
}

/// The edges with two faces whose dihedral angle is greater.
fn creases(surface: &Welded, degrees: f64) -> Vec<[DVec3; 2]> {
    let mesh = surface.mesh();
    let sharp = surface.edges().iter().filter(|sides| dihedral(mesh, sides).is_some_and(|d| d > degrees));
    sharp.map(|sides| segment(mesh, sides[0].ends)).collect()
}

fn borders(surface: &Welded) -> Vec<[DVec3; 2]> {
    surface.edges().border().map(|ends| segment(surface.mesh(), ends)).collect()
}

fn segment(mesh: &TriMesh, ends: [VertexId; 2]) -> [DVec3; 2] {
    ends.map(|v| mesh.position(v))
}

/// The angle in degrees by which two sheets bend at their common edge, whichever way each faces; `None` unless there are two.
pub(crate) fn dihedral(mesh: &TriMesh, sides: &[Side]) -> Option<f64> {
    let [a, b] = sides else { return None };
    let cosine = mesh.normal(a.face).dot(mesh.normal(b.face));
    let facing_alike = if a.forward == b.forward { -cosine } else { cosine };
    Some(facing_alike.clamp(-1.0, 1.0).acos().to_degrees())
}

/// Distances from points to the nearest segment over `unit`; `None` without segments.
fn distances(points: &[DVec3], segments: &[[DVec3; 2]], unit: f64) -> Option<Vec<f64>> {
    let index = segment_index(segments)?;
    Some(index.distances(points).into_iter().map(|d| d / unit).collect())
}

/// Segments as triangles without area, which a surface index takes as what they are; `None` without segments.
pub(crate) fn segment_index(segments: &[[DVec3; 2]]) -> Option<SurfaceIndex> {
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
        crease_cover(&on_creases(&Welded::of(original)), &Welded::of(remeshed), original.diagonal())
    }

    #[test]
    fn a_finer_cube_keeps_all_creases() {
        let c = cover(&cube(), &subdivide(&subdivide(&cube()))).unwrap();
        assert_eq!(c.share, 1.0);
        assert!(c.distance.unwrap().max < 1e-12);
    }

    #[test]
    fn a_cube_with_one_side_moved_keeps_the_creases_of_the_other() {
        // Raised to z = 2, the cube has no crease at z = 1 any more: of the four creases there only what is within reach of the
        // upright creases is covered. Lowered to z = 1/2, the upper half of the four upright creases is lost as well.
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
        let to = |m: &TriMesh| border_distance(&on_border(&Welded::of(&a)), &Welded::of(m), a.diagonal());
        assert!((to(&b).unwrap().max - 0.1 / 2f64.sqrt()).abs() < 1e-12);
        assert_eq!(to(&cube()), None);
        assert_eq!(border_distance(&on_border(&Welded::of(&cube())), &Welded::of(&b), 1.0), None);
    }
}
