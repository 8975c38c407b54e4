//! Whatever the arguments are, there is a result or an error, and no panic.

use crate::topology;
use glam::DVec3;
use mesh_core::{FaceId, IdVec, SurfacePoint, TriMesh, VertexId};
use proptest::prelude::*;
use region_map::{
    ArcId, ArcKind, ArcSpan, Attachment, Cells, CornerId, Domain, Network, PatchId, Segmentation, SheetId, Surface,
};

fn shape(which: usize) -> TriMesh {
    match which {
        0 => fixtures::plane(),
        1 => fixtures::cube(1),
        2 => fixtures::cylinder(0.5, 1.0, 6),
        _ => fixtures::shell(8),
    }
}

/// Ids that are there, that are just beyond the last, and that are far from it.
fn id() -> impl Strategy<Value = u32> {
    prop_oneof![8 => 0..40u32, 1 => Just(u32::MAX), 1 => any::<u32>()]
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![0.0..3.0f64, prop::sample::select(vec![f64::NAN, f64::INFINITY, -1.0, 1e300])]
}

fn kind() -> impl Strategy<Value = Option<ArcKind>> {
    prop::sample::select(vec![None, None, Some(ArcKind::Sharp), Some(ArcKind::Border), Some(ArcKind::Marked)])
}

fn attachment() -> impl Strategy<Value = Attachment> {
    prop_oneof![
        id().prop_map(|c| Attachment::Corner(CornerId(c))),
        (id(), number()).prop_map(|(a, t)| Attachment::Arc { arc: ArcId(a), t }),
        id().prop_map(|s| Attachment::Sheet(SheetId(s))),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn tracing_never_panics(
        which in 0..4usize,
        kinds in prop::collection::vec(kind(), 1..60),
        more in prop_oneof![8 => Just(0), 1 => 1..3usize],
        corners in prop::collection::vec(id(), 0..6),
        minor in prop::collection::vec(prop_oneof![3 => 0..4u32, 1 => id()], 0..3),
        patches in prop::collection::vec(0..6u32, 1..40),
        n_patches in prop_oneof![3 => 0..9usize, 1 => Just(usize::MAX)],
    ) {
        let mesh = shape(which);
        let topology = topology(&mesh);
        let kinds: IdVec<_, _> = kinds.iter().copied().cycle().take(topology.n_edges() + more).collect();
        let minor = vec![minor.into_iter().map(VertexId).collect()];
        let Ok(network) = Network::trace(&mesh, &topology, &kinds, |v| corners.contains(&v.0), minor) else { return Ok(()) };
        let surface = Surface::new(mesh, topology, network).unwrap();
        let patch_of_face = patches.iter().copied().map(PatchId).cycle().take(surface.mesh().n_faces() + more).collect();
        if let Ok(cells) = Cells::trace(&surface, &Segmentation { patch_of_face, n_patches }) {
            prop_assert_eq!(cells.patches.len(), n_patches);
        }
    }

    #[test]
    fn checking_and_placing_never_panic(
        which in 0..4usize,
        attachments in prop::collection::vec((0..4u32, attachment()), 0..3),
        points in prop::collection::vec((0..4u32, id(), [number(), number(), number()]), 0..3),
        sheets in prop::collection::vec((0..2u32, id()), 0..3),
        spans in prop::collection::vec(([id(), id()], id(), number(), number()), 0..3),
    ) {
        let surface = Surface::with_creases(shape(which), 40.0).unwrap();
        let mut domain = Domain::identity(&surface);
        let region = &mut domain.region;
        for (v, attachment) in attachments {
            region.attachments[VertexId(v)] = attachment;
        }
        for (v, f, barycentric) in points {
            region.points[VertexId(v)] = SurfacePoint { face: FaceId(f), barycentric: DVec3::from_array(barycentric) };
        }
        for (f, s) in sheets {
            region.sheet_of_face[FaceId(f)] = SheetId(s);
        }
        for (ends, arc, from, to) in spans {
            region.spans.insert(ends.map(VertexId), ArcSpan { arc: ArcId(arc), from, to });
        }
        // What the check lets pass can be placed.
        let is_placed = domain.placed(&surface, domain.region.clone()).is_ok();
        prop_assert!(is_placed || domain.check(surface.network()).is_err());
    }
}
