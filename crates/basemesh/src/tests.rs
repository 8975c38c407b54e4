//! Tests of the stage on shapes with known patches.

mod shapes;

use crate::Replay;
use crate::editor::{Editor, Filling};
use mesh_core::{FaceId, Id as _, VertexId};
use proptest::prelude::*;
use region_map::{BaseEdit, BaseMesh};
use shapes::Shape;

#[test]
fn the_triangulated_sites_are_a_base_mesh() {
    for shape in [Shape::cube(), Shape::box_of_twelve(), Shape::cylinder(), Shape::sphere(), Shape::torus()] {
        for n in [4, 30, 120] {
            shape.check(&shape.base(n, 0));
        }
    }
}

#[test]
fn improvement_keeps_all_promises() {
    for shape in [Shape::cube(), Shape::cylinder(), Shape::sphere(), Shape::torus()] {
        shape.check(&shape.base(80, 10));
    }
}

#[test]
fn many_sites_coarsen_to_the_wanted_number_without_a_fold() {
    for (shape, n) in [(Shape::cube(), 40), (Shape::cylinder(), 40), (Shape::sphere(), 30), (Shape::torus(), 40)] {
        let base = shape.base_from(8 * n, n, 10);
        shape.check(&base);
        assert_eq!(base.mesh().n_vertices(), n);
        let editor = Editor::new(&shape.surface, base);
        assert!(editor.faces().into_iter().all(|f| !crate::improve::is_folded(&editor, f)));
    }
}

#[test]
fn sliding_evens_out_a_rim() {
    let shape = Shape::cylinder();
    let mut editor = Editor::new(&shape.surface, shape.base(60, 0));
    let rim = |editor: &Editor<'_>| -> Vec<f64> {
        editor.edges().into_iter().filter_map(|[a, b]| editor.span(a, b)).map(|s| (s.to - s.from).abs()).collect()
    };
    // Halving one edge of the rim twice leaves gaps of a quarter beside whole ones.
    let [a, b] = editor.edges().into_iter().find(|&[a, b]| editor.span(a, b).is_some()).unwrap();
    let m = editor.split(a, b).unwrap();
    editor.split(a, m).unwrap();
    let spread = |gaps: &[f64]| gaps.iter().fold(0.0f64, |m, g| m.max(*g)) / gaps.iter().fold(f64::INFINITY, |m, g| m.min(*g));
    let before = rim(&editor);
    for _ in 0..10 {
        editor.vertices().into_iter().for_each(|v| _ = editor.slide_vertex(v));
    }
    let after = rim(&editor);
    assert!(spread(&before) > 3.5 && spread(&after) < 2.5, "{} {}", spread(&before), spread(&after));
    assert!((before.iter().sum::<f64>() - after.iter().sum::<f64>()).abs() < 1e-9);
    shape.check(&editor.finish().unwrap());
}

#[test]
fn a_box_of_twelve_triangles_needs_eight_vertices() {
    let shape = Shape::box_of_twelve();
    let base = shape.base(4, 0);
    assert_eq!((base.mesh().n_vertices(), base.mesh().n_faces()), (8, 12));
}

fn take_away(editor: &mut Editor<'_>, v: VertexId, filling: Filling<'_>) -> bool {
    let hole = editor.hole(v);
    let removal = hole.as_ref().and_then(|hole| editor.removal(hole, filling));
    removal.is_some_and(|removal| editor.take_away(&removal))
}

#[test]
fn the_cheapest_filling_is_for_small_stars() {
    let shape = Shape::sphere();
    let mut editor = Editor::new(&shape.surface, shape.base(40, 0));
    let v = editor.vertices()[0];
    // Halving the edges across from a vertex in turn gives it ever more neighbours.
    let star = |editor: &Editor<'_>| editor.faces().into_iter().filter(|f| f.contains(&v)).collect::<Vec<_>>();
    while star(&editor).len() <= 40 {
        for face in star(&editor) {
            let [a, b] = [1, 2].map(|k| face[(face.iter().position(|&w| w == v).unwrap() + k) % 3]);
            editor.split(a, b).unwrap();
        }
    }
    assert!(!take_away(&mut editor, v, Filling::Cheapest));
    shape.check(&editor.finish().unwrap());
}

