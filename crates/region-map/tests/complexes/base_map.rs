//! The bijection: locate and find undo each other through charts and any history of edits.

use crate::{crease_network, topology};
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, Id, IdVec, SurfacePoint, TriMesh};
use proptest::prelude::*;
use region_map::{BaseMap, Chart, ChartFace, ChartId, MapError, MapFaceId, SheetId};
use std::f64::consts::PI;

const SQUARE: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];

/// One chart for every side of a cube: the side's own plane, its inside pushed about so that the chart is not affine.
fn charts(mesh: &TriMesh) -> IdVec<ChartId, Chart> {
    let network = crease_network(mesh, &topology(mesh));
    let chart = |sheet: SheetId| {
        let faces: Vec<FaceId> = mesh.faces().ids().filter(|&f| network.sheet_of_face[f] == sheet).collect();
        let out = mesh.normal(faces[0]);
        // In-plane axes with `u x v` along the outer normal, both from 0 to 1 over the side.
        let u = DVec3::new(out.y.abs(), out.z.abs(), out.x.abs());
        let v = DVec3::ONE - u - out.abs();
        let (u, v) = if u.cross(v).dot(out) > 0.0 { (u, v) } else { (v, u) };
        let at = |p: DVec3| {
            let (x, y) = (p.dot(u), p.dot(v));
            let push = (PI * x).sin() * (PI * y).sin();
            DVec2::new(x + 0.1 * push, y - 0.07 * push)
        };
        let uv = faces.iter().flat_map(|&f| mesh.triangle(f)).map(at).collect();
        let piece = |(i, &source): (usize, &FaceId)| {
            let i = 3 * i as u32;
            ChartFace { vertices: [i, i + 1, i + 2], source, barycentric: [DVec3::X, DVec3::Y, DVec3::Z] }
        };
        Chart::new(uv, faces.iter().enumerate().map(piece).collect()).unwrap()
    };
    (0..network.n_sheets).map(|s| chart(SheetId::new(s))).collect()
}

/// A cube, and its map with two base faces a side: `2 i` and `2 i + 1` in chart `i`.
fn cube() -> (TriMesh, BaseMap) {
    let mesh = fixtures::cube(4);
    let charts = charts(&mesh);
    let [a, b, c, d] = SQUARE;
    let base: Vec<_> = charts.ids().flat_map(|chart| [(chart, [a, b, c]), (chart, [a, c, d])]).collect();
    let map = BaseMap::new(charts, &base).unwrap();
    (mesh, map)
}

/// Points of all working faces are found in present faces and located where they were.
fn check_round_trip(mesh: &TriMesh, map: &BaseMap, is_present: impl Fn(MapFaceId) -> bool) {
    for f in mesh.faces().ids() {
        for w in [[0.6, 0.3, 0.1], [0.2, 0.3, 0.5], [0.34, 0.33, 0.33], [1.0, 0.0, 0.0], [0.5, 0.5, 0.0]] {
            let point = SurfacePoint { face: f, barycentric: DVec3::from_array(w) };
            let (face, barycentric) = map.find(point).unwrap();
            assert!(is_present(face), "{face} is gone");
            assert!(barycentric.min_element() >= 0.0 && (barycentric.element_sum() - 1.0).abs() < 1e-12);
            let back = map.locate(face, barycentric).position(mesh);
            assert!(back.distance(point.position(mesh)) < 1e-9, "{f} {w:?}: {}", back.distance(point.position(mesh)));
        }
    }
}

#[test]
fn locate_and_find_undo_each_other() {
    let (mesh, map) = cube();
    check_round_trip(&mesh, &map, |f| f.0 < 12);
    for face in (0..12).map(MapFaceId) {
        for w in [[0.7, 0.2, 0.1], [0.1, 0.1, 0.8], [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0]].map(DVec3::from_array) {
            let (found, weights) = map.find(map.locate(face, w)).unwrap();
            assert_eq!(found, face);
            assert!(weights.distance(w) < 1e-9);
        }
    }
}

#[test]
fn corners_of_base_faces_are_the_corners_of_the_cube() {
    let (mesh, map) = cube();
    for face in (0..12).map(MapFaceId) {
        for w in [DVec3::X, DVec3::Y, DVec3::Z] {
            let p = map.locate(face, w).position(&mesh);
            assert!(p.distance(p.round()) < 1e-12, "{p}");
        }
    }
}

#[test]
fn a_point_of_no_chart_is_not_found() {
    let (mesh, map) = cube();
    let beyond = SurfacePoint::at_corner(FaceId::new(mesh.n_faces()), 0);
    assert_eq!(map.find(beyond), None);
    let (_, chart) = map.charts().enumerate().next().unwrap();
    let elsewhere = mesh.faces().ids().find(|&f| chart.faces().iter().all(|piece| piece.source != f)).unwrap();
    assert_eq!(chart.find(SurfacePoint::at_corner(elsewhere, 0)), None);
}

