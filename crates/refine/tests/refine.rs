//! The promises of refining: the same surface, the same topology, edges short enough.

use glam::{DQuat, DVec3};
use mesh_core::{Topology, TriMesh, VertexId, clean};
use proptest::prelude::*;
use refine::{RefineOptions, Refined, refine};

fn refined(mesh: &TriMesh, longest: f64, marked: &[[VertexId; 2]]) -> Refined {
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    refine(mesh, &topology, marked, &RefineOptions::new(longest)).unwrap()
}

fn volume(mesh: &TriMesh) -> f64 {
    mesh.faces().ids().map(|f| mesh.triangle(f)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

fn longest_edge(r: &Refined) -> f64 {
    r.topology.edge_ids().map(|e| r.topology.ends(e)).map(|[a, b]| r.mesh.distance(a, b)).fold(0.0, f64::max)
}

/// What holds whatever was refined.
fn check(mesh: &TriMesh, r: &Refined) {
    let before = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    assert_eq!(before.euler(), r.topology.euler());
    assert_eq!(before.border_loops().len(), r.topology.border_loops().len());
    assert_eq!(before.components().1, r.topology.components().1);
    let (area, diagonal) = (mesh.total_area(), mesh.diagonal());
    assert!((r.mesh.total_area() - area).abs() < 1e-6 * area);
    assert!((volume(&r.mesh) - volume(mesh)).abs() < 1e-6 * diagonal.powi(3));
    assert_eq!(r.mesh.n_faces(), r.source_face.len());
    for (v, p) in mesh.positions().enumerate() {
        assert_eq!(r.mesh.position(v), *p);
    }
    for (f, &source) in r.source_face.enumerate() {
        let [a, b, c] = mesh.triangle(source);
        let normal = (b - a).cross(c - a).normalize();
        assert!((r.mesh.centroid(f) - a).dot(normal).abs() < 1e-6 * diagonal, "{f} lies off the plane of {source}");
    }
}

/// A disk of `n` needles from one vertex on its rim.
fn fan(n: usize) -> TriMesh {
    let rim = |i: usize| DQuat::from_rotation_z(i as f64 * std::f64::consts::TAU / n as f64) * DVec3::X;
    TriMesh::new((0..n).map(rim).collect(), (1..n as u32 - 1).map(|i| [0, i, i + 1]).collect()).unwrap()
}

#[test]
fn a_fan_of_needles_in_a_plane_becomes_delaunay() {
    let mesh = fan(200);
    let worst = |m: &TriMesh| m.faces().ids().map(|f| mesh_core::aspect_ratio(m.triangle(f))).sum::<f64>() / m.n_faces() as f64;
    let r = refined(&mesh, 0.1, &[]);
    check(&mesh, &r);
    assert!(longest_edge(&r) <= 0.1);
    assert!(worst(&mesh) < 0.1 && worst(&r.mesh) > 0.6, "{} {}", worst(&mesh), worst(&r.mesh));
}

#[test]
fn creases_and_curved_places_keep_their_edges() {
    let mesh = fixtures::cylinder(1.0, 10.0, 40);
    let r = refined(&mesh, 0.3, &[]);
    check(&mesh, &r);
    // Flips stay inside the caps and inside the flat strips of the side: the area says so, and the dihedral angles of the rim.
    assert!(longest_edge(&r) <= 0.3);
    let sharp = |m: &TriMesh| {
        let t = Topology::new(m.faces(), m.n_vertices()).unwrap();
        let angle = |e| match t.edge_faces(e) {
            (f, Some(g)) => m.normal(f).angle_between(m.normal(g)),
            _ => 0.0,
        };
        let length = |e| t.ends(e).map(|v| m.position(v));
        t.edge_ids().filter(|&e| angle(e) > 1.0).map(|e| length(e)[0].distance(length(e)[1])).sum::<f64>()
    };
    assert!((sharp(&mesh) - sharp(&r.mesh)).abs() < 1e-9);
}

#[test]
fn a_fine_curved_mesh_stays_as_it_is() {
    let mesh = fixtures::icosphere(10);
    let r = refined(&mesh, 1.0, &[]);
    assert_eq!((r.flips, r.splits), (0, 0));
    assert_eq!(r.mesh.faces(), mesh.faces());
}

#[test]
fn marked_edges_stay_and_are_halved() {
    let plane =
        TriMesh::new(vec![DVec3::ZERO, DVec3::X * 4.0, DVec3::new(4.0, 1.0, 0.0), DVec3::Y], vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    let r = refined(&plane, 0.5, &[[VertexId(2), VertexId(0)]]);
    check(&plane, &r);
    let length: f64 = r.marked.iter().map(|&[a, b]| r.mesh.distance(a, b)).sum();
    assert!((length - 17f64.sqrt()).abs() < 1e-9);
    assert!(r.marked.iter().all(|&[a, b]| r.topology.find_edge(a, b).is_some()));
}

#[test]
fn a_fold_that_lies_on_itself_is_no_plane() {
    // Two triangles on each other, joined along one edge, the smaller inside the larger.
    let flap = TriMesh::new(
        vec![DVec3::ZERO, DVec3::X, DVec3::new(0.5, 2.0, 0.0), DVec3::new(0.5, 0.1, 0.0)],
        vec![[0, 1, 2], [1, 0, 3]],
    )
    .unwrap();
    assert_eq!(refined(&flap, f64::INFINITY, &[]).flips, 0);
}

#[test]
fn splitting_ends_at_the_most_faces() {
    let mesh = fixtures::cube(1);
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let options = RefineOptions { most_faces: Some(100), ..RefineOptions::new(1e-6) };
    let r = refine(&mesh, &topology, &[], &options).unwrap();
    check(&mesh, &r);
    assert!((99..=100).contains(&r.mesh.n_faces()));
}

#[test]
fn every_fixture_stays_the_same_surface() {
    for fixture in fixtures::catalogue() {
        let Ok(cleaned) = clean(&fixture.soup, &Default::default()) else { continue };
        let r = refined(&cleaned.mesh, 0.05 * cleaned.mesh.diagonal(), &[]);
        check(&cleaned.mesh, &r);
    }
}

proptest! {
    /// Random points in a plane, triangulated as a fan round a star-shaped polygon: Delaunay where it may be, the same polygon.
    #[test]
    fn star_polygons(radii in prop::collection::vec(0.2f64..1.0, 5..30), longest in 0.1f64..2.0) {
        let n = radii.len();
        let at = |(i, r): (usize, &f64)| *r * (DQuat::from_rotation_z(i as f64 * std::f64::consts::TAU / n as f64) * DVec3::X);
        let positions: Vec<DVec3> = std::iter::once(DVec3::ZERO).chain(radii.iter().enumerate().map(at)).collect();
        let faces = (0..n as u32).map(|i| [0, 1 + i, 1 + (i + 1) % n as u32]).collect();
        let mesh = TriMesh::new(positions, faces).unwrap();
        let r = refined(&mesh, longest, &[]);
        check(&mesh, &r);
        prop_assert!(longest_edge(&r) <= longest);
    }
}

/// A box with a vertex beside one of its corners, on an edge: a short crease, as booleans of CAD
/// programs leave them.
fn box_with_corners_side_by_side(gap: f64) -> TriMesh {
    let point = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    // Bottom 0 to 3, top 4 to 7, and 8 beside 6 on the edge from 6 to 7.
    let square = |z: f64| [point(0.0, 0.0, z), point(1.0, 0.0, z), point(1.0, 1.0, z), point(0.0, 1.0, z)];
    let positions = [square(0.0), square(1.0)].concat().into_iter().chain([point(1.0 - gap, 1.0, 1.0)]).collect();
    let sides = [[0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 8], [2, 8, 6], [3, 7, 8], [3, 0, 4], [3, 4, 7]];
    let ends = [[0, 2, 1], [0, 3, 2], [4, 5, 8], [5, 6, 8], [4, 8, 7]];
    TriMesh::new(positions, sides.into_iter().chain(ends).collect()).unwrap()
}

#[test]
fn a_short_crease_is_contracted_and_the_corner_stays() {
    for (gap, contractions) in [(1e-4, 1), (0.1, 0)] {
        let mesh = box_with_corners_side_by_side(gap);
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let marked = [VertexId(8), VertexId(4)];
        let options = RefineOptions { shortest_edge: 1e-3, ..RefineOptions::new(f64::INFINITY) };
        let r = refine(&mesh, &topology, &[marked], &options).unwrap();
        assert_eq!(r.contractions, contractions);
        assert_eq!(r.mesh.n_vertices(), mesh.n_vertices() - contractions);
        assert_eq!(r.topology.euler(), topology.euler());
        assert!((volume(&r.mesh) - 1.0).abs() < 1e-12, "{}", volume(&r.mesh));
        // The marked edge ends at the corner then.
        let ends = r.marked[0].map(|v| r.mesh.position(v));
        let far = if contractions == 1 { mesh.position(VertexId(6)) } else { mesh.position(VertexId(8)) };
        assert_eq!((r.marked.len(), ends), (1, [mesh.position(VertexId(4)), far]));
    }
}

/// A tetrahedron, however small, has no edge to spare.
#[test]
fn what_would_not_stay_a_manifold_is_left() {
    let mesh = TriMesh::new(
        vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].into_iter().map(|p| 1e-4 * p).collect(),
        vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    )
    .unwrap();
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let options = RefineOptions { shortest_edge: 1.0, ..RefineOptions::new(f64::INFINITY) };
    let r = refine(&mesh, &topology, &[], &options).unwrap();
    assert_eq!((r.contractions, r.mesh.n_faces()), (0, 4));
}

#[test]
fn the_crease_angle_says_which_short_edges_are_creases() {
    // Faces meet at right angles at the short edge: above that angle it is part of no arc, and contracting it would shorten none.
    let mesh = box_with_corners_side_by_side(1e-4);
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let contractions = |crease_angle: f64| {
        let options = RefineOptions { shortest_edge: 1e-3, crease_angle, ..RefineOptions::new(f64::INFINITY) };
        refine(&mesh, &topology, &[], &options).unwrap().contractions
    };
    assert_eq!([40.0, 89.0, 91.0, 180.0].map(contractions), [1, 1, 0, 0]);
}

/// Two boxes that stand on each other, the upper one with a corner in the middle of an edge of the lower one, or beside it by `beside`.
fn box_on_a_box(beside: f64) -> TriMesh {
    let lower = fixtures::cuboid(DVec3::splat(4.0), 1);
    let upper = fixtures::cuboid(DVec3::splat(1.5), 1);
    let [low, high] = [&lower, &upper].map(|m| m.positions().iter().copied().reduce(DVec3::min).unwrap());
    let shift = low + DVec3::new(2.0 + beside, 0.0, 4.0) - high;
    let positions = lower.positions().iter().copied().chain(upper.positions().iter().map(|p| *p + shift)).collect();
    let n = lower.n_vertices() as u32;
    let faces = lower.faces().iter().map(|f| f.map(|v| v.0)).chain(upper.faces().iter().map(|f| f.map(|v| v.0 + n)));
    TriMesh::new(positions, faces.collect()).unwrap()
}

/// What does not touch in the input has no vertices in one place after it, either: whoever welds them would join two parts.
#[test]
fn no_edge_is_split_where_another_vertex_lies() {
    let places = |r: &Refined| r.mesh.positions().iter().map(|&p| mesh_core::place(p)).collect::<std::collections::BTreeSet<_>>();
    for beside in [0.0, 0.25, 1.0] {
        let mesh = box_on_a_box(beside);
        let refined = refined(&mesh, 0.6, &[]);
        check(&mesh, &refined);
        assert_eq!(places(&refined).len(), refined.mesh.n_vertices(), "{beside}");
    }
}

/// Two sheets that touch along an edge still do so at every new vertex there.
#[test]
fn sides_of_one_edge_are_split_in_the_same_places() {
    let corners = [[0., 0., 0.], [4., 0., 0.], [2., 3., 0.], [0., 0., 0.], [4., 0., 0.], [2., 0., 3.]];
    let mesh = TriMesh::new(corners.map(DVec3::from).to_vec(), vec![[0, 1, 2], [4, 3, 5]]).unwrap();
    let refined = refined(&mesh, 0.6, &[]);
    let on_edge = |p: &&DVec3| p.y == 0.0 && p.z == 0.0;
    let mut places: Vec<_> = refined.mesh.positions().iter().filter(on_edge).map(|&p| mesh_core::place(p)).collect();
    let n = places.len();
    places.sort_unstable();
    places.dedup();
    assert!(n >= 14 && 2 * places.len() == n, "{n} {}", places.len());
}
