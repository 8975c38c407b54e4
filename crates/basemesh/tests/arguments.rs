//! Arguments of any kind give a base mesh or an error, never a panic.

use basemesh::{BaseError, BaseOptions, Replay, bisect, build, decimate, mend};
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, Id as _, SurfacePoint, VertexId};
use proptest::prelude::*;
use region_map::{
    ArcId, ArcSpan, Attachment, BaseEdit, BaseMesh, CellArcId, CellCornerId, Cells, CornerId, MapFaceId, PatchId, Segmentation,
    SheetId, Sites, Sizing, Surface,
};

/// What all verbs of this crate take.
struct Given {
    surface: Surface,
    cells: Cells,
    sites: Sites,
}

impl Given {
    /// A cube or a cylinder, each side a patch, with a site in the middle of some faces and three on each arc.
    fn new(round: bool) -> Self {
        let mesh = if round { fixtures::cylinder(1.0, 2.0, 12) } else { fixtures::cube(2) };
        let surface = Surface::with_creases(mesh, 40.0).unwrap();
        let mesh = surface.mesh();
        // The round side in two parts, so that each is a disk.
        let side = |f: FaceId| u32::from(round && mesh.normal(f).z.abs() < 0.5 && mesh.centroid(f).x > 0.0);
        let same = |f: FaceId, g: Option<FaceId>| g.is_some_and(|g| side(f) == side(g));
        let topology = surface.topology();
        let crossable = |e| {
            let (f, g) = topology.edge_faces(e);
            !surface.network().is_barrier(e) && same(f, g)
        };
        let (patches, n_patches) = topology.regions(crossable);
        let segmentation = Segmentation { patch_of_face: patches.iter().map(|&p| PatchId(p)).collect(), n_patches };
        let cells = Cells::trace(&surface, &segmentation).unwrap();
        let on_arcs = cells.arcs.iter().map(|a| (1..4).map(|i| a.length() * f64::from(i) / 4.0).collect()).collect();
        let middle = |&source: &FaceId| SurfacePoint::new(source, DVec3::ONE);
        let in_patches = cells.patches.iter().map(|p| p.faces.iter().step_by(3).map(middle).collect()).collect();
        Self { sites: Sites { on_arcs, in_patches }, cells, surface }
    }

    fn sizing(&self) -> Sizing {
        Sizing::uniform(self.surface.mesh())
    }

    fn base(&self) -> BaseMesh {
        let options = BaseOptions { base_vertices: 30, rounds: 1, max_shrunk: 1.0, ..Default::default() };
        build(&self.surface, &self.cells, &self.sites, &self.sizing(), &options).unwrap()
    }

    fn check(&self, result: Result<BaseMesh, BaseError>) {
        if let Ok(base) = result {
            base.domain.check(self.surface.network()).unwrap();
            assert!(base.round_trip_error(self.surface.mesh(), 50) < 1e-6);
        }
    }
}

/// Numbers that are no numbers to expect.
fn odd() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(-1.0),
        Just(-0.0),
        Just(0.0),
        Just(1e-300),
        Just(1e300),
        Just(0.05),
        Just(1.0)
    ]
}

fn options() -> impl Strategy<Value = BaseOptions> {
    let base_vertices = prop_oneof![Just(0), Just(1), Just(4), 5..60usize, Just(10_000_001), Just(usize::MAX)];
    let rounds = prop_oneof![0..3usize, Just(1001), Just(usize::MAX)];
    (base_vertices, rounds, odd(), 0..3u64).prop_map(|(base_vertices, rounds, max_shrunk, seed)| BaseOptions {
        base_vertices,
        rounds,
        max_shrunk,
        seed,
    })
}