/// Makes edits that bytes choose: which edge, and what to do with it.
fn edit(shape: &Shape, base: BaseMesh, choices: &[(u16, u8)]) -> (BaseMesh, usize) {
    let mut editor = Editor::new(&shape.surface, base);
    let mut done = 0;
    for &(edge, what) in choices {
        let edges = editor.edges();
        let [a, b] = edges[edge as usize % edges.len()];
        done += usize::from(match what % 7 {
            0 => editor.flip(a, b),
            1 => editor.split(a, b).is_some(),
            2 => take_away(&mut editor, a, Filling::Fan(b)),
            3 => take_away(&mut editor, a, Filling::Cheapest),
            4 => editor.faces_beside(a, b)[0].is_some_and(|(f, _)| editor.split_face(f.vertices).is_some()),
            5 => editor.slide_vertex(a),
            _ => editor.relax_vertex(a),
        });
        assert_eq!(editor.n_vertices(), editor.vertices().len());
    }
    (editor.finish().unwrap(), done)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn random_edits_keep_the_round_trip(which in 0..4usize, choices in prop::collection::vec((any::<u16>(), any::<u8>()), 1..60)) {
        let shape = [Shape::cube, Shape::cylinder, Shape::sphere, Shape::torus][which]();
        let (base, _) = edit(&shape, shape.base(40, 0), &choices);
        shape.check(&base);
    }
}

/// Any edits, taken back, leave what was there to the last bit; and closing gaps changes nothing.
#[test]
fn a_state_can_be_restored() {
    for shape in [Shape::cube(), Shape::cylinder(), Shape::torus()] {
        let first: Vec<(u16, u8)> = (0..60u16).map(|i| (i.wrapping_mul(7919), i as u8)).collect();
        let (base, _) = edit(&shape, shape.base(60, 0), &first);
        let mut editor = Editor::new(&shape.surface, base.clone());
        let edges = editor.edges();
        let lengths = editor.with_lengths(edges.clone());
        let state = editor.checkpoint();
        editor.close_gaps();
        for (i, &[a, b]) in edges.iter().enumerate() {
            _ = if i % 2 == 0 { editor.flip(a, b) } else { take_away(&mut editor, a, Filling::Cheapest) };
            _ = editor.is_edge(a, b) && editor.split(a, b).is_some();
            editor.close_gaps();
        }
        assert_ne!(editor.edges(), edges);
        editor.restore(state);
        assert_eq!(editor.with_lengths(editor.edges()), lengths);
        let restored = editor.finish().unwrap();
        let same = Editor::new(&shape.surface, base).finish().unwrap();
        assert_eq!((restored.mesh(), restored.map.n_edits()), (same.mesh(), same.map.n_edits()));
        assert_eq!(restored.domain.region.points, same.domain.region.points);
        assert_eq!(restored.map_faces, same.map_faces);
        shape.check(&restored);
    }
}

#[test]
fn most_edits_of_a_sphere_are_possible() {
    let shape = Shape::sphere();
    let choices: Vec<(u16, u8)> = (0..100u16).map(|i| (i.wrapping_mul(7919), i as u8)).collect();
    let (base, done) = edit(&shape, shape.base(60, 0), &choices);
    assert!(done > 60, "only {done} of 100 edits were made");
    shape.check(&base);
}

/// A replay does what the editor does, removals with the triangles that are given; and keeps the map.
#[test]
fn edits_chosen_elsewhere_are_replayed() {
    for shape in [Shape::cylinder(), Shape::sphere(), Shape::torus()] {
        let base = shape.base(60, 10);
        let mut replay = Replay::new(&shape.surface, base.clone()).unwrap();
        let mut editor = Editor::new(&shape.surface, base.clone());
        let (mut flips, mut removals) = (0, 0);
        for [a, b] in editor.edges().into_iter().step_by(7) {
            let flip = editor.is_edge(a, b) && editor.flip(a, b);
            assert_eq!(replay.edit(&BaseEdit::Flip([a, b])), flip);
            flips += usize::from(flip);
        }
        for v in editor.vertices().into_iter().step_by(9) {
            let old = editor.faces();
            if take_away(&mut editor, v, Filling::Cheapest) {
                let filling = editor.faces().into_iter().filter(|f| !old.contains(f)).collect();
                assert!(replay.edit(&BaseEdit::Remove { vertex: v, filling }));
                removals += 1;
            }
        }
        let [a, b] = editor.edges()[11];
        assert!(editor.split(a, b).is_some() && replay.edit(&BaseEdit::Split([a, b])));
        assert!(flips > 3 && removals > 2, "{flips} {removals}");
        let replayed = replay.finish().unwrap();
        shape.check(&replayed);
        assert_eq!(*replayed.mesh(), editor.finish().unwrap().domain.mesh);
    }
}

