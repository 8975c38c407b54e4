//! Random arguments: an error or a result, never a panic, and what was found is carried out as told.

use glam::DVec3;
use mesh_core::{FaceId, IdVec, SurfacePoint, VertexId};
use proptest::prelude::*;
use reconnect::{ReconnectOptions, reconnect};
use region_map::{Attachment, Domain, SheetId, Sizing, Surface};
use relax::ShapeOptions;

/// Mostly from a range, else anything.
fn wild(usual: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, f64::MIN_POSITIVE, 1e300, f64::MAX];
    prop_oneof![14 => usual, 1 => proptest::sample::select(odd.to_vec())]
}

fn options() -> impl Strategy<Value = ReconnectOptions> {
    let steps = prop_oneof![6 => 0usize..4, 1 => Just(usize::MAX)];
    let rings = prop_oneof![8 => 1usize..4, 1 => Just(0), 1 => Just(usize::MAX)];
    let tries = prop_oneof![4 => 0usize..3, 1 => Just(usize::MAX)];
    let shape = (steps, 0usize..4, wild(1.0..4.0), wild(0.0..1.0), wild(0.0..0.1));
    (shape, rings, wild(0.01..1.0), wild(0.01..2.0), tries).prop_map(|(shape, rings, least_gain, least_exchange_gain, tries)| {
        let (untangling_steps, steps, power, size_weight, tolerance) = shape;
        let shape = ShapeOptions { untangling_steps, steps, power, size_weight, tolerance };
        ReconnectOptions { shape, rings, least_gain, least_exchange_gain, tries }
    })
}

/// A surface whose faces are those of a base mesh, subdivided so often.
fn surface(which: usize, creased: bool, levels: u32) -> Surface {
    let mesh = match which {
        0 => fixtures::icosphere(2),
        1 => fixtures::cuboid(DVec3::new(1.0, 2.0, 0.5), 1),
        2 => fixtures::cylinder(0.5, 1.5, 6),
        _ => fixtures::plane(),
    };
    let base = Surface::smooth(mesh).unwrap();
    let mesh = subdiv::subdivide(&Domain::identity(&base), levels).unwrap().domain.mesh;
    Surface::with_creases(mesh, if creased { 40.0 } else { 180.0 }).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn no_arguments_panic(
        which in 0usize..4,
        creased in any::<bool>(),
        levels in 0u32..2,
        options in options(),
        sizing in (wild(0.5..1.2), 0usize..8),
        fault in (0usize..8, any::<usize>(), 0u32..100),
        refuse in 1usize..5,
    ) {
        let surface = surface(which, creased, levels);
        let mut domain = Domain::identity(&surface);
        let n = domain.mesh.n_vertices();
        let (kind, i, j) = fault;
        let v = VertexId((i % n) as u32);
        match kind {
            0 => domain.region.points[v] = SurfacePoint { face: FaceId(j), barycentric: DVec3::new(0.2, 0.3, 0.5) },
            1 => domain.region.attachments[v] = Attachment::Sheet(SheetId(j % 7)),
            2 => domain.region.points = IdVec::new(),
            _ => {}
        }
        let (length, one_short) = sizing;
        let sizing = Sizing { relative: IdVec::filled(length, n - usize::from(one_short == 0)) };
        let mut edits = 0;
        let found = reconnect(&surface, &domain, &sizing, &options, |_| {
            edits += 1;
            edits % refuse == 0
        });
        if let Ok(found) = found {
            prop_assert_eq!(found.edits.len(), edits / refuse);
            // A removal may have been carried out, and the split refused that was to make up for it.
            prop_assert!(refuse > 1 || found.energy_at_end <= found.energy_at_start);
        } else if kind > 2 && options.check().is_ok() && one_short > 0 && length > 0.0 && length.is_finite() {
            prop_assert!(levels == 0, "all is right");
        }
    }
}
