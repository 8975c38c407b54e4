//! Relaxation on shapes whose answers are known. `Bed::relax` checks what always holds.

mod common;

use common::{Bed, OCTAHEDRON, bytes, cube, frustum, icosahedron, octahedron, on_sphere, torus};
use mesh_core::{FaceId, IdVec, VertexId};
use region_map::{Attachment, SheetId};
use relax::{QuadricOptions, RelaxError, RelaxOptions, Relaxed, ShapeOptions, Weights, relax_around};

fn icosphere(levels: usize) -> Bed {
    let (positions, faces) = icosahedron();
    on_sphere(positions, &faces, levels)
}

/// One of every kind: closed, with corners and arcs, with loops.
fn beds() -> [(&'static str, Bed); 6] {
    [
        ("icosahedron", icosphere(3)),
        ("octahedron", on_sphere(octahedron(), &OCTAHEDRON, 3)),
        ("torus", torus(2)),
        ("cube", cube(7, 3)),
        ("cylinder", frustum([1.0, 1.0], 1.5, 6, 3)),
        ("cone", frustum([1.0, 0.3], 1.5, 6, 3)),
    ]
}

fn only_quadric(quadric: QuadricOptions) -> RelaxOptions {
    RelaxOptions { quadric, ..only_shape(ShapeOptions { untangling_steps: 0, steps: 0, ..Default::default() }) }
}

fn only_shape(shape: ShapeOptions) -> RelaxOptions {
    RelaxOptions { quadric: QuadricOptions { iterations: 0, ..Default::default() }, shape }
}

/// Variance of the areas over their squared mean.
fn area_spread(relaxed: &Relaxed) -> f64 {
    let areas = relaxed.domain.mesh.areas().into_vec();
    let mean = areas.iter().sum::<f64>() / areas.len() as f64;
    areas.iter().map(|a| (a - mean).powi(2)).sum::<f64>() / areas.len() as f64 / (mean * mean)
}

#[test]
fn icosahedron_and_octahedron_reach_what_their_valences_allow() {
    let ico = icosphere(4).relax(&RelaxOptions::default()).report;
    assert!(ico.start.ar_mean < 0.94 && ico.end.ar_mean > 0.99 && ico.end.ar_min > 0.87, "{ico:?}");
    let octa = on_sphere(octahedron(), &OCTAHEDRON, 4).relax(&RelaxOptions::default()).report;
    // At a vertex of valence 4 the triangles are right-angled: AR .717.
    assert!(octa.end.ar_mean > 0.97 && octa.end.ar_min > 0.70, "{octa:?}");
}

/// The result does not depend on the start: jitter of several edge lengths, with up to three quarters of all triangles
/// inverted, is undone.
#[test]
fn folded_starts_are_untangled() {
    for (name, bed) in beds() {
        let calm = bed.relax(&RelaxOptions::default()).report;
        for (share, seed) in [(0.8, 1), (3.0, 2), (3.0, 3)] {
            let report = bed.clone().jitter(share, seed).relax(&only_shape(ShapeOptions::default())).report;
            assert!(report.start.inverted > 0, "{name}: the start is folded");
            assert_eq!(report.end.inverted, 0, "{name} {share} {seed}: {report:?}");
            assert!((report.end.ar_mean - calm.end.ar_mean).abs() < 0.01, "{name} {share} {seed}: {report:?} {calm:?}");
        }
    }
}

/// With nothing else on, the few folds of a light jitter are mended vertex by vertex.
#[test]
fn the_last_folds_are_mended() {
    let off = only_shape(ShapeOptions { untangling_steps: 0, steps: 0, ..Default::default() });
    for (name, bed) in [("sphere", icosphere(4)), ("cylinder", frustum([1.0, 1.0], 1.5, 6, 4))] {
        let report = bed.jitter(0.55, 11).relax(&off).report;
        assert!((1..50).contains(&report.start.inverted), "{name}: {report:?}");
        assert_eq!((report.end.inverted, report.shape_steps), (0, 0), "{name}: {report:?}");
    }
}

#[test]
fn the_paper_s_relaxation_alone_improves_and_never_turns_over() {
    for (name, bed) in beds() {
        let bed = bed.jitter(0.2, 5);
        for weights in [Weights::Uniform, Weights::Adaptive] {
            let relaxed = bed.relax(&only_quadric(QuadricOptions { iterations: 20, weights, ..Default::default() }));
            let report = relaxed.report;
            assert!(report.end.ar_mean > report.start.ar_mean, "{name} {weights:?}: {report:?}");
            assert_eq!((report.end.inverted, report.shape_steps), (0, 0), "{name} {weights:?}");
        }
    }
}

/// Section 4.3.2 promises better shapes around irregular vertices. What we measure is other: the areas become more even, and the
/// mean AR is lower than with uniform weights (see `Weights`).
#[test]
fn adaptive_weights_even_the_areas_around_irregular_vertices() {
    let bed = on_sphere(octahedron(), &OCTAHEDRON, 4);
    let spread =
        |weights| area_spread(&bed.relax(&only_quadric(QuadricOptions { iterations: 40, weights, ..Default::default() })));
    assert!(spread(Weights::Adaptive) < 0.96 * spread(Weights::Uniform));
}

#[test]
fn stops_at_the_target_quality() {
    let options = only_quadric(QuadricOptions { iterations: 50, target_quality: 0.95, ..Default::default() });
    let report = icosphere(3).relax(&options).report;
    assert!(report.end.ar_mean >= 0.95 && report.quadric_iterations < 10, "{report:?}");
}

#[test]
fn the_size_term_evens_the_areas() {
    let bed = on_sphere(octahedron(), &OCTAHEDRON, 3);
    let spread = |size_weight| area_spread(&bed.relax(&only_shape(ShapeOptions { size_weight, ..Default::default() })));
    assert!(spread(0.0) > 1.5 * spread(1.0));
}

#[test]
fn same_bytes_on_one_and_two_threads() {
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let beds = [icosphere(4), cube(7, 3), frustum([1.0, 0.3], 1.5, 6, 3)];
            beds.map(|bed| bytes(&bed.jitter(2.0, 7).relax(&RelaxOptions::default())))
        })
    };
    assert!(run(1) == run(2));
}