#[test]
fn edits_that_do_not_fit_are_refused() {
    let shape = Shape::cylinder();
    let base = shape.base(60, 10);
    let on_arc = *base.domain.region.spans.keys().next().unwrap();
    let mut replay = Replay::new(&shape.surface, base.clone()).unwrap();
    assert!(!replay.edit(&BaseEdit::Flip(on_arc)));
    assert!(!replay.edit(&BaseEdit::Remove { vertex: on_arc[0], filling: vec![] }));
    let unchanged = replay.finish().unwrap();
    assert_eq!((unchanged.mesh(), unchanged.map.n_edits()), (base.mesh(), base.map.n_edits()));
}

#[test]
fn no_base_triangle_has_a_straight_corner() {
    // A cap inside three segments of its rim would be one triangle with three flat corners.
    let shape = Shape::cylinder();
    let base = shape.base(8, 10);
    shape.check(&base);
    let editor = Editor::new(&shape.surface, base);
    assert!(editor.faces().into_iter().all(|f| !crate::improve::has_straight_corner(&editor, f)));
}

/// The arc goes round: its vertices slide out of any bend, and the two edges of an ear become one line.
#[test]
fn the_ears_of_a_polygon_have_straight_corners() {
    let corner = |i: u32| glam::DVec2::from_angle(f64::from(i) * std::f64::consts::FRAC_PI_3).extend(0.0);
    let mesh = mesh_core::TriMesh::new((0..6).map(corner).collect(), (1..5).map(|i| [0, i, i + 1]).collect()).unwrap();
    let surface = region_map::Surface::with_creases(mesh, 40.0).unwrap();
    let editor = Editor::new(&surface, crate::decimate::identity(&surface).unwrap());
    let straight: Vec<bool> = editor.faces().into_iter().map(|f| crate::improve::has_straight_corner(&editor, f)).collect();
    assert_eq!(straight, [true, false, false, true]);
}

/// Two arcs leave a corner 30 degrees apart. A sheet that goes from one to the other over a peak opens by far more than a flat one.
#[test]
fn a_corner_opens_as_far_as_the_surface_does() {
    let ray = |degrees: f64, height: f64| glam::DVec2::from_angle(degrees.to_radians()).extend(height);
    let is_straight = |height: f64| {
        let ring = [ray(0.0, 0.0), ray(10.0, height), ray(20.0, height), ray(30.0, 0.0)];
        let positions = std::iter::once(glam::DVec3::ZERO).chain(ring).collect();
        let mesh = mesh_core::TriMesh::new(positions, (1..4).map(|i| [0, i, i + 1]).collect()).unwrap();
        let smooth = region_map::Surface::smooth(mesh).unwrap();
        let topology = smooth.topology();
        let kinds = topology.edge_ids().map(|e| topology.is_border_edge(e).then_some(region_map::ArcKind::Border)).collect();
        let network = region_map::Network::trace(smooth.mesh(), topology, &kinds, |_| true, Vec::new()).unwrap();
        let surface = smooth.with_network(network).unwrap();
        let editor = Editor::new(&surface, crate::decimate::identity(&surface).unwrap());
        crate::improve::has_straight_corner(&editor, [0, 1, 4].map(VertexId))
    };
    assert_eq!([0.0, 0.2, 8.0].map(is_straight), [false, false, true]);
}

#[test]
fn bisections_keep_all_promises_and_places() {
    for shape in [Shape::cube(), Shape::cylinder(), Shape::sphere(), Shape::torus()] {
        let base = shape.base(40, 10);
        let n = base.mesh().n_vertices();
        let [a, b, c] = base.mesh().faces()[FaceId(0)];
        // The second edge is a half of the first.
        let edges = [[a, b], [a, VertexId::new(n)], [b, c]];
        let bisected = crate::bisect(&shape.surface, base.clone(), &edges).unwrap();
        shape.check(&bisected);
        assert_eq!(bisected.mesh().n_vertices(), n + 3);
        assert!(base.mesh().positions().enumerate().all(|(v, p)| bisected.mesh().position(v) == *p));
        let gone = crate::bisect(&shape.surface, base, &[[a, b], [a, b]]);
        assert!(gone.is_err(), "an edge is bisected once");
    }
}