#[test]
fn a_chart_must_be_unfolded_and_whole() {
    let piece = |vertices| ChartFace { vertices, source: FaceId(0), barycentric: [DVec3::X, DVec3::Y, DVec3::Z] };
    let uv = SQUARE.to_vec();
    let refused = |uv: &[DVec2], faces: Vec<ChartFace>| Chart::new(uv.to_vec(), faces).unwrap_err();
    assert_eq!(refused(&uv, vec![piece([0, 1, 2]), piece([0, 3, 2])]), MapError::Folded(1));
    assert_eq!(refused(&[DVec2::ZERO, DVec2::X, 2.0 * DVec2::X], vec![piece([0, 1, 2])]), MapError::Folded(0));
    assert_eq!(refused(&uv, vec![]), MapError::Invalid);
    assert_eq!(refused(&uv, vec![piece([0, 1, 4])]), MapError::Invalid);
    assert_eq!(refused(&uv, vec![piece([0, 1, 1])]), MapError::Invalid);
    assert_eq!(refused(&[DVec2::ZERO, DVec2::X, DVec2::NAN], vec![piece([0, 1, 2])]), MapError::Invalid);
    assert!(Chart::new(uv, vec![piece([0, 1, 2]), piece([0, 2, 3])]).is_ok());
}

/// A whole face is charted as one that is given by its pieces, to the last bit.
#[test]
fn the_chart_of_a_whole_face_is_a_chart_like_any_other() {
    let mesh = fixtures::cube(2);
    let corners = [DVec2::ZERO, DVec2::X, DVec2::Y];
    for source in mesh.faces().ids() {
        let piece = ChartFace { vertices: [0, 1, 2], source, barycentric: [DVec3::X, DVec3::Y, DVec3::Z] };
        let (whole, pieces) = (Chart::of_face(source), Chart::new(corners.to_vec(), vec![piece]).unwrap());
        assert_eq!((whole.uv(), whole.faces()), (pieces.uv(), pieces.faces()));
        for i in 0..400 {
            let p = DVec2::new(f64::from(i % 20), f64::from(i / 20)) * 0.083 - DVec2::splat(0.3);
            let at = whole.locate(p);
            assert_eq!(at, pieces.locate(p), "inside, outside and on the border");
            assert_eq!(whole.find(at), pieces.find(at));
        }
        assert_eq!(whole.locate(DVec2::NAN), pieces.locate(DVec2::NAN));
        assert_eq!(whole.find(SurfacePoint::at_corner(FaceId(source.0 + 1), 0)), None);
    }
}

#[test]
fn what_is_not_there_is_refused() {
    let (_, mut map) = cube();
    let charts = map.charts().clone();
    let beyond = ChartId::new(charts.len());
    assert_eq!(BaseMap::new(charts, &[(beyond, [DVec2::ZERO, DVec2::X, DVec2::Y])]).unwrap_err(), MapError::NoSuchChart(beyond));
    assert_eq!(map.first_faces(beyond).count(), 0);
    let [old, new] = both(SQUARE);
    let no_face = MapFaceId(12);
    assert!(!map.is_present(no_face) && map.is_present(MapFaceId(11)));
    assert_eq!(map.replace(&[(MapFaceId(0), old[0]), (no_face, old[1])], &new), Err(MapError::Uncovered));
    assert_eq!(map.n_edits(), 0);
}