#[test]
fn maps_that_do_not_fit_are_refused() {
    let options = RelaxOptions::default();
    let mut bed = cube(4, 1);
    bed.domain.region.points = IdVec::new();
    assert!(matches!(bed.try_relax(&options), Err(RelaxError::Region(_))));

    let mut bed = cube(4, 2);
    let inside =
        bed.domain.region.vertices().find(|&v| matches!(bed.domain.region.attachments[v], Attachment::Sheet(_))).unwrap();
    let other = bed
        .surface
        .network()
        .sheet_of_face
        .ids()
        .find(|&f| Attachment::Sheet(bed.surface.network().sheet_of_face[f]) != bed.domain.region.attachments[inside]);
    bed.domain.region.points[inside].face = other.unwrap();
    assert_eq!(bed.try_relax(&options).unwrap_err(), RelaxError::OtherSheet(inside));

    let mut bed = cube(4, 2);
    let sliding =
        bed.domain.region.vertices().find(|&v| matches!(bed.domain.region.attachments[v], Attachment::Arc { .. })).unwrap();
    let (&ends, _) = bed.domain.region.spans.iter().find(|(ends, _)| ends.contains(&sliding)).unwrap();
    bed.domain.region.spans.remove(&ends);
    let error = bed.try_relax(&options).unwrap_err();
    assert!(matches!(error, RelaxError::ArcOrder(v) if ends.contains(&v)) || matches!(error, RelaxError::Region(_)), "{error}");
}

/// The side of an arc, or the sector at a corner, that a face lies on decides its normal: on the start of every bed, whose
/// triangles are all upright, none counts as inverted.
#[test]
fn upright_starts_have_no_inverted_triangle() {
    for (name, bed) in beds() {
        let report = bed.relax(&only_quadric(QuadricOptions { iterations: 0, ..Default::default() })).report;
        assert_eq!(report.start.inverted, 0, "{name}");
        assert_eq!(report.start, report.end);
    }
    // Base level: faces with corners only, and faces with arc vertices only.
    for bed in [cube(4, 0), frustum([1.0, 1.0], 1.5, 6, 0)] {
        let report = bed.relax(&only_quadric(QuadricOptions { iterations: 0, ..Default::default() })).report;
        assert_eq!(report.start.inverted, 0);
    }
}

#[test]
fn arc_vertices_even_out_along_a_loop() {
    let bed = frustum([1.0, 1.0], 1.5, 6, 3);
    let relaxed = bed.relax(&RelaxOptions::default());
    let lengths: Vec<f64> = relaxed.domain.region.spans.values().map(|s| (s.to - s.from).abs()).collect();
    let (least, most) = lengths.iter().fold((f64::MAX, 0.0f64), |(a, b), &l| (a.min(l), b.max(l)));
    assert!(most < 1.5 * least && lengths.len() == 2 * 6 * 8, "{least} {most}");
}

