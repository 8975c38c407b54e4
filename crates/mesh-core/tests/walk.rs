//! Walks against plane geometry, unfoldings and barriers.

use glam::DVec3;
use mesh_core::{EdgeId, FaceId, IdVec, SurfacePoint, Topology, TriMesh, VertexId, Walked, closest_on_triangle, walk_end};
use proptest::prelude::*;
use std::collections::HashMap;

/// The walk, whose end alone has to be the same to the last bit.
fn walk(
    mesh: &TriMesh,
    topology: &Topology,
    start: SurfacePoint,
    displacement: DVec3,
    may_cross: impl Fn(EdgeId) -> bool,
) -> Walked {
    let walked = mesh_core::walk(mesh, topology, start, displacement, &may_cross);
    assert_eq!(walk_end(mesh, topology, start, displacement, &may_cross), walked.end);
    walked
}

fn with_topology(positions: Vec<DVec3>, faces: Vec<[u32; 3]>) -> (TriMesh, Topology) {
    let mesh = TriMesh::new(positions, faces).unwrap();
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    (mesh, topology)
}

/// Corner (`i`, `j`) of a grid on `at`, `n` squares a side, each cut in two.
fn grid(n: u32, at: impl Fn(f64, f64) -> DVec3) -> (TriMesh, Topology) {
    let share = |i: u32| f64::from(i) / f64::from(n);
    let positions = (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))).map(|(i, j)| at(share(i), share(j)));
    let id = |i: u32, j: u32| i * (n + 1) + j;
    let faces = (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).flat_map(|(i, j)| {
        let [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
        if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
    });
    with_topology(positions.collect(), faces.collect())
}

fn flat(n: u32) -> (TriMesh, Topology) {
    grid(n, |x, y| DVec3::new(x, y, 0.0))
}

/// A point of the mesh at a position.
fn at(mesh: &TriMesh, p: DVec3) -> SurfacePoint {
    let points = mesh.faces().ids().map(|f| SurfacePoint::new(f, closest_on_triangle(p, mesh.triangle(f))));
    let distance = |s: &SurfacePoint| s.position(mesh).distance(p);
    points.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
}

fn check_valid(walked: &Walked) {
    let w = walked.end.barycentric;
    assert!(w.min_element() >= 0.0 && (w.element_sum() - 1.0).abs() < 1e-14, "{walked:?}");
    let length = walked.direction.length();
    assert!(length == 0.0 || (length - 1.0).abs() < 1e-9, "{walked:?}");
}

fn octahedron_sphere(levels: u32) -> (TriMesh, Topology) {
    let mut positions: Vec<DVec3> = [DVec3::X, DVec3::Y, DVec3::Z].iter().flat_map(|&a| [a, -a]).collect();
    let mut faces: Vec<[u32; 3]> = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..levels {
        let mut middle = HashMap::new();
        let mut mid = |a: u32, b: u32| {
            *middle.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize());
                positions.len() as u32 - 1
            })
        };
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [mid(a, b), mid(b, c), mid(c, a)];
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]]
            })
            .collect();
    }
    with_topology(positions, faces)
}

#[test]
fn in_a_flat_square_walks_are_straight() {
    let (mesh, topology) = flat(7);
    let points = [[0.5, 0.5], [0.31, 0.77], [2.0 / 7.0, 3.0 / 7.0], [1.0 / 7.0, 0.5], [0.123, 0.123]];
    for p in points {
        for q in points {
            let (p, q) = (DVec3::new(p[0], p[1], 0.0), DVec3::new(q[0], q[1], 0.0));
            // What sticks out of the plane does not count.
            let walked = walk(&mesh, &topology, at(&mesh, p), q - p + 3.0 * DVec3::Z, |_| true);
            check_valid(&walked);
            assert!(walked.end.position(&mesh).distance(q) < 1e-9 && !walked.stopped, "{p} to {q}: {walked:?}");
            assert!(p == q || walked.direction.dot((q - p).normalize()) > 1.0 - 1e-9);
        }
    }
}

#[test]
fn at_the_border_a_walk_slides_and_rests_in_corners() {
    let (mesh, topology) = flat(4);
    let cases = [
        ([0.5, 0.6], [0.2, -9.0], [0.7, 0.0]),
        ([0.5, 0.6], [-9.0, -0.3], [0.0, 0.3]),
        ([0.5, 0.6], [9.0, 8.0], [1.0, 1.0]),
        ([0.0, 0.0], [-1.0, -1.0], [0.0, 0.0]),
        ([0.0, 0.0], [0.5, -1.0], [0.5, 0.0]),
        ([1.0, 0.3], [0.5, 0.2], [1.0, 0.5]),
        ([0.0, 1.0], [0.3, -0.4], [0.3, 0.6]),
    ];
    for (p, d, q) in cases {
        let [p, d, q] = [p, d, q].map(|v| DVec3::new(v[0], v[1], 0.0));
        let walked = walk(&mesh, &topology, at(&mesh, p), d, |_| true);
        check_valid(&walked);
        assert!(walked.end.position(&mesh).distance(q) < 1e-9, "{p} + {d}: {walked:?}");
        assert_eq!(walked.stopped, p + d != q, "{p} + {d}");
    }
}

