//! Where domain vertices end up: on exact domains, on foreign ones, and on base meshes with their map.

use glam::DVec3;
use mesh_core::{FaceId, IdVec, SurfacePoint, Topology, TriMesh, VertexId};
use project::{Origins, ProjectError, ProjectOptions, ProjectReport, Projected, project};
use region_map::{ArcKind, Attachment, Network, RegionMap, RegionMapError, SheetId, SheetNormals, Surface};
use semireg::BaseStages;
use subdiv::SubdivDomain;

/// A working mesh with its creases and borders.
struct Shape {
    mesh: TriMesh,
    topology: Topology,
    network: Network,
    normals: SheetNormals,
}

impl Shape {
    fn new(mesh: TriMesh) -> Self {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let network = Network::trace(&mesh, &topology, &ArcKind::by_angle(&mesh, &topology, 40.0), |_| false, Vec::new());
        let normals = SheetNormals::new(&mesh, &topology, &network);
        Self { mesh, topology, network, normals }
    }

    fn surface(&self) -> Surface<'_> {
        Surface { mesh: &self.mesh, topology: &self.topology, network: &self.network, normals: &self.normals }
    }

    fn project(&self, domain: &TriMesh, region: &RegionMap) -> Projected {
        project(&self.surface(), domain, region, None, &ProjectOptions::default()).unwrap()
    }
}

/// The map of a foreign domain into a single sheet without arcs.
fn in_one_sheet(domain: &TriMesh) -> RegionMap {
    RegionMap {
        attachments: IdVec::filled(Attachment::Sheet(SheetId(0)), domain.n_vertices()),
        points: IdVec::filled(SurfacePoint::at_corner(FaceId(0), 0), domain.n_vertices()),
        sheet_of_face: IdVec::filled(SheetId(0), domain.n_faces()),
        spans: Default::default(),
    }
}

fn octahedron() -> TriMesh {
    let corners = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y, DVec3::Z, -DVec3::Z];
    let faces = (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]);
    TriMesh::new(corners.to_vec(), faces.collect()).unwrap()
}

/// The foreign domain subdivided, and its map.
fn foreign(domain: &TriMesh, levels: u32) -> SubdivDomain {
    subdiv::subdivide(domain, &in_one_sheet(domain), levels).unwrap()
}

fn n_flipped(mesh: &TriMesh, outwards: impl Fn(DVec3) -> DVec3) -> usize {
    mesh.faces().ids().filter(|&f| mesh.normal(f).dot(outwards(mesh.centroid(f))) <= 0.0).count()
}

#[test]
fn an_exact_domain_stays() {
    for mesh in [
        fixtures::cube(3),
        fixtures::plane(),
        fixtures::cylinder(0.5, 1.0, 16),
        fixtures::cone(1.0, 1.0, 16),
        fixtures::torus(1.0, 0.4, 24, 16),
        fixtures::shell(8),
        fixtures::crossing_boxes(2),
        fixtures::part(4),
    ] {
        let shape = Shape::new(mesh);
        let region = RegionMap::identity(&shape.topology, &shape.network);
        let domain = subdiv::subdivide(&shape.mesh, &region, 1).unwrap();
        let Projected { mesh, region, report } = shape.project(&domain.mesh, &domain.region);
        for v in mesh.positions().ids() {
            assert!(mesh.position(v).distance(domain.mesh.position(v)) < 1e-9 * shape.mesh.diagonal());
        }
        region.check(&Topology::new(mesh.faces(), mesh.n_vertices()).unwrap(), &shape.network).unwrap();
        assert_eq!(report.by_ray + report.by_nearest, region.class_counts()[2]);
    }
}

#[test]
fn an_octahedron_becomes_a_sphere() {
    let shape = Shape::new(fixtures::icosphere(24));
    let domain = foreign(&octahedron(), 4);
    let Projected { mesh, report, .. } = shape.project(&domain.mesh, &domain.region);
    assert_eq!(report, ProjectReport { by_ray: mesh.n_vertices(), ..ProjectReport::default() });
    // The facets of the working mesh lie below the sphere by less than this.
    let edge = shape.topology.ends(mesh_core::EdgeId(0)).map(|v| shape.mesh.position(v));
    let sagitta = 0.5 * edge[0].distance_squared(edge[1]);
    for p in mesh.positions() {
        assert!(p.length() <= 1.0 + 1e-12 && p.length() > 1.0 - sagitta, "{}", p.length());
    }
    assert_eq!(n_flipped(&mesh, |p| p), 0);
}

