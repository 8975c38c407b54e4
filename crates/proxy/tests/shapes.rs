//! Proxies of shapes whose topology, size and creases are known, and domains brought back from them.

use glam::DVec3;
use mesh_core::{SurfaceIndex, TriMesh, VertexId};
use proxy::{Proxy, ProxyError, ProxyOptions};
use region_map::{Attachment, Domain, Sizing, Surface};

/// The proxy of a mesh, with what every proxy promises checked.
fn proxy(mesh: TriMesh, options: &ProxyOptions) -> (Surface, Proxy) {
    let dense = Surface::with_creases(mesh, 40.0).unwrap();
    let proxy = Proxy::new(&dense, &Sizing::uniform(dense.mesh()), options).unwrap();
    let small = &proxy.surface;
    let topology = |s: &Surface| (s.topology().components().1, s.topology().euler(), s.topology().border_loops().len());
    assert_eq!(topology(small), topology(&dense));
    let (new, old) = (small.network(), dense.network());
    assert_eq!((new.corners.len(), new.arcs.len(), new.n_sheets), (old.corners.len(), old.arcs.len(), old.n_sheets));
    for (v, &there) in proxy.vertices.enumerate() {
        assert_eq!(small.mesh().position(v), dense.mesh().position(there));
    }
    for (arc, there) in new.arcs.iter().zip(&old.arcs) {
        assert_eq!((arc.kind, arc.corners, arc.sheets), (there.kind, there.corners, there.sheets));
    }
    let carried = proxy.carried(&Domain::identity(small), &dense).unwrap();
    carried.check(old).unwrap();
    assert!(carried.mesh.positions().iter().zip(small.mesh().positions()).all(|(a, b)| a.distance(*b) < 1e-9));
    (dense, proxy)
}

fn options(faces: usize) -> ProxyOptions {
    ProxyOptions { faces, longest_edge: f64::INFINITY, distance: f64::INFINITY }
}

/// How far the vertices of a mesh are from its proxy at most.
fn farthest(dense: &Surface, proxy: &Proxy) -> f64 {
    let index = SurfaceIndex::new(proxy.surface.mesh());
    dense.mesh().positions().iter().map(|&p| index.closest(p).unwrap().distance).fold(0.0, f64::max)
}

#[test]
fn a_sphere_becomes_as_small_as_wanted_and_stays_round() {
    for (faces, most) in [(2000, 0.015), (500, 0.04), (100, 0.2)] {
        let (dense, proxy) = proxy(fixtures::icosphere(20), &options(faces));
        assert!(proxy.surface.mesh().n_faces() <= faces && proxy.surface.mesh().n_faces() > faces - 3);
        let far = farthest(&dense, &proxy);
        assert!(far < most, "{far} at {faces}");
    }
}

#[test]
fn a_cube_keeps_its_edges_and_sides() {
    let (dense, proxy) = proxy(fixtures::cube(24), &options(60));
    assert!(proxy.surface.mesh().n_faces() <= 60);
    assert!(farthest(&dense, &proxy) < 1e-12);
}

#[test]
fn rims_keep_their_loops() {
    let (_, proxy) = proxy(fixtures::cylinder(1.0, 2.0, 96), &options(40));
    let arcs = &proxy.surface.network().arcs;
    assert!(arcs.iter().all(|arc| arc.is_loop() && arc.halfedges.len() >= 3 && arc.length() > 5.0));
}

#[test]
fn handles_and_parts_stay() {
    proxy(fixtures::torus(1.0, 0.3, 64, 32), &options(200));
    proxy(fixtures::crumbs(), &options(1));
    proxy(fixtures::plane(), &options(1));
}

#[test]
fn bounds_are_kept() {
    let long = ProxyOptions { longest_edge: 0.3, ..options(1) };
    let (_, proxied) = proxy(fixtures::cube(24), &long);
    let mesh = proxied.surface.mesh();
    let edges = mesh.faces().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    assert!(edges.map(|[a, b]| mesh.distance(a, b)).fold(0.0, f64::max) <= 0.3 + 1e-12);
    let near = ProxyOptions { distance: 0.01, ..options(1) };
    let (dense, proxied) = proxy(fixtures::icosphere(20), &near);
    assert!(proxied.surface.mesh().n_faces() > 100 && farthest(&dense, &proxied) < 0.03);
}