#[test]
fn on_a_cube_walks_follow_the_unfolding() {
    // A strip of four sides around the cube, each a square cut in two, and the walk once around it.
    let positions = [0.0, 1.0]
        .iter()
        .flat_map(|&z| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|p: [f64; 2]| DVec3::new(p[0], p[1], z)));
    let sides = (0..4u32).flat_map(|i| {
        let j = (i + 1) % 4;
        [[i, j, j + 4], [i, j + 4, i + 4]]
    });
    let (mesh, topology) = with_topology(positions.collect(), sides.collect());
    let start = SurfacePoint::new(FaceId(0), DVec3::new(0.5, 0.3, 0.2));
    let p = start.position(&mesh);
    let walked = walk(&mesh, &topology, start, DVec3::new(4.0, 0.0, 0.5), |_| true);
    check_valid(&walked);
    assert!(walked.end.position(&mesh).distance(p + 0.5 * DVec3::Z) < 1e-12 && !walked.stopped);
    // A quarter of the way round, "x" has become "y".
    let walked = walk(&mesh, &topology, start, DVec3::new(1.0, 0.0, 0.25), |_| true);
    let expected = DVec3::new(1.0, p.x, p.z + 0.25);
    assert!(walked.end.position(&mesh).distance(expected) < 1e-12);
    assert!(walked.direction.distance(DVec3::new(0.0, 1.0, 0.25).normalize()) < 1e-12);
}

#[test]
fn a_start_on_an_edge_belongs_to_both_sides() {
    // Two squares at a right angle along the y axis.
    let positions = [[0, 0, 0], [0, 1, 0], [-1, 0, 0], [-1, 1, 0], [0, 0, -1], [0, 1, -1]];
    let positions = positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
    let (mesh, topology) = with_topology(positions, vec![[2, 0, 1], [2, 1, 3], [0, 4, 5], [0, 5, 1]]);
    let start = SurfacePoint::new(FaceId(0), DVec3::new(0.0, 0.5, 0.5));
    let down = walk(&mesh, &topology, start, DVec3::new(0.0, 0.0, -0.4), |_| true);
    assert!(down.end.position(&mesh).distance(DVec3::new(0.0, 0.5, -0.4)) < 1e-12);
    let back = walk(&mesh, &topology, start, DVec3::new(-0.4, 0.0, 0.0), |_| true);
    assert!(back.end.position(&mesh).distance(DVec3::new(-0.4, 0.5, 0.0)) < 1e-12);
    // Beyond the edge there is nothing in this direction: it is turned down.
    let over = walk(&mesh, &topology, start, DVec3::new(0.4, 0.1, 0.0), |_| true);
    assert!(over.end.position(&mesh).distance(DVec3::new(0.0, 0.6, -0.4)) < 1e-12);
    // Not when the edge may not be crossed.
    let edge = topology.find_edge(VertexId(0), VertexId(1)).unwrap();
    let kept = walk(&mesh, &topology, start, DVec3::new(0.4, 0.1, 0.0), |e| e != edge);
    assert!(kept.end.position(&mesh).distance(DVec3::new(0.0, 0.6, 0.0)) < 1e-12 && kept.stopped);
    assert!(kept.end.face.0 < 2);
}

#[test]
fn great_circles_come_back() {
    let (mesh, topology) = octahedron_sphere(5);
    for weights in [[0.3, 0.3, 0.4], [1.0, 0.0, 0.0], [0.5, 0.5, 0.0]] {
        let start = SurfacePoint::new(FaceId(77), weights.into());
        let p = start.position(&mesh);
        for angle in [0.0f64, 0.7, 2.0, 3.9, 5.5] {
            let [u, v] = <[DVec3; 2]>::from(p.normalize().any_orthonormal_pair());
            let direction = angle.cos() * u + angle.sin() * v;
            let walked = walk(&mesh, &topology, start, std::f64::consts::TAU * direction, |_| true);
            check_valid(&walked);
            // The polyhedron is 0.05 % smaller than the sphere and its facets turn the way a little.
            let back = walked.end.position(&mesh).distance(p);
            assert!(back < 0.05 && !walked.stopped, "{weights:?} {angle}: {back}");
        }
    }
}

#[test]
fn walks_through_vertices_go_straight_on() {
    let (mesh, topology) = flat(6);
    for v in 0..mesh.n_vertices() {
        let p = mesh.position(VertexId(v as u32));
        for from in [DVec3::new(0.5, 0.5, 0.0), DVec3::new(1.0 / 3.0, 0.5, 0.0), DVec3::new(0.4, 0.3, 0.0)] {
            let beyond = p + 0.1 * (p - from);
            if beyond.min_element() < 0.0 || beyond.max_element() > 1.0 {
                continue;
            }
            let walked = walk(&mesh, &topology, at(&mesh, from), beyond - from, |_| true);
            assert!(walked.end.position(&mesh).distance(beyond) < 1e-9, "{from} through {p}: {walked:?}");
        }
    }
}