#[test]
fn a_thin_shell_is_not_jumped_through() {
    // Two sheets of spheres, one inside the other by 2 %: what belongs to one is put on it, from either side.
    let (outer, inner) = (fixtures::icosphere(16), fixtures::icosphere(16));
    let n = outer.n_vertices() as u32;
    let positions = outer.positions().iter().copied().chain(inner.positions().iter().map(|&p| 0.98 * p)).collect();
    let turned = inner.faces().iter().map(|&[a, b, c]| [a.0 + n, c.0 + n, b.0 + n]);
    let faces = outer.faces().iter().map(|f| f.map(|v| v.0)).chain(turned).collect();
    let shape = Shape::new(TriMesh::new(positions, faces).unwrap());
    assert_eq!(shape.network.n_sheets, 2);
    for start in [0.9, 0.985, 1.1] {
        let scaled = octahedron().positions().iter().map(|&p| start * p).collect();
        let domain = foreign(&octahedron().with_positions(scaled).unwrap(), 3);
        let Projected { mesh, region, .. } = shape.project(&domain.mesh, &domain.region);
        assert!(mesh.positions().iter().all(|p| p.length() > 0.99));
        assert!(region.points.iter().all(|p| (p.face.0 as usize) < outer.n_faces()));
    }
}

#[test]
fn a_ray_that_misses_or_hits_far_away_is_replaced_by_the_nearest_point() {
    let shape = Shape::new(fixtures::plane());
    let no_arcs =
        Network { arcs: IdVec::new(), arc_of_edge: IdVec::filled(None, shape.topology.n_edges()), ..shape.network.clone() };
    let surface = Surface { network: &no_arcs, ..shape.surface() };
    let placed = |at: DVec3| {
        let moved = octahedron().positions().iter().map(|&p| at + p).collect();
        let domain = foreign(&octahedron().with_positions(moved).unwrap(), 3);
        let Projected { mesh, report, .. } =
            project(&surface, &domain.mesh, &domain.region, None, &ProjectOptions::default()).unwrap();
        assert_eq!(report.by_ray + report.by_nearest, mesh.n_vertices());
        (domain.mesh, mesh, report)
    };
    // Beside the plane all rays miss.
    let (domain, mesh, report) = placed(DVec3::new(200.0, 30.0, 5.0));
    assert_eq!(report.by_ray, 0);
    let nearest = domain.positions().iter().map(|p| DVec3::new(100.0, p.y, 0.0));
    assert!(mesh.positions().iter().zip(nearest).all(|(p, q)| p.distance(q) < 1e-9));
    // Close above it the rays of the domain's sides graze it, and those from below look at its back.
    let (domain, mesh, report) = placed(DVec3::new(50.0, 30.0, 1.5));
    assert!(report.by_ray > 10 && report.by_nearest > mesh.n_vertices() / 2);
    for (p, from) in mesh.positions().iter().zip(domain.positions()) {
        assert!(p.z.abs() < 1e-9 && p.distance(*from) < 4.0 * from.z + 1e-9);
    }
}

/// The base mesh of a fixture with its map, subdivided.
fn domain_of(mesh: &TriMesh, base_vertices: usize, levels: u32) -> (BaseStages, SubdivDomain) {
    let options = semireg::Options { base_vertices: Some(base_vertices), ..semireg::Options::default() };
    let stages = semireg::base(&mesh.to_soup(), &options).unwrap().stages;
    let domain = subdiv::subdivide(&stages.base.mesh, &stages.base.region, levels).unwrap();
    (stages, domain)
}

/// No vertex leaves its corner, arc or sheet, and positions are those of the points.
fn check_places(surface: &Surface<'_>, projected: &Projected) {
    let size = surface.mesh.diagonal();
    for v in projected.mesh.positions().ids() {
        let (position, point) = (projected.mesh.position(v), projected.region.points[v]);
        assert!(point.position(surface.mesh).distance(position) < 1e-12 * size);
        match projected.region.attachments[v] {
            Attachment::Corner(c) => assert_eq!(position, surface.mesh.position(surface.network.corners[c])),
            Attachment::Arc { arc, t } => {
                assert!(surface.network.arcs[arc].position(surface.mesh, t).distance(position) < 1e-12 * size);
            }
            Attachment::Sheet(s) => assert_eq!(surface.network.sheet_of_face[point.face], s),
        }
    }
}

