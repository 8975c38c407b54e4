//! Domains on a base mesh with its map to the surface.

use glam::{DVec2, DVec3};
use mesh_core::{FaceId, Id as _, IdVec, SurfacePoint, TriMesh, VertexId};
use project::{Origins, ProjectError, ProjectOptions, ProjectReport, Projected, project};
use proptest::prelude::*;
use region_map::{
    ArcKind, ArcSpan, Attachment, BaseMap, BaseMesh, Chart, ChartFace, ChartId, Domain, MapFaceId, Network, RegionMap,
    RegionMapError, Surface,
};
use std::collections::BTreeMap;
use subdiv::{SubdivDomain, subdivide};

/// Levels between the base mesh and the working mesh.
const FINER: u32 = 2;

/// A working mesh that is a base mesh subdivided and bent, and the base mesh subdivided to another level.
struct Bed {
    surface: Surface,
    base: BaseMesh,
    finest: SubdivDomain,
}

impl Bed {
    fn new(base: &TriMesh, bend: impl Fn(DVec3) -> DVec3, levels: u32) -> Self {
        let flat = subdivide(&Domain::identity(&Surface::smooth(base.clone()).unwrap()), FINER).unwrap().domain;
        let bent = flat.mesh.with_positions(flat.mesh.positions().iter().map(|&p| bend(p)).collect()).unwrap();
        let kinds = ArcKind::by_angle(&flat.mesh, &flat.topology, 40.0);
        // The base vertices on creases are corners, so the arcs are the edges between them.
        let is_corner = |v: VertexId| {
            let mut edges = flat.topology.fan(v).flat_map(|h| [h, h.prev()]).map(|h| flat.topology.edge(h));
            v.index() < base.n_vertices() && edges.any(|e| kinds[e].is_some())
        };
        let network = Network::trace(&bent, &flat.topology, &kinds, is_corner, Vec::new()).unwrap();
        let surface = Surface::new(bent, flat.topology, network).unwrap();
        let base = base_mesh(&surface, base);
        let finest = subdivide(&base.domain, levels).unwrap();
        Self { surface, base, finest }
    }

    fn origins(&self) -> Origins<'_> {
        Origins { base: &self.base, points: &self.finest.origins }
    }

    fn project(&self, origins: Option<Origins<'_>>, options: &ProjectOptions) -> Projected {
        project(&self.surface, &self.finest.domain, origins, options).unwrap()
    }
}

/// The base mesh of a surface whose first vertices are the base vertices, with one chart for each base face.
fn base_mesh(surface: &Surface, base: &TriMesh) -> BaseMesh {
    let own = Domain::identity(surface).region;
    let mut spans = BTreeMap::new();
    for (arc, a) in surface.network().arcs.enumerate() {
        let [first, last] = [a.vertices[0], a.vertices[a.vertices.len() - 1]];
        let [from, to] = if first < last { [0.0, a.length()] } else { [a.length(), 0.0] };
        spans.insert([first.min(last), first.max(last)], ArcSpan { arc, from, to });
    }
    let region = RegionMap {
        attachments: own.attachments.iter().take(base.n_vertices()).copied().collect(),
        points: own.points.iter().take(base.n_vertices()).copied().collect(),
        sheet_of_face: base.faces().ids().map(|f| own.sheet_of_face[FaceId(f.0 << (2 * FINER))]).collect(),
        spans,
    };
    let mesh = base.with_positions(region.points.iter().map(|p| p.position(surface.mesh())).collect()).unwrap();
    let charts: IdVec<ChartId, Chart> = base.faces().ids().map(chart).collect();
    let faces: Vec<_> = charts.ids().map(|c| (c, [DVec2::ZERO, DVec2::X, DVec2::Y])).collect();
    let map_faces = (0..faces.len()).map(MapFaceId::new).collect();
    BaseMesh { domain: Domain::new(mesh, region).unwrap(), map: BaseMap::new(charts, &faces).unwrap(), map_faces }
}

/// The working faces of a base face, laid out as they were before they were bent.
fn chart(f: FaceId) -> Chart {
    let mut layout = vec![[DVec2::ZERO, DVec2::X, DVec2::Y]];
    for _ in 0..FINER {
        let children = |[a, b, c]: [DVec2; 3]| {
            let [ab, bc, ca] = [a.midpoint(b), b.midpoint(c), c.midpoint(a)];
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]]
        };
        layout = layout.into_iter().flat_map(children).collect();
    }
    let face = |i: u32| ChartFace {
        vertices: [3 * i, 3 * i + 1, 3 * i + 2],
        source: FaceId((f.0 << (2 * FINER)) + i),
        barycentric: [DVec3::X, DVec3::Y, DVec3::Z],
    };
    Chart::new(layout.as_flattened().to_vec(), (0..layout.len() as u32).map(face).collect()).unwrap()
}

/// Curved and flat ones, with creases and without.
fn beds(levels: u32) -> Vec<Bed> {
    let side = |p: DVec3| {
        let r = p.x.hypot(p.y);
        if r > 0.49 { p * DVec3::new(0.5 / r, 0.5 / r, 1.0) } else { p }
    };
    vec![
        Bed::new(&fixtures::icosphere(3), |p| p.normalize(), levels),
        Bed::new(&fixtures::cylinder(0.5, 1.5, 12), side, levels),
        Bed::new(&fixtures::shell(8), |p| p, levels),
        Bed::new(&fixtures::part(1), |p| p, levels),
        Bed::new(&fixtures::crossing_boxes(2), |p| p, levels),
    ]
}