/// Vertices halfway along the edges of the proxy come to lie on the dense sphere, and on the dense rims.
#[test]
fn what_is_carried_lies_on_the_dense_surface() {
    for mesh in [fixtures::icosphere(20), fixtures::cylinder(1.0, 2.0, 96)] {
        let (dense, proxy) = proxy(mesh, &options(200));
        let finest = subdiv_once(&proxy);
        let carried = proxy.carried(&finest, &dense).unwrap();
        carried.check(dense.network()).unwrap();
        for v in carried.region.vertices() {
            let p = carried.mesh.position(v);
            assert!(dense.index().closest(p).unwrap().distance < 1e-12);
            if let Attachment::Arc { arc, t } = carried.region.attachments[v] {
                assert!(dense.network().arcs[arc].position(dense.mesh(), t).distance(p) < 1e-12);
            }
        }
    }
}

/// A sheet rolled up so tightly that chords of the proxy lie nearer to the next turn, which faces the same way, than to their own.
#[test]
fn what_is_carried_stays_in_its_turn_of_a_roll() {
    const A_TURN: u32 = 96;
    const ROWS: u32 = 7;
    let n = 5 * A_TURN / 2;
    let at = |(i, row): (u32, u32)| {
        let turns = f64::from(i) / f64::from(A_TURN);
        let (sin, cos) = (turns * std::f64::consts::TAU).sin_cos();
        ((1.0 + 0.02 * turns) * DVec3::new(cos, sin, 0.0)) + 0.05 * f64::from(row) * DVec3::Z
    };
    let positions = (0..=n).flat_map(|i| (0..ROWS).map(move |row| (i, row))).map(at).collect();
    let quad = |(i, row): (u32, u32)| {
        let [a, b] = [i * ROWS + row, (i + 1) * ROWS + row];
        [[a, b, b + 1], [a, b + 1, a + 1]]
    };
    let faces = (0..n).flat_map(|i| (0..ROWS - 1).map(move |row| (i, row))).flat_map(quad).collect();
    let (dense, proxy) = proxy(TriMesh::new(positions, faces).unwrap(), &options(60));
    let finest = subdiv_once(&proxy);
    let carried = proxy.carried(&finest, &dense).unwrap();
    let along = |corners: [VertexId; 3]| corners.map(|v| v.0 / ROWS);
    for v in carried.region.vertices() {
        let wanted = along(proxy.surface.mesh().face(finest.region.points[v].face).map(|v| proxy.vertices[v]));
        let found = along(dense.mesh().face(carried.region.points[v].face))[0];
        let (least, most) = (wanted.into_iter().min().unwrap(), wanted.into_iter().max().unwrap());
        assert!(found + A_TURN / 4 > least && found < most + A_TURN / 4, "vertex {v}: {found} is not in {least}..{most}");
    }
}

fn subdiv_once(proxy: &Proxy) -> Domain {
    let surface = &proxy.surface;
    let subdivided = subdiv::subdivide(&Domain::identity(surface), 1).unwrap().domain;
    project::project(surface, &subdivided, None, &Default::default()).unwrap().domain
}

#[test]
fn another_surface_is_refused() {
    let (dense, proxied) = proxy(fixtures::cube(6), &options(60));
    let other = Surface::with_creases(fixtures::cube(7), 40.0).unwrap();
    let domain = Domain::identity(&proxied.surface);
    assert!(matches!(proxied.carried(&domain, &other), Err(ProxyError::NotOfSurface)));
    assert!(proxied.carried(&Domain::identity(&other), &dense).is_err());
    let sizing = Sizing::uniform(other.mesh());
    assert!(matches!(Proxy::new(&dense, &sizing, &options(60)), Err(ProxyError::NotOfSurface)));
    let none = ProxyOptions { faces: 0, ..options(1) };
    assert!(matches!(Proxy::new(&dense, &Sizing::uniform(dense.mesh()), &none), Err(ProxyError::Option { name: "faces", .. })));
}