/// Both triangulations of a convex quadrilateral.
fn both([a, b, c, d]: [DVec2; 4]) -> [[[DVec2; 3]; 2]; 2] {
    [[[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]]
}

#[test]
fn an_edit_must_cover_what_it_replaces() {
    let (mesh, mut map) = cube();
    let [old, new] = both(SQUARE);
    let faces = [MapFaceId(0), MapFaceId(1)];
    let laid = |t: [[DVec2; 3]; 2]| [(faces[0], t[0]), (faces[1], t[1])];
    let folded = [new[0], [new[1][1], new[1][0], new[1][2]]];
    let flat = [new[0], [DVec2::ZERO, DVec2::X, 2.0 * DVec2::X]];
    let larger = [new[0], [new[1][0], new[1][1], DVec2::new(-0.001, 1.0)]];
    for bad in [folded, flat, larger] {
        assert_eq!(map.replace(&laid(old), &bad), Err(MapError::Uncovered));
    }
    assert_eq!(map.replace(&laid(folded), &new), Err(MapError::Uncovered));
    assert_eq!(map.replace(&laid(old), &new[..1]), Err(MapError::Uncovered));
    assert_eq!(map.n_edits(), 0);
    check_round_trip(&mesh, &map, |f| f.0 < 12);

    let made = map.replace(&laid(old), &new).unwrap();
    assert_eq!((made, map.n_edits()), (vec![MapFaceId(12), MapFaceId(13)], 1));
    assert_eq!(map.replace(&laid(old), &new), Err(MapError::Uncovered), "they are gone");
    check_round_trip(&mesh, &map, |f| f.0 > 1);
}

#[test]
fn a_face_too_small_for_its_weights_is_no_trap() {
    let (mesh, charts) = (fixtures::cube(1), charts(&fixtures::cube(1)));
    let tiny = [DVec2::ZERO, DVec2::X * 1e-200, DVec2::Y * 1e-200];
    let base: Vec<_> = charts.ids().map(|chart| (chart, tiny)).collect();
    let map = BaseMap::new(charts, &base).unwrap();
    let (_, w) = map.find(SurfacePoint::at_corner(FaceId(0), 1)).unwrap();
    assert!(w.is_finite() && map.locate(MapFaceId(0), w).position(&mesh).is_finite());
}

/// What is done to the two or more faces of one side of the cube.
#[derive(Clone, Debug)]
enum Step {
    /// Flip the first two faces of the side, laid out as a quadrilateral with this corner moved out.
    Flip(f64),
    /// Split a face in three at these weights.
    Split(usize, DVec3),
    /// Join the last three faces that a split made, if they still are.
    Join,
}

fn step() -> impl Strategy<Value = Step> {
    let weights = (0.1..1.0, 0.1..1.0, 0.1..1.0).prop_map(|(x, y, z)| DVec3::new(x, y, z) / (x + y + z));
    prop_oneof![(0.5..1.5).prop_map(Step::Flip), (any::<usize>(), weights).prop_map(|(i, w)| Step::Split(i, w)), Just(Step::Join)]
}

/// An equilateral triangle, and where weights lie in it.
const LAYOUT: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::new(0.5, 0.866)];

fn thirds(w: DVec3) -> [[DVec2; 3]; 3] {
    let [a, b, c] = LAYOUT;
    let m = w.x * a + w.y * b + w.z * c;
    [[a, b, m], [b, c, m], [c, a, m]]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn any_history_keeps_the_round_trip(steps in prop::collection::vec((0..6usize, step()), 1..60)) {
        let (mesh, mut map) = cube();
        // For every side its quadrilateral's two faces, the way it is cut, and what their splits made.
        let mut quads: Vec<([MapFaceId; 2], usize)> = (0..6).map(|i| ([MapFaceId(2 * i), MapFaceId(2 * i + 1)], 0)).collect();
        let mut splits: Vec<([MapFaceId; 3], DVec3)> = Vec::new();
        let half = steps.len() / 2;
        let mut at_half = (map.clone(), Vec::new());
        let mut present: Vec<MapFaceId> = (0..12).map(MapFaceId).collect();
        for (i, (side, step)) in steps.into_iter().enumerate() {
            if i == half {
                at_half = (map.clone(), present.clone());
            }
            let (old, new) = match step {
                Step::Flip(out) => {
                    let (faces, cut) = quads[side];
                    if faces.iter().any(|f| !present.contains(f)) {
                        continue;
                    }
                    let layouts = both([DVec2::ZERO, DVec2::X, DVec2::splat(out.max(0.6)), DVec2::Y]);
                    let new = map.replace(&[(faces[0], layouts[cut][0]), (faces[1], layouts[cut][1])], &layouts[1 - cut]).unwrap();
                    quads[side] = ([new[0], new[1]], 1 - cut);
                    (faces.to_vec(), new)
                }
                Step::Split(i, w) => {
                    let face = present[i % present.len()];
                    let new = map.replace(&[(face, LAYOUT)], &thirds(w)).unwrap();
                    splits.push(([new[0], new[1], new[2]], w));
                    (vec![face], new)
                }
                Step::Join => {
                    let Some((faces, w)) = splits.pop() else { continue };
                    if faces.iter().any(|f| !present.contains(f)) {
                        continue;
                    }
                    let parts = thirds(w);
                    let old: Vec<_> = faces.into_iter().zip(parts).collect();
                    (faces.to_vec(), map.replace(&old, &[LAYOUT]).unwrap())
                }
            };
            present.retain(|f| !old.contains(f));
            present.extend(new);
        }
        check_round_trip(&mesh, &map, |f| present.contains(&f));
        // Back to the middle of the history.
        let (half_map, half_present) = at_half;
        map.undo_to(half_map.n_edits());
        prop_assert_eq!(map.n_edits(), half_map.n_edits());
        check_round_trip(&mesh, &map, |f| half_present.contains(&f));
        for face in half_present {
            prop_assert_eq!(map.locate(face, DVec3::ONE / 3.0), half_map.locate(face, DVec3::ONE / 3.0));
        }
    }
}
