//! The search for better base meshes, on shapes whose best ones are known.

#[path = "../../relax/tests/common/mod.rs"]
mod common;

use common::{Bed, Place, frustum, icosahedron, on_sphere, torus_grid, uv_sphere};
use glam::DVec3;
use mesh_core::{IdVec, Topology, TriMesh, VertexId};
use reconnect::{ReconnectError, ReconnectOptions, Reconnected, reconnect};
use region_map::{BaseEdit, Sizing};
use relax::RelaxOptions;
use std::f64::consts::TAU;

type Faces = Vec<[u32; 3]>;

/// Relaxes the bed, whose domain is subdivided once, and searches. `faces` are those of the base; the edits must fit them.
fn search(bed: &Bed, faces: &[[u32; 3]], sizing: &Sizing) -> Reconnected {
    let relaxed = bed.relax(&RelaxOptions::default());
    let (mut now, mut n) = (faces.to_vec(), faces.iter().flatten().max().unwrap() + 1);
    let options = ReconnectOptions::default();
    let found = reconnect(&bed.surface, &relaxed.domain, sizing, &options, |edit| {
        match edit {
            BaseEdit::Flip([a, b]) => now = flipped(&now, a.0, b.0),
            BaseEdit::Split([a, b]) => (now, n) = (split(&now, a.0, b.0, n), n + 1),
            BaseEdit::Remove { vertex, filling } => {
                let star = now.iter().filter(|f| f.contains(&vertex.0)).count();
                assert_eq!(filling.len(), star - 2, "inside a sheet");
                now.retain(|f| !f.contains(&vertex.0));
                now.extend(filling.iter().map(|f| f.map(|v| v.0)));
            }
        }
        let ids: IdVec<_, _> = now.iter().map(|f| f.map(VertexId)).collect();
        Topology::new(&ids, n as usize).expect("edits that fit");
        true
    });
    let found = found.unwrap();
    assert!(found.energy_at_end <= found.energy_at_start);
    found
}

fn search_all(bed: &Bed, faces: &[[u32; 3]]) -> Reconnected {
    search(bed, faces, &Sizing::uniform(bed.surface.mesh()))
}

fn opposite(faces: &[[u32; 3]], from: u32, to: u32) -> u32 {
    let has_side = |f: &&[u32; 3]| (0..3).any(|i| f[i] == from && f[(i + 1) % 3] == to);
    *faces.iter().find(has_side).unwrap().iter().find(|&&v| v != from && v != to).unwrap()
}

fn flipped(faces: &[[u32; 3]], a: u32, b: u32) -> Faces {
    let (c, d) = (opposite(faces, a, b), opposite(faces, b, a));
    let others = faces.iter().filter(|f| !(f.contains(&a) && f.contains(&b))).copied();
    others.chain([[a, d, c], [d, b, c]]).collect()
}

fn split(faces: &[[u32; 3]], a: u32, b: u32, m: u32) -> Faces {
    let (c, d) = (opposite(faces, a, b), opposite(faces, b, a));
    let others = faces.iter().filter(|f| !(f.contains(&a) && f.contains(&b))).copied();
    others.chain([[a, m, c], [m, b, c], [b, m, d], [m, a, d]]).collect()
}

/// An icosahedron, subdivided once: 42 vertices on a sphere, of valence 5 and, from 12 on, 6.
fn sphere_base() -> (Vec<DVec3>, Faces) {
    let (mut positions, faces) = icosahedron();
    let mut middles: Vec<[u32; 2]> = Vec::new();
    let mut middle = |a: u32, b: u32| {
        let ends = [a.min(b), a.max(b)];
        let at = middles.iter().position(|m| *m == ends).unwrap_or_else(|| {
            positions.push((positions[a as usize] + positions[b as usize]).normalize());
            middles.push(ends);
            middles.len() - 1
        });
        12 + at as u32
    };
    let mut parts = Vec::new();
    for [a, b, c] in faces {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        parts.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]]);
    }
    (positions, parts)
}

#[test]
fn nothing_is_found_where_all_is_regular() {
    let (positions, faces) = icosahedron();
    let found = search_all(&on_sphere(positions, &faces, 1), &faces);
    assert!(found.edits.is_empty() && found.energy_at_start == found.energy_at_end, "{found:?}");
}

#[test]
fn a_bad_flip_of_an_icosahedron_is_undone() {
    let (positions, faces) = icosahedron();
    let regular = search_all(&on_sphere(positions.clone(), &faces, 1), &faces).energy_at_start;
    let faces = flipped(&faces, 0, 5);
    let found = search_all(&on_sphere(positions, &faces, 1), &faces);
    // Vertices 1 and 11 are opposite the edge.
    assert_eq!(found.edits, [BaseEdit::Flip([VertexId(1), VertexId(11)])]);
    assert!(found.energy_at_start > regular + 1.0 && found.energy_at_end < regular + 0.05, "{found:?} {regular}");
}

