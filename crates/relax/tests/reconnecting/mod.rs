//! The search for better base edges, on shapes whose best ones are known.

use crate::common::{Bed, Place, frustum, icosahedron, on_sphere, torus_grid, uv_sphere};
use mesh_core::VertexId;
use region_map::BaseEdit;
use relax::{ReconnectOptions, Reconnected, RelaxError, RelaxOptions, reconnect};
use std::f64::consts::TAU;

/// Relaxes the bed, whose domain is subdivided once, and searches.
fn search(bed: &Bed) -> Reconnected {
    let relaxed = bed.relax(&RelaxOptions::default());
    reconnect(&bed.surface(), &bed.domain_topology, &relaxed.map, &ReconnectOptions::default()).unwrap()
}

/// The faces with the edge between `a` and `b` flipped.
fn flipped(faces: &[[u32; 3]], a: u32, b: u32) -> Vec<[u32; 3]> {
    let opposite = |from: u32, to: u32| {
        let third = |f: &&[u32; 3]| (0..3).any(|i| f[i] == from && f[(i + 1) % 3] == to);
        *faces.iter().find(third).unwrap().iter().find(|&&v| v != from && v != to).unwrap()
    };
    let (c, d) = (opposite(a, b), opposite(b, a));
    let others = faces.iter().filter(|f| !(f.contains(&a) && f.contains(&b))).copied();
    others.chain([[a, d, c], [d, b, c]]).collect()
}

#[test]
fn nothing_is_found_where_all_is_regular() {
    let (positions, faces) = icosahedron();
    let found = search(&on_sphere(positions, &faces, 1));
    assert!(found.edits.is_empty() && found.energy[0] == found.energy[1] && found.tries == 30, "{found:?}");
}

#[test]
fn a_bad_flip_of_an_icosahedron_is_undone() {
    let (positions, faces) = icosahedron();
    let regular = search(&on_sphere(positions.clone(), &faces, 1)).energy[0];
    let found = search(&on_sphere(positions, &flipped(&faces, 0, 5), 1));
    // Vertices 1 and 11 are opposite the edge.
    assert_eq!(found.edits, [BaseEdit::Flip([VertexId(1), VertexId(11)])]);
    assert!(found.energy[0] > regular + 1.0 && found.energy[1] < regular + 0.05, "{found:?} {regular}");
}

/// Straight columns of a torus of revolution, five of their diagonals flipped.
#[test]
fn bad_flips_of_a_torus_are_undone() {
    let at = |u: f64, v: f64| {
        let (u, v) = (TAU * u, TAU * v);
        glam::DVec3::new((3.0 + v.cos()) * u.cos(), (3.0 + v.cos()) * u.sin(), v.sin())
    };
    let bed = |bad: &[[u32; 2]]| {
        let (p, f) = torus_grid(60, 24, at);
        let (places, mut faces) = torus_grid(16, 6, |u, v| at(u, v + 3.0 * u));
        for &[a, b] in bad {
            faces = flipped(&faces, a, b);
        }
        let places = places.into_iter().map(Place::Near).collect();
        Bed::on(mesh_core::TriMesh::new(p, f).unwrap()).with_base(places, vec![], faces, 1)
    };
    let good = search(&bed(&[]));
    // Diagonals run from (i, j) to (i + 1, j + 1).
    let bad = search(&bed(&[[0, 7], [20, 27], [32, 39], [50, 57], [74, 81]]));
    assert!(bad.energy[1] < bad.energy[0] - 3.0 && bad.energy[1] < good.energy[1] + 0.5, "{bad:?} {good:?}");
}

#[test]
fn edges_on_arcs_stay() {
    let found = search(&frustum([1.0, 0.3], 2.0, 7, 1));
    // Seven vertices on each rim, in their order.
    let is_on_rim = |[a, b]: [u32; 2]| a.max(b) < 14 && a / 7 == b / 7 && matches!(a.abs_diff(b), 1 | 6);
    assert!(found.energy[1] <= found.energy[0]);
    assert!(found.edits.iter().all(|e| !matches!(e, BaseEdit::Flip(e) if is_on_rim(e.map(|v| v.0)))), "{found:?}");
}

#[test]
fn same_on_one_and_two_threads() {
    let (positions, faces) = icosahedron();
    let faces = flipped(&flipped(&faces, 0, 5), 3, 6);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| search(&on_sphere(positions.clone(), &faces, 1)))
    };
    let one = run(1);
    assert!(!one.edits.is_empty());
    assert_eq!(one, run(2));
}

#[test]
fn a_domain_that_was_not_subdivided_is_refused() {
    let (positions, faces) = icosahedron();
    let bed = Bed::on(uv_sphere(24, 48)).with_base(positions.into_iter().map(Place::Near).collect(), vec![], faces, 0);
    let found = reconnect(&bed.surface(), &bed.domain_topology, &bed.map, &ReconnectOptions::default());
    assert_eq!(found, Err(RelaxError::NotSubdivided));
}
