//! Random arguments: every verb gives an error or a result, never a panic.

use glam::DVec3;
use mesh_core::{FaceId, SurfacePoint, TriMesh, VertexId};
use proptest::prelude::*;
use region_map::{ArcId, ArcSpan, Attachment, CornerId, Domain, SheetId, Surface};
use relax::{
    QuadricOptions, RelaxOptions, ShapeOptions, Weights, inverted, relax, relax_around, relax_holding, relax_in_space,
    relax_keeping,
};

/// Mostly from a range, else anything.
fn wild(usual: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, f64::MIN_POSITIVE, 1e300, f64::MAX];
    prop_oneof![9 => usual, 1 => proptest::sample::select(odd.to_vec())]
}

fn count() -> impl Strategy<Value = usize> {
    prop_oneof![4 => 0usize..6, 1 => Just(usize::MAX)]
}

fn shape() -> impl Strategy<Value = ShapeOptions> {
    (count(), 0usize..6, wild(1.0..4.0), wild(0.0..1.0), wild(0.0..0.1)).prop_map(
        |(untangling_steps, steps, power, size_weight, tolerance)| ShapeOptions {
            untangling_steps,
            steps,
            power,
            size_weight,
            tolerance,
        },
    )
}

fn options() -> impl Strategy<Value = RelaxOptions> {
    let weights = proptest::sample::select(vec![Weights::Uniform, Weights::Adaptive]);
    (count(), weights, wild(0.0..3.0), wild(0.0..1.0), shape()).prop_map(
        |(iterations, weights, plane_weight, target_quality, shape)| RelaxOptions {
            quadric: QuadricOptions { iterations, weights, plane_weight, target_quality },
            shape,
        },
    )
}

/// Closed, with corners and arcs, with loops, open and smooth.
fn surface() -> impl Strategy<Value = Surface> {
    (0usize..4, any::<bool>()).prop_map(|(which, creased)| {
        let mesh = match which {
            0 => fixtures::icosphere(2),
            1 => fixtures::cuboid(DVec3::new(1.0, 2.0, 0.5), 2),
            2 => fixtures::cylinder(0.5, 1.5, 8),
            _ => fixtures::plane(),
        };
        Surface::with_creases(mesh, if creased { 40.0 } else { 180.0 }).unwrap()
    })
}

/// One thing that is wrong with a domain, or nothing.
#[derive(Clone, Debug)]
enum Fault {
    None,
    Attachment(usize, Attachment),
    Point(usize, u32, [f64; 3]),
    NoSpan(usize),
    Span(usize, f64, f64),
    Sheet(usize, u32),
    OtherMesh,
    OtherTopology,
    ShortTable,
}

fn fault() -> impl Strategy<Value = Fault> {
    let attachment = prop_oneof![
        (0u32..10).prop_map(|c| Attachment::Corner(CornerId(c))),
        (0u32..14, wild(0.0..2.0)).prop_map(|(a, t)| Attachment::Arc { arc: ArcId(a), t }),
        (0u32..8).prop_map(|s| Attachment::Sheet(SheetId(s))),
    ];
    let weights = [wild(0.0..1.0), wild(0.0..1.0), wild(0.0..1.0)];
    prop_oneof![
        4 => Just(Fault::None),
        2 => (any::<usize>(), attachment).prop_map(|(v, a)| Fault::Attachment(v, a)),
        4 => (any::<usize>(), 0u32..200, weights).prop_map(|(v, f, w)| Fault::Point(v, f, w)),
        1 => any::<usize>().prop_map(Fault::NoSpan),
        2 => (any::<usize>(), wild(0.0..2.0), wild(0.0..2.0)).prop_map(|(i, from, to)| Fault::Span(i, from, to)),
        1 => (any::<usize>(), 0u32..8).prop_map(|(f, s)| Fault::Sheet(f, s)),
        1 => Just(Fault::OtherMesh),
        1 => Just(Fault::OtherTopology),
        1 => Just(Fault::ShortTable),
    ]
}

