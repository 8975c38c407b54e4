//! [`SurfaceIndex`] against brute force over all faces.

use glam::DVec3;
use mesh_core::{Bounds, Closest, FaceId, Hit, Line, SHEET_DISTANCE, SurfaceIndex, SurfacePoint, TriMesh, closest_on_triangle};
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::sync::Mutex;

fn brute_closest(mesh: &TriMesh, faces: &[FaceId], point: DVec3) -> Option<Closest> {
    let all = faces.iter().map(|&face| {
        let barycentric = closest_on_triangle(point, mesh.triangle(face));
        let position = SurfacePoint { face, barycentric }.position(mesh);
        Closest { face, barycentric, position, distance: position.distance(point) }
    });
    all.min_by(|a, b| (a.distance, a.face).partial_cmp(&(b.distance, b.face)).unwrap())
}

/// Smallest parameter of a hit that is well ahead of the origin and well conditioned, without any tree.
fn brute_hit(mesh: &TriMesh, faces: &[FaceId], line: &Line, on_ray: f64) -> Option<(f64, FaceId)> {
    let all = faces.iter().filter_map(|&face| {
        let barycentric = line.crossing(mesh.triangle(face))?;
        let position = SurfacePoint { face, barycentric }.position(mesh);
        let t = line.parameter(position);
        let off = position.distance(line.origin + t * line.direction);
        (off <= on_ray && t >= 0.0).then_some((t, face))
    });
    all.min_by(|a, b| a.partial_cmp(b).unwrap())
}

fn check_closest(mesh: &TriMesh, faces: &[FaceId], points: &[DVec3]) {
    let index = SurfaceIndex::of_faces(mesh, faces.iter().copied());
    let distances = points.iter().map(|&p| brute_closest(mesh, faces, p).map_or(f64::INFINITY, |c| c.distance));
    assert_eq!(index.distances(points), distances.collect::<Vec<_>>());
    assert_eq!(index.closest_of_each(points), points.iter().map(|&p| brute_closest(mesh, faces, p)).collect::<Vec<_>>());
    for &p in points {
        assert_eq!(index.closest(p), brute_closest(mesh, faces, p));
        let even: Vec<_> = faces.iter().copied().filter(|f| f.0 % 2 == 0).collect();
        assert_eq!(index.closest_where(p, |f| f.0 % 2 == 0), brute_closest(mesh, &even, p));
        if let Some(c) = index.closest(p) {
            assert_eq!(index.closest_within(p, c.distance), Some(c));
            assert_eq!(index.closest_within(p, c.distance.next_down()), None);
            assert_eq!(c.point().position(mesh), c.position);
        }
    }
}

fn check_hits(mesh: &TriMesh, faces: &[FaceId], rays: &[(DVec3, DVec3)]) {
    let index = SurfaceIndex::of_faces(mesh, faces.iter().copied());
    for &(origin, direction) in rays {
        let [ahead, back] = index.first_hits_both_ways(origin, direction);
        check_hit(mesh, faces, origin, direction, ahead);
        check_hit(mesh, faces, origin, -direction, back);
    }
}

fn check_hit(mesh: &TriMesh, faces: &[FaceId], origin: DVec3, direction: DVec3, hit: Option<Hit>) {
    let scale = mesh.diagonal();
    let Some(line) = Line::new(origin, direction) else {
        assert_eq!(hit, None);
        return;
    };
    // The brute force is a hair stricter at the origin and off the ray, so it may miss what the index finds, never the reverse.
    if let Some((t, face)) = brute_hit(mesh, faces, &line, 1e-10 * scale) {
        let hit = hit.unwrap_or_else(|| panic!("missed {face:?} at {t}"));
        assert!((hit.t, hit.face) <= (t, face), "{hit:?} is behind {face:?} at {t}");
    }
    if let Some(hit) = hit {
        assert!(hit.t >= 0.0 && hit.barycentric.min_element() >= 0.0);
        assert!(faces.contains(&hit.face));
        let on_ray = origin + hit.t * direction;
        assert!(hit.position.distance(on_ray) <= 3e-9 * scale, "off the ray: {hit:?}");
        assert!(hit.point().position(mesh).distance(hit.position) == 0.0);
    }
}

fn all_faces(mesh: &TriMesh) -> Vec<FaceId> {
    mesh.faces().ids().collect()
}

/// `n` by `n` squares in the plane `axis = height`, each cut in two.
fn grid(n: u32, axis: usize, height: f64) -> TriMesh {
    let at = |i: u32, j: u32| {
        let mut p = [height; 3];
        p[(axis + 1) % 3] = f64::from(i) / f64::from(n);
        p[(axis + 2) % 3] = f64::from(j) / f64::from(n);
        DVec3::from_array(p)
    };
    let positions = (0..=n).flat_map(|i| (0..=n).map(move |j| at(i, j))).collect();
    let id = |i: u32, j: u32| i * (n + 1) + j;
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let faces =
        squares.flat_map(|(i, j)| [[id(i, j), id(i + 1, j), id(i + 1, j + 1)], [id(i, j), id(i + 1, j + 1), id(i, j + 1)]]);
    TriMesh::new(positions, faces.collect()).unwrap()
}