#[test]
fn bad_flips_all_over_a_sphere_are_undone() {
    let (positions, good) = sphere_base();
    let bad = [0, 24, 48].iter().fold(good.clone(), |f, &i| flipped(&f, good[i][0], good[i][1]));
    let good = search_all(&on_sphere(positions.clone(), &good, 1), &good);
    let bad = search_all(&on_sphere(positions, &bad, 1), &bad);
    assert!(good.edits.is_empty(), "{good:?}");
    assert!(bad.energy_at_start > good.energy_at_end + 5.0 && bad.energy_at_end < good.energy_at_end + 1.0, "{bad:?} {good:?}");
}

/// A thick torus whose base, a grid, has as many vertices round its hole as outside, where it is four times as long.
fn thick_torus() -> (Bed, Faces) {
    let at = |u: f64, v: f64| {
        let (u, v) = (TAU * u, TAU * v);
        DVec3::new((2.0 + 1.2 * v.cos()) * u.cos(), (2.0 + 1.2 * v.cos()) * u.sin(), 1.2 * v.sin())
    };
    let ((p, f), (places, faces)) = (torus_grid(36, 24, at), torus_grid(14, 7, at));
    let places = places.into_iter().map(Place::Near).collect();
    (Bed::on(TriMesh::new(p, f).unwrap()).with_base(places, vec![], faces.clone(), 1), faces)
}

/// Some vertices change places; but not where the sizing field holds them all.
#[test]
fn vertices_in_the_wrong_place_are_exchanged() {
    let (bed, faces) = thick_torus();
    let found = search_all(&bed, &faces);
    let count = |is: fn(&BaseEdit) -> bool| found.edits.iter().filter(|e| is(e)).count();
    let removals = count(|e| matches!(e, BaseEdit::Remove { .. }));
    assert!(removals > 0 && removals == count(|e| matches!(e, BaseEdit::Split(_))), "{found:?}");
    let held = search(&bed, &faces, &Sizing { relative: bed.surface.mesh().positions().ids().map(|_| 0.5).collect() });
    assert!(held.edits.iter().all(|e| matches!(e, BaseEdit::Flip(_))), "{held:?}");
    assert!(found.energy_at_end < held.energy_at_end - 1.0, "{found:?} {held:?}");
}

/// Edges inside the sheets of a cone are flipped, those on its rims are not. (That each of these is refused is tested in `flip`.)
#[test]
fn edges_on_arcs_are_not_flipped() {
    let bed = frustum([1.0, 0.3], 2.0, 7, 1);
    let relaxed = bed.relax(&RelaxOptions::default());
    // Seven vertices on each rim, in their order.
    let is_on_rim = |[a, b]: [u32; 2]| a.max(b) < 14 && a / 7 == b / 7 && matches!(a.abs_diff(b), 1 | 6);
    let sizing = Sizing::uniform(bed.surface.mesh());
    let mut flips = 0;
    let found = reconnect(&bed.surface, &relaxed.domain, &sizing, &ReconnectOptions::default(), |edit| {
        let BaseEdit::Flip(edge) = edit else { return false };
        assert!(!is_on_rim(edge.map(|v| v.0)), "{edit:?}");
        flips += 1;
        true
    });
    let found = found.unwrap();
    assert!(flips >= 3 && found.edits.len() == flips, "{found:?}");
    assert!(found.energy_at_end < 0.9 * found.energy_at_start, "{found:?}");
}

/// What the base mesh refuses is not done.
#[test]
fn refused_edits_change_nothing() {
    let (positions, faces) = icosahedron();
    let faces = flipped(&faces, 0, 5);
    let bed = on_sphere(positions, &faces, 1);
    let sizing = Sizing::uniform(bed.surface.mesh());
    let found = reconnect(&bed.surface, &bed.domain, &sizing, &ReconnectOptions::default(), |_| false);
    let found = found.unwrap();
    assert!(found.edits.is_empty() && found.energy_at_start == found.energy_at_end, "{found:?}");
}

#[test]
fn the_search_is_the_same_on_one_and_two_threads() {
    let (bed, faces) = thick_torus();
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| search_all(&bed, &faces))
    };
    let one = run(1);
    assert!(!one.edits.is_empty());
    assert_eq!(one, run(2));
}

#[test]
fn a_domain_that_was_not_subdivided_is_refused() {
    let (positions, faces) = icosahedron();
    let bed = Bed::on(uv_sphere(24, 48)).with_base(positions.into_iter().map(Place::Near).collect(), vec![], faces, 0);
    let sizing = Sizing::uniform(bed.surface.mesh());
    let found = reconnect(&bed.surface, &bed.domain, &sizing, &ReconnectOptions::default(), |_| true);
    assert_eq!(found, Err(ReconnectError::NotSubdivided));
}
