//! Whatever the arguments are, there is a result or an error.

use glam::DVec3;
use mesh_core::{FaceId, VertexId};
use project::{ProjectOptions, project};
use proptest::prelude::*;
use region_map::{ArcId, ArcSpan, Attachment, CornerId, Domain, SheetId, Surface};

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
        8 => wrong.mesh = fixtures::plane(),
        9 => {
            let scaled = domain.mesh.positions().iter().map(|&p| value * p).collect();
            wrong.mesh = domain.mesh.with_positions(scaled).unwrap_or(wrong.mesh);
        }
        _ => {}
    }
    wrong
}

proptest! {
    #[test]
    fn projecting_gives_a_result_or_an_error(kind in 0..12u32, i in id(), value in value(), ray_reach in value()) {
        let surface = Surface::with_creases(fixtures::cylinder(1.0, 1.0, 8), 40.0).unwrap();
        let domain = damaged(&Domain::identity(&surface), kind, i, value);
        if let Ok(projected) = project(&surface, &domain, None, &ProjectOptions { ray_reach }) {
            projected.domain.check(surface.network()).unwrap();
        }
    }
}