/// A base mesh with one thing wrong.
fn corrupted(mut base: BaseMesh, what: usize, at: usize, number: f64) -> BaseMesh {
    let region = &mut base.domain.region;
    let (v, f) = (VertexId::new(at % region.attachments.len()), FaceId::new(at % region.sheet_of_face.len()));
    let span = ArcSpan { arc: ArcId(at as u32), from: number, to: 1.0 };
    match what {
        0 => region.attachments[v] = Attachment::Corner(CornerId(at as u32)),
        1 => region.attachments[v] = Attachment::Arc { arc: ArcId(at as u32), t: number },
        2 => region.attachments[v] = Attachment::Sheet(SheetId(at as u32)),
        3 => region.points[v] = SurfacePoint { face: FaceId(at as u32), barycentric: DVec3::ONE / 3.0 },
        4 => region.points[v].barycentric = DVec3::splat(number),
        5 => region.sheet_of_face[f] = SheetId(at as u32),
        6 => _ = region.spans.insert([v, VertexId(at as u32)], span),
        7 => _ = region.spans.pop_first(),
        8 => base.map_faces[f] = MapFaceId(at as u32),
        9 => _ = base.map_faces.push(MapFaceId(0)),
        10 => _ = region.points.push(region.points[v]),
        11 => base.domain.mesh = fixtures::cube(1),
        12 => base.map = Given::new(at > 20).base().map,
        _ => base.domain.topology = Given::new(at > 20).base().domain.topology,
    }
    base
}

/// Cells and sites with one thing wrong.
fn disturbed(given: &mut Given, what: usize, at: usize, number: f64) {
    let id = at as u32;
    let (cells, sites) = (&mut given.cells, &mut given.sites);
    let (arc, patch) = (CellArcId::new(at % cells.arcs.len()), PatchId::new(at % cells.patches.len()));
    match what {
        0 => cells.arcs[arc].corners[0] = CellCornerId(id),
        1 => cells.arcs[arc].vertices[0] = VertexId(id),
        2 => cells.arcs[arc].halfedges[0] = HalfedgeId(id),
        3 => cells.arcs[arc].lengths[1] = number,
        4 => _ = cells.arcs[arc].lengths.pop(),
        5 => cells.arcs[arc].on = Some(ArcSpan { arc: ArcId(id), from: number, to: number }),
        6 => cells.patches[patch].faces.clear(),
        7 => cells.patches[patch].faces[0] = FaceId(id),
        8 => cells.patches[patch].border[0] = (CellArcId(id), at > 20),
        9 => cells.patches[patch].border.clear(),
        10 => cells.corners[CellCornerId(0)] = VertexId(id),
        11 => sites.on_arcs[arc][0] = number,
        12 => sites.on_arcs[arc].clear(),
        13 => sites.in_patches[patch].push(SurfacePoint { face: FaceId(id), barycentric: DVec3::splat(number) }),
        14 => _ = sites.in_patches.push(Vec::new()),
        15 => _ = cells.arcs.push(cells.arcs[arc].clone()),
        _ => *cells = Given::new(at > 20).cells,
    }
}

/// Low numbers, which may be there, and high ones, which are not.
fn id() -> impl Strategy<Value = usize> {
    prop_oneof![0..40usize, Just(u32::MAX as usize), Just(u32::MAX as usize - 1), 0..2000usize]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn of_decimate_and_build(round: bool, options in options(), at in 0..2000usize, relative in odd(), longer: bool) {
        let given = Given::new(round);
        let mut sizing = given.sizing();
        let v = VertexId::new(at % sizing.relative.len());
        sizing.relative[v] = relative;
        if longer {
            sizing.relative.push(1.0);
        }
        given.check(decimate(&given.surface, &sizing, &options));
        given.check(build(&given.surface, &given.cells, &given.sites, &sizing, &options));
    }

    #[test]
    fn of_build_with_cells_that_are_wrong(round: bool, what in 0..17usize, at in id(), number in odd()) {
        let mut given = Given::new(round);
        disturbed(&mut given, what, at, number);
        let options = BaseOptions { base_vertices: 30, rounds: 1, max_shrunk: 1.0, ..Default::default() };
        given.check(build(&given.surface, &given.cells, &given.sites, &given.sizing(), &options));
    }

    #[test]
    fn of_the_verbs_that_take_a_base_mesh(round: bool, what in 0..15usize, at in id(), number in odd(), edges in prop::collection::vec((id(), id()), 0..4)) {
        let given = Given::new(round);
        let base = corrupted(given.base(), what, at, number);
        let edges: Vec<_> = edges.into_iter().map(|(a, b)| [VertexId(a as u32), VertexId(b as u32)]).collect();
        given.check(bisect(&given.surface, base.clone(), &edges));
        given.check(mend(&given.surface, base.clone()).map(|mended| mended.base));
        if let Ok(replay) = Replay::new(&given.surface, base) {
            given.check(replay.finish());
        }
    }

    #[test]
    fn of_edits(round: bool, edits in prop::collection::vec((0..3usize, id(), id(), prop::collection::vec(id(), 0..12)), 1..12)) {
        let given = Given::new(round);
        let mut replay = Replay::new(&given.surface, given.base()).unwrap();
        for (what, a, b, filling) in edits {
            let [a, b] = [a, b].map(|v| VertexId(v as u32));
            let filling = filling.chunks_exact(3).map(|t| [0, 1, 2].map(|c| VertexId(t[c] as u32))).collect();
            replay.edit(&match what {
                0 => BaseEdit::Flip([a, b]),
                1 => BaseEdit::Split([a, b]),
                _ => BaseEdit::Remove { vertex: a, filling },
            });
        }
        given.check(replay.finish());
    }
}