fn point() -> impl Strategy<Value = DVec3> {
    prop_oneof![
        3 => prop::array::uniform3(-2.0..2.0).prop_map(DVec3::from_array),
        // Coordinates that meet each other and the axes exactly.
        2 => prop::array::uniform3(-2i8..=2).prop_map(|p| DVec3::from_array(p.map(|x| f64::from(x) * 0.5))),
    ]
}

/// Triangles without any order: some flat, some without area, some repeated.
fn soup() -> impl Strategy<Value = TriMesh> {
    let placed = (prop::collection::vec(point(), 3..60), point(), prop_oneof![Just(1.0), Just(1e-4), Just(1e5)]);
    placed.prop_map(|(points, offset, scale)| {
        let positions: Vec<_> = points.iter().map(|p| scale * (*p + 3.0 * offset)).collect();
        let n = positions.len() as u32;
        let faces = (0..2 * n).map(|i| [i % n, (i + 1 + i / n) % n, (i * i + 2) % n]);
        let faces = faces.filter(|f| f[0] != f[1] && f[1] != f[2] && f[2] != f[0]).collect();
        TriMesh::new(positions, faces).unwrap()
    })
}

proptest! {
    #[test]
    fn closest_points_of_soups(mesh in soup(), points in prop::collection::vec(point(), 1..30)) {
        let box_of = mesh.bounds();
        prop_assume!(box_of.is_some());
        let centre = box_of.unwrap().centre();
        let near: Vec<_> = points.iter().map(|p| centre + mesh.diagonal() * *p).collect();
        check_closest(&mesh, &all_faces(&mesh), &near);
        check_closest(&mesh, &all_faces(&mesh), mesh.positions().as_slice());
    }

    #[test]
    fn first_hits_in_soups(mesh in soup(), rays in prop::collection::vec((point(), point()), 1..30)) {
        let box_of = mesh.bounds();
        prop_assume!(box_of.is_some());
        let centre = box_of.unwrap().centre();
        let size = mesh.diagonal();
        let rays: Vec<_> = rays.iter().map(|(o, d)| (centre + size * *o, *d)).collect();
        check_hits(&mesh, &all_faces(&mesh), &rays);
        // From vertices, through vertices and along edges.
        let p = mesh.positions().as_slice();
        let exact: Vec<_> = p.windows(2).map(|w| (w[0], w[1] - w[0])).collect();
        check_hits(&mesh, &all_faces(&mesh), &exact);
    }

    #[test]
    fn some_faces_only(mesh in soup(), points in prop::collection::vec(point(), 1..10)) {
        let some: Vec<_> = all_faces(&mesh).into_iter().filter(|f| f.0 % 3 == 0).collect();
        check_closest(&mesh, &some, &points);
    }
}

#[test]
fn one_triangle_and_none() {
    let mesh = TriMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]]).unwrap();
    let points = [DVec3::new(0.2, 0.2, 1.0), DVec3::new(-3.0, 0.0, 0.0), DVec3::splat(1e12)];
    check_closest(&mesh, &[FaceId(0)], &points);
    check_closest(&mesh, &[], &points);
    check_hits(&mesh, &[], &[(DVec3::ZERO, DVec3::X)]);
    let index = SurfaceIndex::new(&mesh);
    assert_eq!(index.closest(DVec3::NAN), None);
    assert_eq!(index.first_hit(DVec3::ZERO, DVec3::ZERO), None);
    let hit = index.first_hit(DVec3::new(0.25, 0.25, 2.0), DVec3::new(0.0, 0.0, -4.0)).unwrap();
    assert_eq!((hit.t, hit.position), (0.5, DVec3::new(0.25, 0.25, 0.0)));
    assert_eq!(index.first_hit(DVec3::new(0.25, 0.25, 2.0), DVec3::Z), None);
}

#[test]
fn rays_in_the_faces_of_flat_patches_boxes() {
    for axis in 0..3 {
        for height in [0.0, 0.1, -7.3] {
            let mesh = grid(8, axis, height);
            let index = SurfaceIndex::new(&mesh);
            let mut normal = DVec3::ZERO;
            normal[axis] = 1.0;
            for i in 0..=64 {
                for j in 0..=64 {
                    let mut p = [height; 3];
                    p[(axis + 1) % 3] = f64::from(i) / 64.0;
                    p[(axis + 2) % 3] = f64::from(j) / 64.0;
                    let p = DVec3::from_array(p);
                    let [ahead, back] = index.first_hits_both_ways(p - 2.0 * normal, normal);
                    assert!((ahead.unwrap().t - 2.0).abs() < 1e-12 && back.is_none(), "{p}");
                    // A ray that starts on the surface finds it at 0 both ways.
                    let both = index.first_hits_both_ways(p, normal);
                    assert!(both.iter().all(|hit| hit.unwrap().t < 1e-15), "{p}");
                    assert!((index.closest(p + 0.5 * normal).unwrap().distance - 0.5).abs() < 1e-15);
                }
            }
        }
    }
}

