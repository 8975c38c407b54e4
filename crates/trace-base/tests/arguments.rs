//! Arguments of any kind give a traced base mesh or an error, never a panic.

use basemesh::{BaseOptions, decimate};
use glam::DVec3;
use mesh_core::{FaceId, Id as _, SurfacePoint, TriMesh, VertexId};
use proptest::prelude::*;
use region_map::{ArcId, ArcSpan, Attachment, BaseMesh, CornerId, MapFaceId, SheetId, Sizing, Surface};
use trace_base::{TraceError, TracedBase, Untraced, retrace, trace};

fn surface(round: bool) -> Surface {
    let mesh = if round { fixtures::cylinder(1.0, 2.0, 12) } else { fixtures::cube(3) };
    Surface::with_creases(mesh, 40.0).unwrap()
}

fn base(surface: &Surface) -> BaseMesh {
    let options = BaseOptions { base_vertices: 20, rounds: 1, ..Default::default() };
    decimate(surface, &Sizing::uniform(surface.mesh()), &options).unwrap()
}

fn check(surface: &Surface, base: &TriMesh) {
    if let Ok(traced) = trace(surface, base) {
        let domain = traced.base.domain();
        domain.check(traced.surface.network()).unwrap();
        assert_eq!((domain.mesh.n_vertices(), domain.mesh.n_faces()), (base.n_vertices(), base.n_faces()));
    }
}

/// A base mesh with one thing wrong.
fn corrupted(mut base: BaseMesh, what: usize, at: usize, number: f64) -> BaseMesh {
    let region = &mut base.domain.region;
    let (v, f) = (VertexId::new(at % region.attachments.len()), FaceId::new(at % region.sheet_of_face.len()));
    match what {
        0 => region.attachments[v] = Attachment::Corner(CornerId(at as u32)),
        1 => region.attachments[v] = Attachment::Arc { arc: ArcId(at as u32), t: number },
        2 => region.attachments[v] = Attachment::Sheet(SheetId(at as u32)),
        3 => region.points[v] = SurfacePoint { face: FaceId(at as u32), barycentric: DVec3::ONE / 3.0 },
        4 => region.points[v].barycentric = DVec3::splat(number),
        5 => region.sheet_of_face[f] = SheetId(at as u32),
        6 => _ = region.spans.insert([v, VertexId(at as u32)], ArcSpan { arc: ArcId(0), from: number, to: 1.0 }),
        7 => _ = region.spans.pop_first(),
        8 => base.map_faces[f] = MapFaceId(at as u32),
        9 => base.domain.mesh = fixtures::cube(1),
        10 => base.map = crate::base(&surface(at > 20)).map,
        _ => base.domain.topology = crate::base(&surface(at > 20)).domain.topology,
    }
    base
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Vertices anywhere, faces turned round, left out or made anew.
    #[test]
    fn of_trace(round: bool, moved in prop::collection::vec((0..40usize, -0.6..0.6f64, -0.6..0.6f64), 0..6), change in 0..5usize, at in 0..100usize) {
        let surface = surface(round);
        let given = if change == 4 { fixtures::icosphere(1 + at % 2) } else { base(&surface).domain.mesh };
        let mut positions = given.positions().as_slice().to_vec();
        for (v, x, y) in moved {
            let n = positions.len();
            positions[v % n] += DVec3::new(x, y, x * y);
        }
        let mut faces = given.face_arrays();
        let n = faces.len();
        match change {
            0 => faces[at % n].swap(0, 1),
            1 => _ = faces.remove(at % n),
            2 => positions.push(DVec3::ZERO),
            _ => {}
        }
        check(&surface, &TriMesh::new(positions, faces).unwrap());
    }

    #[test]
    fn of_retrace(round: bool, what in 0..12usize, at in prop_oneof![0..40usize, 0..2000usize, Just(u32::MAX as usize)], number in prop_oneof![Just(f64::NAN), Just(-1.0), 0.0..3.0f64]) {
        let surface = surface(round);
        let base = corrupted(base(&surface), what, at, number);
        if let Ok(new) = retrace(&surface, &base) {
            new.domain.check(surface.network()).unwrap();
            prop_assert!(new.round_trip_error(surface.mesh(), 50) < 1e-6);
        }
    }
}

#[test]
fn meshes_of_almost_nothing() {
    let surface = surface(false);
    let empty = TriMesh::new(Vec::new(), Vec::new()).unwrap();
    assert!(matches!(trace(&surface, &empty), Err(TraceError::OtherTopology { .. })));
    let cube = fixtures::cube(1);
    let mut positions = cube.positions().as_slice().to_vec();
    positions.push(DVec3::ZERO);
    let spare = VertexId::new(positions.len() - 1);
    let with_spare = TriMesh::new(positions, cube.face_arrays()).unwrap();
    assert_eq!(trace(&surface, &with_spare).unwrap_err(), TraceError::UnusedVertex(spare));
    // All vertices in one place.
    check(&surface, &cube.with_positions(vec![DVec3::splat(0.3); cube.n_vertices()]).unwrap());
}

#[test]
fn a_base_mesh_of_another_surface_is_not_traced_anew() {
    let [cube, cylinder] = [surface(false), surface(true)];
    assert_eq!(retrace(&cylinder, &base(&cube)).unwrap_err(), Untraced::OtherSurface);
}

/// What was told to end ends with what it has, or says so.
#[test]
fn interrupted_work_ends() {
    let surface = surface(false);
    let base = base(&surface);
    let interrupt = mesh_core::Interrupt::default();
    let surface = surface.with_interrupt(interrupt.clone());
    interrupt.set();
    assert_eq!(retrace(&surface, &base).unwrap_err(), Untraced::Interrupted);
    let traced = trace(&surface, &fixtures::cube(1)).unwrap();
    assert!(matches!(traced.base, TracedBase::Unmapped { reason: Untraced::Interrupted, .. }));
    let wanted = BaseOptions { base_vertices: 8, ..Default::default() };
    let unchanged = decimate(&surface, &Sizing::uniform(surface.mesh()), &wanted).unwrap();
    assert!(unchanged.mesh().n_vertices() > 8);
}