/// The surface as its own domain, with this fault.
fn domain(surface: &Surface, fault: Fault) -> Domain {
    let mut domain = Domain::identity(surface);
    let other = || Domain::identity(&Surface::smooth(fixtures::icosphere(1)).unwrap());
    let (n, n_faces) = (domain.mesh.n_vertices(), domain.mesh.n_faces());
    let region = &mut domain.region;
    let key = |i: usize| region.spans.keys().nth(i % region.spans.len().max(1)).copied();
    match fault {
        Fault::None => {}
        Fault::Attachment(v, attachment) => region.attachments[VertexId((v % n) as u32)] = attachment,
        Fault::Point(v, face, weights) => {
            let barycentric = DVec3::from_array(weights);
            region.points[VertexId((v % n) as u32)] = SurfacePoint { face: FaceId(face), barycentric };
        }
        Fault::NoSpan(i) => drop(key(i).and_then(|k| region.spans.remove(&k))),
        Fault::Span(i, from, to) => {
            if let Some([a, b]) = key(i) {
                let arc = region.spans[&[a, b]].arc;
                region.insert_span(a, b, ArcSpan { arc, from, to });
            }
        }
        Fault::Sheet(f, s) => region.sheet_of_face[FaceId((f % n_faces) as u32)] = SheetId(s),
        Fault::OtherMesh => domain.mesh = other().mesh,
        Fault::OtherTopology => domain.topology = other().topology,
        Fault::ShortTable => region.points = other().region.points,
    }
    domain
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_arguments_panic(
        surface in surface(),
        fault in fault(),
        options in options(),
        ids in proptest::collection::vec(0u32..150, 0..5),
        edges in count(),
        base_edge_length in wild(0.01..2.0),
    ) {
        let domain = domain(&surface, fault.clone());
        let held: Vec<VertexId> = ids.iter().copied().map(VertexId).collect();
        let faces: Vec<FaceId> = ids.iter().copied().map(FaceId).collect();
        let all_faces = inverted(&surface, &domain);
        let plain = relax(&surface, &domain, &options);
        let holding = relax_holding(&surface, &domain, &held, &options);
        let around = relax_around(&surface, &domain, &faces, edges, &held, &options.shape);
        let keeping = relax_keeping(&surface, &domain, surface.mesh(), base_edge_length, &options);
        let in_space = relax_in_space(&surface, &domain, &options.quadric);
        // Where all is right there is a result.
        let fits = matches!(fault, Fault::None);
        prop_assert!(!fits || all_faces.is_ok());
        if fits && options.check().is_ok() {
            prop_assert!(plain.is_ok() && in_space.is_ok());
            let are_held_there = held.iter().all(|v| v.0 < domain.mesh.n_vertices() as u32);
            prop_assert_eq!(holding.is_ok(), are_held_there);
            prop_assert_eq!(around.is_ok(), are_held_there && faces.iter().all(|f| f.0 < domain.mesh.n_faces() as u32));
            prop_assert_eq!(keeping.is_ok(), base_edge_length > 0.0 && base_edge_length.is_finite());
        }
        if options.check().is_err() {
            prop_assert!(plain.is_err() && holding.is_err() && keeping.is_err());
        }
    }
}

#[test]
fn a_mesh_without_faces_is_relaxed_to_itself() {
    let surface = Surface::smooth(TriMesh::new(vec![], vec![]).unwrap()).unwrap();
    let domain = Domain::identity(&surface);
    let relaxed = relax(&surface, &domain, &RelaxOptions::default()).unwrap();
    assert_eq!((relaxed.domain.mesh.n_faces(), relaxed.inverted.len()), (0, 0));
    let around = relax_around(&surface, &domain, &[], usize::MAX, &[], &ShapeOptions::default()).unwrap();
    assert_eq!(around.domain.mesh.n_faces(), 0);
}