#[test]
fn with_a_map_and_without_no_vertex_leaves_its_place() {
    for mesh in [fixtures::part(6), fixtures::cylinder(0.5, 1.5, 32), fixtures::shell(16), fixtures::crossing_boxes(4)] {
        let (stages, domain) = domain_of(&mesh, 80, 2);
        let BaseStages { working, network, base, .. } = &stages;
        let normals = SheetNormals::new(&working.mesh, &working.topology, network);
        let surface = Surface { mesh: &working.mesh, topology: &working.topology, network, normals: &normals };
        let origins = Origins { base, points: &domain.origins };
        for (origins, ray_reach) in [(None, 0.5), (Some(origins), 0.0), (Some(origins), 0.5)] {
            let options = ProjectOptions { ray_reach };
            let projected = project(&surface, &domain.mesh, &domain.region, origins, &options).unwrap();
            check_places(&surface, &projected);
            let topology = Topology::new(projected.mesh.faces(), projected.mesh.n_vertices()).unwrap();
            projected.region.check(&topology, network).unwrap();
            let inner = projected.region.class_counts()[2];
            let ProjectReport { mapped, improved_by_ray, by_ray, by_nearest } = projected.report;
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
    let mesh = fixtures::crossing_boxes(4);
    let (stages, domain) = domain_of(&mesh, 60, 3);
    let BaseStages { working, network, base, .. } = &stages;
    let normals = SheetNormals::new(&working.mesh, &working.topology, network);
    let surface = Surface { mesh: &working.mesh, topology: &working.topology, network, normals: &normals };
    let (component, n) = working.topology.components();
    assert_eq!(n, 2);
    let origins = Origins { base, points: &domain.origins };
    for origins in [None, Some(origins)] {
        let projected = project(&surface, &domain.mesh, &domain.region, origins, &ProjectOptions::default()).unwrap();
        for face in projected.mesh.faces() {
            let parts = face.map(|v| component[projected.region.points[v].face]);
            assert!(parts[0] == parts[1] && parts[1] == parts[2]);
        }
    }
}

#[test]
fn the_result_is_the_same_on_any_number_of_threads() {
    let (stages, domain) = domain_of(&fixtures::cylinder(0.5, 1.5, 32), 60, 2);
    let BaseStages { working, network, base, .. } = &stages;
    let normals = SheetNormals::new(&working.mesh, &working.topology, network);
    let surface = Surface { mesh: &working.mesh, topology: &working.topology, network, normals: &normals };
    let on = |threads: usize, origins: Option<Origins<'_>>| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| project(&surface, &domain.mesh, &domain.region, origins, &ProjectOptions::default()).unwrap().mesh)
    };
    for origins in [None, Some(Origins { base, points: &domain.origins })] {
        assert_eq!(on(1, origins), on(2, origins));
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let shape = Shape::new(fixtures::icosphere(4));
    let octahedron = octahedron();
    let options = ProjectOptions::default();
    let mut region = in_one_sheet(&octahedron);
    region.attachments[VertexId(3)] = Attachment::Sheet(SheetId(1));
    let refused = project(&shape.surface(), &octahedron, &region, None, &options).unwrap_err();
    assert_eq!(refused, ProjectError::Region(RegionMapError::Misattached(VertexId(3))));

    let bow_tie = octahedron.faces().iter().step_by(4).map(|f| f.map(|v| v.0)).collect();
    let pinched = TriMesh::new(octahedron.positions().as_slice().to_vec(), bow_tie).unwrap();
    let refused = project(&shape.surface(), &pinched, &in_one_sheet(&pinched), None, &options).unwrap_err();
    assert!(matches!(refused, ProjectError::NotManifold(_)), "{refused}");

    let (stages, domain) = domain_of(&fixtures::icosphere(6), 12, 1);
    let BaseStages { working, network, base, .. } = &stages;
    let normals = SheetNormals::new(&working.mesh, &working.topology, network);
    let surface = Surface { mesh: &working.mesh, topology: &working.topology, network, normals: &normals };
    let too_few = IdVec::from_vec(domain.origins.as_slice()[1..].to_vec());
    let mut beyond = domain.origins.clone();
    beyond[VertexId(5)].face = FaceId(99_999);
    for (points, expected) in [
        (&too_few, RegionMapError::WrongSize { what: "origins", found: too_few.len(), expected: domain.origins.len() }),
        (&beyond, RegionMapError::Misattached(VertexId(5))),
    ] {
        let refused = project(&surface, &domain.mesh, &domain.region, Some(Origins { base, points }), &options).unwrap_err();
        assert_eq!(refused, ProjectError::Region(expected));
    }
}