#[test]
fn not_finite_or_no_displacement_stays() {
    let (mesh, topology) = flat(2);
    let start = SurfacePoint::new(FaceId(3), DVec3::new(0.2, 0.3, 0.5));
    for d in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY, DVec3::Z] {
        let walked = walk(&mesh, &topology, start, d, |_| true);
        assert!(walked.end.position(&mesh).distance(start.position(&mesh)) < 1e-15);
    }
}

#[test]
fn faces_without_area_are_walked_over() {
    // A square in two halves that meet at a cap (2 vertices of the diagonal and its middle) and at a needle.
    let p = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5], [0.25, 0.25]];
    let positions: Vec<_> = p.iter().map(|p: &[f64; 2]| DVec3::new(p[0], p[1], 0.0)).collect();
    let faces = vec![[0, 1, 2], [0, 2, 4], [0, 4, 5], [4, 2, 3], [5, 4, 3], [0, 5, 3]];
    let (mesh, topology) = with_topology(positions, faces);
    for start in [[0.6, 0.3], [0.9, 0.1], [0.5, 0.1]] {
        for end in [[0.2, 0.5], [0.1, 0.9], [0.6, 0.8], [0.05, 0.2]] {
            let [start, end] = [start, end].map(|p: [f64; 2]| DVec3::new(p[0], p[1], 0.0));
            for (p, q) in [(start, end), (end, start)] {
                let walked = walk(&mesh, &topology, at(&mesh, p), q - p, |_| true);
                check_valid(&walked);
                assert!(walked.end.position(&mesh).distance(q) < 1e-9, "{p} to {q}: {walked:?}");
            }
        }
    }
}

/// Meshes with folds, needles, faces without area and edges without length: vertices on a coarse grid.
fn crumpled() -> impl Strategy<Value = (TriMesh, Topology)> {
    let coarse = prop::array::uniform3((-2i8..=2).prop_map(|x| f64::from(x) * 0.5));
    let fine = prop::array::uniform3(-1.0..1.0);
    let point = prop_oneof![coarse, fine].prop_map(DVec3::from_array);
    (prop::collection::vec(point, 66), any::<bool>()).prop_map(|(noise, closed)| {
        let (mesh, topology) = if closed { octahedron_sphere(2) } else { grid(6, |x, y| DVec3::new(2.0 * x, 2.0 * y, 0.0)) };
        let positions = mesh.positions().iter().zip(&noise).map(|(p, n)| *p + 0.5 * *n);
        (mesh.with_positions(positions.collect()).unwrap(), topology)
    })
}

fn weights() -> impl Strategy<Value = DVec3> {
    prop_oneof![
        prop::array::uniform3(0.01..1.0).prop_map(DVec3::from_array),
        prop::array::uniform3(0u8..=1).prop_map(|w| DVec3::from_array(w.map(f64::from))),
    ]
}

proptest! {
    #[test]
    fn no_walk_crosses_a_barrier(
        (mesh, topology) in crumpled(),
        starts in prop::collection::vec((0usize..72, weights(), prop::array::uniform3(-2.0..2.0)), 20),
        barrier in prop::collection::vec(any::<bool>(), 256),
        barriers in 0usize..4,
    ) {
        // Every second, fourth, ... edge, or none.
        let blocked = |e: EdgeId| barriers > 0 && barrier[e.0 as usize % 256] && (e.0 as usize).is_multiple_of(barriers);
        let (region, _): (IdVec<FaceId, u32>, _) = topology.regions(|e| !blocked(e));
        for (face, weights, displacement) in starts {
            let start = SurfacePoint::new(FaceId(face as u32), weights);
            let walked = walk(&mesh, &topology, start, displacement.into(), |e| !blocked(e));
            check_valid(&walked);
            prop_assert_eq!(region[walked.end.face], region[start.face]);
            // Straight on or with less: never further than asked.
            let moved = walked.end.position(&mesh).distance(start.position(&mesh));
            prop_assert!(moved <= DVec3::from_array(displacement).length() + 1e-9);
        }
    }

    #[test]
    fn flat_walks_from_anywhere(
        p in prop::array::uniform2(0u32..=24), q in prop::array::uniform2(0.0..1.0),
    ) {
        // 24 is a multiple of the grid's 6, so many starts are on edges and vertices.
        let (mesh, topology) = flat(6);
        let p = DVec3::new(f64::from(p[0]) / 24.0, f64::from(p[1]) / 24.0, 0.0);
        let q = DVec3::new(q[0], q[1], 0.0);
        let walked = walk(&mesh, &topology, at(&mesh, p), q - p, |_| true);
        prop_assert!(walked.end.position(&mesh).distance(q) < 1e-9);
        prop_assert!(!walked.stopped);
    }
}