#[test]
fn a_slanted_ray_from_any_point_of_a_surface_finds_it_at_once() {
    let mesh = grid(5, 2, 0.3);
    let index = SurfaceIndex::new(&mesh);
    for f in mesh.faces().ids() {
        for weights in [[1.0, 1.0, 1.0], [1.0, 0.0, 0.0], [0.3, 0.7, 0.0], [1.0, 1e-9, 0.0]] {
            let p = SurfacePoint::new(f, weights.into()).position(&mesh);
            for direction in [DVec3::new(0.3, 0.2, 1.0), DVec3::new(5.0, 0.0, 0.1), DVec3::new(-1.0, 1.0, -1e-3)] {
                let t = index.first_hits_both_ways(p, direction).map(|hit| hit.map_or(f64::MAX, |h| h.t));
                assert!(t[0].min(t[1]) < 1e-9, "{p} along {direction}: {t:?}");
            }
        }
    }
}

#[test]
fn pairs_whose_boxes_meet_are_asked_for_until_one_will_do() {
    let mesh = grid(16, 1, 0.5);
    let index = SurfaceIndex::new(&mesh);
    let meet = |f: FaceId, g: FaceId| {
        let [a, b] = [f, g].map(|f| Bounds::of(mesh.triangle(f)).unwrap());
        f != g && a.min.cmple(b.max).all() && b.min.cmple(a.max).all()
    };
    let asked = Mutex::new(BTreeSet::new());
    let ask = |pair: [FaceId; 2], triangles: [&[DVec3; 3]; 2], holds: bool| {
        assert_eq!(triangles.map(|t| *t), pair.map(|f| mesh.triangle(f)));
        assert!(asked.lock().unwrap().insert(pair), "{pair:?} again");
        holds
    };
    assert!(index.faces_that_meet(|pair, triangles| ask(pair, triangles, false)).is_empty());
    let all: BTreeSet<[FaceId; 2]> = asked.lock().unwrap().split_off(&[FaceId(0); 2]);
    let expected = mesh.faces().ids().flat_map(|f| mesh.faces().ids().map(move |g| [f, g])).filter(|&[f, g]| meet(f, g));
    assert_eq!(all, expected.collect());
    assert_eq!(index.faces_that_meet(|pair, triangles| ask(pair, triangles, pair[0].0 % 3 == 0)), third(&mesh));
    let asked = asked.lock().unwrap();
    assert!(third(&mesh).iter().all(|f| asked.iter().filter(|pair| pair[0] == *f).count() == 1));
}

fn third(mesh: &TriMesh) -> Vec<FaceId> {
    mesh.faces().ids().filter(|f| f.0 % 3 == 0).collect()
}

#[test]
fn far_points_are_as_good_as_near_ones() {
    let mesh = grid(8, 2, 0.5);
    for size in [0.5, 3.0, 5.0, 100.0, 1e4, 1e8] {
        let points: Vec<_> = (0..200).map(|i| size * DVec3::new((i as f64).sin(), (2.5 * i as f64).cos(), 1.0)).collect();
        check_closest(&mesh, &all_faces(&mesh), &points);
    }
}

#[test]
fn a_sheet_in_the_same_place_may_face_the_other_way() {
    // A square that faces up, and one that faces down below it.
    let plates = |gap: f64| {
        let [top, bottom] = [0.0, -gap].map(|z| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]]);
        let faces = [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]];
        SurfaceIndex::new(&TriMesh::from_slices(&[top, bottom].concat(), &faces).unwrap())
    };
    let place = DVec3::new(0.7, 0.2, 1e-7);
    for (gap, opposes) in [(0.9 * SHEET_DISTANCE, false), (2.0 * SHEET_DISTANCE, true)] {
        let index = plates(gap * 2f64.sqrt());
        assert!(!index.opposes(place, DVec3::Z) && !index.nearest_opposes(place, 0.1 * DVec3::Z));
        assert!(index.nearest_opposes(place, -DVec3::Z));
        assert_eq!(index.opposes(place, -DVec3::Z), opposes);
        // What stands upright, or has no normal, opposes nothing.
        assert!(!index.opposes(place, DVec3::X) && !index.opposes(place, DVec3::ZERO) && !index.opposes(place, DVec3::NAN));
    }
}

#[test]
fn many_equal_triangles_are_no_trouble() {
    let n = 20_000;
    let mesh = TriMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]; n]).unwrap();
    let index = SurfaceIndex::new(&mesh);
    assert_eq!(index.closest(DVec3::Z).unwrap().face, FaceId(0));
    assert_eq!(index.first_hit(DVec3::new(0.2, 0.2, 1.0), -DVec3::Z).unwrap().face, FaceId(0));
}