/// A sizing field says how lengths compare: a thousandth of every length asks for the same mesh, and not for a million vertices.
#[test]
fn a_sizing_field_of_tiny_lengths_is_no_request_for_many_vertices() {
    let given = Given::new(false);
    let tiny = Sizing { relative: given.sizing().relative.iter().map(|r| r / 1000.0).collect() };
    let options = BaseOptions { base_vertices: 60, ..Default::default() };
    let base = decimate(&given.surface, &tiny, &options).unwrap();
    assert_eq!(base.mesh().n_vertices(), 60);
    given.check(Ok(base));
}

#[test]
fn errors_say_which_argument_is_wrong() {
    let given = Given::new(false);
    let (sizing, base) = (given.sizing(), given.base());
    let wrong = BaseOptions { max_shrunk: f64::NAN, ..Default::default() };
    let error = decimate(&given.surface, &sizing, &wrong).unwrap_err();
    assert_eq!(error.to_string(), "the option max_shrunk is NaN; it must be from 0 to 1");
    let gone = [VertexId(0), VertexId(u32::MAX)];
    assert_eq!(bisect(&given.surface, base.clone(), &[gone]).unwrap_err(), BaseError::NoSuchEdge(gone[0], gone[1]));
    let other = Given::new(true);
    assert!(matches!(bisect(&other.surface, base, &[]), Err(BaseError::Unfit(_))));
    let sizing = other.sizing();
    assert_eq!(
        decimate(&given.surface, &sizing, &BaseOptions::default()).unwrap_err(),
        BaseError::OtherSurface("the sizing field")
    );
}

/// A vertex on an arc leaves two polygons to fill: where the filling of one is wrong, nothing must change on the other side, either.
#[test]
fn a_filling_that_covers_a_polygon_twice_is_refused() {
    let given = Given::new(true);
    let base = given.base();
    let region = &base.domain.region;
    let mut tried = 0;
    for v in region.vertices().filter(|&v| matches!(region.attachments[v], Attachment::Arc { .. })) {
        let ring: Vec<VertexId> = base.domain.topology.one_ring(v).collect();
        let n = ring.len();
        let on_arc: Vec<usize> = (0..n).filter(|&i| region.span(v, ring[i]).is_some()).collect();
        let [i, j] = on_arc[..] else { panic!("a vertex on an arc has two neighbours there") };
        let side = |from: usize, to: usize| (0..=(to + n - from) % n).map(|k| ring[(from + k) % n]).collect::<Vec<_>>();
        let fan = |side: &[VertexId]| side.windows(2).skip(1).map(|w| [side[0], w[0], w[1]]).collect::<Vec<_>>();
        for (right, wrong) in [(side(i, j), side(j, i)), (side(j, i), side(i, j))] {
            if wrong.len() < 4 {
                continue;
            }
            // As many triangles as fill the polygon, but one of them again and again.
            let twice = vec![[wrong[0], wrong[1], wrong[2]]; wrong.len() - 2];
            let mut replay = Replay::new(&given.surface, base.clone()).unwrap();
            assert!(!replay.edit(&BaseEdit::Remove { vertex: v, filling: [fan(&right), twice].concat() }));
            let unchanged = replay.finish().unwrap();
            assert_eq!((unchanged.mesh(), unchanged.map.n_edits()), (base.mesh(), base.map.n_edits()));
            tried += 1;
        }
    }
    assert!(tried > 10, "{tried}");
}