#[test]
fn a_domain_of_corners_alone_stays() {
    let bed = cube(4, 0);
    let relaxed = bed.relax(&RelaxOptions::default());
    assert_eq!(relaxed.domain.mesh, bed.domain.mesh);
    assert_eq!(relaxed.domain.region.attachments[VertexId(0)], bed.domain.region.attachments[VertexId(0)]);
    assert_eq!(relaxed.domain.region.sheet_of_face[FaceId(0)], bed.domain.region.sheet_of_face[FaceId(0)]);
    assert!(bed.surface.network().n_sheets == 6 && relaxed.domain.region.sheet_of_face.iter().all(|s| *s < SheetId(6)));
}

/// A vertex a billionth of an edge from its neighbour makes triangles that no smoothing opens. All others get as good as without
/// it.
#[test]
fn a_collapsed_triangle_holds_up_nothing_else() {
    for (name, bed) in beds() {
        let v = bed.domain.region.vertices().find(|v| matches!(bed.domain.region.attachments[*v], Attachment::Sheet(_))).unwrap();
        let inner = |w: &VertexId| matches!(bed.domain.region.attachments[*w], Attachment::Sheet(_));
        let Some(w) = bed.domain.topology.one_ring(v).find(inner) else { continue };
        let smooth = only_shape(ShapeOptions { untangling_steps: 0, ..Default::default() });
        let calm = bed.relax(&smooth).report.end;
        let mut collapsed = bed.clone();
        let mut next_to_w = bed.domain.region.points[w];
        next_to_w.barycentric = next_to_w.barycentric.map(|b| (b + 1e-9) / (1.0 + 3e-9));
        collapsed.domain.region.points[v] = next_to_w;
        let report = collapsed.relax_holding(&[v, w], &smooth).report;
        assert!(report.end.ar_mean > calm.ar_mean - 0.05, "{name}: {report:?}, {calm:?}");
        assert!(report.end.ar_mean > report.start.ar_mean, "{name}: {report:?}");
    }
}

/// What is held stays, and everything else makes the best of it.
#[test]
fn held_vertices_stay() {
    for (name, bed) in beds() {
        let inner: Vec<VertexId> = bed
            .domain
            .region
            .vertices()
            .filter(|v| matches!(bed.domain.region.attachments[*v], Attachment::Sheet(_)))
            .step_by(7)
            .collect();
        let bed = bed.clone().jitter(0.3, 5);
        let relaxed = bed.relax_holding(&inner, &RelaxOptions::default());
        assert!(inner.iter().all(|&v| relaxed.domain.region.points[v] == bed.domain.region.points[v]), "{name}");
        let report = relaxed.report;
        assert!(report.end.inverted == 0 && report.end.ar_mean > report.start.ar_mean, "{name}: {report:?}");
    }
}

/// Two places are folded; both come free, and nothing else moves.
#[test]
fn folds_are_relaxed_in_their_place() {
    for (name, bed) in beds() {
        let calm = bed.relax(&RelaxOptions::default());
        let inner = |v: &VertexId| matches!(calm.domain.region.attachments[*v], Attachment::Sheet(_));
        let (first, last) =
            (calm.domain.region.vertices().find(inner).unwrap(), calm.domain.region.vertices().filter(inner).last().unwrap());
        let mut region = calm.domain.region.clone();
        for v in [first, last] {
            // Onto a neighbour, and beyond.
            let w = bed.domain.topology.one_ring(v).next().unwrap();
            let way = 1.3 * (calm.domain.mesh.position(w) - calm.domain.mesh.position(v));
            region.points[v] = bed.walked(region.points[v], way);
        }
        let faces: Vec<FaceId> = [first, last].iter().flat_map(|&v| bed.domain.topology.faces_at(v)).collect();
        let edges = 2;
        let folded = calm.domain.placed(&bed.surface, region).unwrap();
        let relaxed = relax_around(&bed.surface, &folded, &faces, edges, &[], &ShapeOptions::default()).unwrap();
        assert!(relaxed.report.start.inverted > 0, "{name}");
        assert_eq!((relaxed.report.end.inverted, relaxed.inverted.len()), (0, 0), "{name}: {:?}", relaxed.report);
        let mut near: std::collections::BTreeSet<VertexId> = faces.iter().flat_map(|&f| bed.domain.topology.face(f)).collect();
        for _ in 0..edges {
            near = near.iter().flat_map(|&v| bed.domain.topology.one_ring(v).chain([v])).collect();
        }
        let far = |v: &VertexId| !near.contains(v);
        assert!(
            calm.domain.region.vertices().filter(far).all(|v| relaxed.domain.region.points[v] == calm.domain.region.points[v]),
            "{name}"
        );
    }
}