/// A vertex that was in the working mesh before it was bent is where bending has put it.
#[test]
fn the_map_brings_vertices_to_those_of_the_working_mesh() {
    for bed in beds(FINER) {
        let projected = bed.project(Some(bed.origins()), &ProjectOptions { ray_reach: 0.0 }).domain;
        let size = bed.surface.mesh().diagonal();
        for (v, p) in projected.mesh.positions().enumerate() {
            if let Attachment::Sheet(_) = projected.region.attachments[v] {
                assert!(p.distance(bed.surface.mesh().position(v)) < 1e-9 * size, "{v}");
            }
        }
    }
}

/// No vertex leaves its corner, arc or sheet, and positions are those of the points.
fn check_places(surface: &Surface, Domain { mesh, region, .. }: &Domain) {
    let size = surface.mesh().diagonal();
    for v in mesh.positions().ids() {
        let (position, point) = (mesh.position(v), region.points[v]);
        assert!(point.position(surface.mesh()).distance(position) < 1e-12 * size);
        match region.attachments[v] {
            Attachment::Corner(c) => assert_eq!(position, surface.mesh().position(surface.network().corners[c])),
            Attachment::Arc { arc, t } => {
                assert!(surface.network().arcs[arc].position(surface.mesh(), t).distance(position) < 1e-12 * size);
            }
            Attachment::Sheet(s) => assert_eq!(surface.network().sheet_of_face[point.face], s),
        }
    }
}

#[test]
fn with_a_map_and_without_no_vertex_leaves_its_place() {
    for bed in beds(3) {
        for (origins, ray_reach) in [(None, 0.5), (Some(bed.origins()), 0.0), (Some(bed.origins()), 0.5)] {
            let Projected { domain, report } = bed.project(origins, &ProjectOptions { ray_reach });
            check_places(&bed.surface, &domain);
            domain.check(bed.surface.network()).unwrap();
            let inner = domain.region.class_counts().in_sheets;
            let ProjectReport { mapped, improved_by_ray, by_ray, by_nearest } = report;
            if origins.is_some() {
                assert_eq!((mapped, by_ray, by_nearest), (inner, 0, 0));
                assert!(improved_by_ray <= inner && (ray_reach > 0.0 || improved_by_ray == 0));
            } else {
                assert_eq!((mapped, improved_by_ray, by_ray + by_nearest), (0, 0, inner));
            }
        }
    }
}

#[test]
fn parts_that_pass_through_each_other_are_kept_apart() {
    let bed = Bed::new(&fixtures::crossing_boxes(2), |p| p, 3);
    let (component, n) = bed.surface.topology().components();
    assert_eq!(n, 2);
    for origins in [None, Some(bed.origins())] {
        let Domain { mesh, region, .. } = bed.project(origins, &ProjectOptions::default()).domain;
        for face in mesh.faces() {
            let parts = face.map(|v| component[region.points[v].face]);
            assert!(parts[0] == parts[1] && parts[1] == parts[2]);
        }
    }
}

#[test]
fn the_result_is_the_same_on_any_number_of_threads() {
    let bed = &beds(3)[1];
    let on = |threads: usize, origins: Option<Origins<'_>>| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bed.project(origins, &ProjectOptions::default()).domain.mesh)
    };
    for origins in [None, Some(bed.origins())] {
        assert_eq!(on(1, origins), on(2, origins));
    }
}

#[test]
fn origins_that_do_not_fit_are_refused() {
    let Bed { surface, base, finest } = Bed::new(&fixtures::icosphere(2), |p| p.normalize(), 1);
    let other = Bed::new(&fixtures::icosphere(4), |p| p.normalize(), 1).base;
    let origins = Some(Origins { base: &other, points: &finest.origins });
    let refused = project(&surface, &finest.domain, origins, &ProjectOptions::default()).unwrap_err();
    assert_eq!(refused, ProjectError::OtherMap);
    let too_few = IdVec::from_vec(finest.origins.as_slice()[1..].to_vec());
    let mut beyond = finest.origins.clone();
    beyond[VertexId(5)].face = FaceId(99_999);
    for (points, expected) in [
        (&too_few, RegionMapError::WrongSize { what: "origins", found: too_few.len(), expected: finest.origins.len() }),
        (&beyond, RegionMapError::Misattached(VertexId(5))),
    ] {
        let origins = Some(Origins { base: &base, points });
        let refused = project(&surface, &finest.domain, origins, &ProjectOptions::default()).unwrap_err();
        assert_eq!(refused, ProjectError::Region(expected));
    }
}

proptest! {
    #[test]
    fn any_origins_give_a_result_or_an_error(
        vertex in 0..42u32,
        face in prop_oneof![0..40u32, Just(u32::MAX)],
        weights in [weight(), weight(), weight()],
        ray_reach in weight(),
    ) {
        let Bed { surface, base, mut finest } = Bed::new(&fixtures::icosphere(1), |p| p.normalize(), 1);
        finest.origins[VertexId(vertex)] = SurfacePoint { face: FaceId(face), barycentric: weights.into() };
        let origins = Some(Origins { base: &base, points: &finest.origins });
        if let Ok(projected) = project(&surface, &finest.domain, origins, &ProjectOptions { ray_reach }) {
            projected.domain.check(surface.network()).unwrap();
        }
    }
}

/// Numbers that nobody thinks of.
fn weight() -> impl Strategy<Value = f64> {
    prop::sample::select(vec![0.0, 1.0, -1.0, 0.3, 1e300, f64::MAX, f64::NAN, f64::INFINITY, f64::NEG_INFINITY])
}
