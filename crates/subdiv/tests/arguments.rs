//! Whatever the arguments are, there is a result or an error.

use glam::DVec3;
use mesh_core::{FaceId, TriMesh, VertexId};
use proptest::prelude::*;
use region_map::{ArcId, ArcSpan, Attachment, CornerId, Domain, SheetId, Surface};
use subdiv::{SubdivDomain, SubdivError, carried_over, subdivide};

/// Numbers that nobody thinks of.
fn value() -> impl Strategy<Value = f64> {
    prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, 0.3, 1e-300, 1e300, f64::MAX, f64::NAN, f64::INFINITY, f64::NEG_INFINITY])
}

/// Small numbers, and some that are none of anything.
fn id() -> impl Strategy<Value = u32> {
    prop_oneof![0..40u32, prop::sample::select(vec![1_000, 1 << 31, u32::MAX - 1, u32::MAX])]
}

/// A domain with one thing wrong.
fn damaged(domain: &Domain, kind: u32, i: u32, value: f64) -> Domain {
    let mut wrong = domain.clone();
    let region = &mut wrong.region;
    let v = VertexId(i % domain.mesh.n_vertices() as u32);
    match kind {
        0 => region.attachments[v] = Attachment::Sheet(SheetId(i)),
        1 => region.attachments[v] = Attachment::Corner(CornerId(i)),
        2 => region.attachments[v] = Attachment::Arc { arc: ArcId(i), t: value },
        3 => region.points[v].face = FaceId(i),
        4 => region.points[v].barycentric = DVec3::splat(value),
        5 => region.sheet_of_face[FaceId(i % domain.mesh.n_faces() as u32)] = SheetId(i),
        6 => region.insert_span(v, VertexId(i), ArcSpan { arc: ArcId(i), from: value, to: -value }),
        7 => _ = region.points.push(region.points[v]),
        8 => wrong.mesh = fixtures::l_block(1),
        9 => {
            let scaled = domain.mesh.positions().iter().map(|&p| value * p).collect();
            wrong.mesh = domain.mesh.with_positions(scaled).unwrap_or(wrong.mesh);
        }
        _ => {}
    }
    wrong
}

fn is_sound(level: &SubdivDomain, base: &TriMesh) -> bool {
    let n = base.n_faces() << (2 * level.level);
    level.domain.mesh.n_faces() == n && level.origins.len() == level.domain.mesh.n_vertices()
}

proptest! {
    #[test]
    fn subdividing_gives_a_result_or_an_error(
        kind in 0..12u32,
        i in id(),
        value in value(),
        levels in prop_oneof![0..4u32, prop::sample::select(vec![16, 31, 32, 64, u32::MAX])],
    ) {
        let surface = Surface::with_creases(fixtures::cylinder(1.0, 1.0, 8), 40.0).unwrap();
        let base = damaged(&Domain::identity(&surface), kind, i, value);
        match subdivide(&base, levels) {
            Ok(level) => prop_assert!(is_sound(&level, &base.mesh)),
            Err(SubdivError::TooLarge { .. }) => prop_assert!(levels > 4),
            Err(_) => {}
        }
    }

    #[test]
    fn carrying_over_gives_a_result_or_an_error(
        kinds in [0..16u32, 0..16u32],
        i in id(),
        value in value(),
        edges in prop::collection::vec([id(), id()], 0..4),
    ) {
        let surface = Surface::with_creases(fixtures::cylinder(1.0, 1.0, 8), 40.0).unwrap();
        let base = Domain::identity(&surface);
        let finest = subdivide(&base, 1).unwrap().domain;
        let [before, after] = [(&finest, kinds[0]), (&base, kinds[1])].map(|(domain, kind)| damaged(domain, kind, i, value));
        let edges: Vec<_> = edges.into_iter().map(|edge| edge.map(VertexId)).collect();
        if let Ok(Some(carried)) = carried_over(&surface, &before, &base.mesh, &after, &edges) {
            prop_assert_eq!(carried.domain.mesh.n_faces(), finest.mesh.n_faces());
            prop_assert!(carried.new_faces.is_empty());
        }
    }
}
