//! Where domain vertices end up: on exact domains, on foreign ones, and on base meshes with their map.

use glam::DVec3;
use mesh_core::{FaceId, IdVec, SurfacePoint, TriMesh, VertexId};
use project::{ProjectError, ProjectOptions, ProjectReport, Projected, project, project_refined};
use region_map::{Attachment, Domain, Network, RegionMap, RegionMapError, SheetId, Surface};

/// A foreign domain in a single sheet without arcs.
fn in_one_sheet(mesh: TriMesh) -> Domain {
    let region = RegionMap {
        attachments: IdVec::filled(Attachment::Sheet(SheetId(0)), mesh.n_vertices()),
        points: IdVec::filled(SurfacePoint::at_corner(FaceId(0), 0), mesh.n_vertices()),
        sheet_of_face: IdVec::filled(SheetId(0), mesh.n_faces()),
        spans: Default::default(),
    };
    Domain::new(mesh, region).unwrap()
}

fn octahedron() -> TriMesh {
    let corners = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y, DVec3::Z, -DVec3::Z];
    let faces = (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]);
    TriMesh::new(corners.to_vec(), faces.collect()).unwrap()
}

/// The foreign domain subdivided.
fn foreign(mesh: TriMesh, levels: u32) -> Domain {
    subdiv::subdivide(&in_one_sheet(mesh), levels).unwrap().domain
}

fn projected(surface: &Surface, domain: &Domain) -> Projected {
    project(surface, domain, None, &ProjectOptions::default()).unwrap()
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
        let surface = Surface::with_creases(mesh, 40.0).unwrap();
        let finest = subdiv::subdivide(&Domain::identity(&surface), 1).unwrap().domain;
        let Projected { domain, report } = projected(&surface, &finest);
        for v in finest.mesh.positions().ids() {
            assert!(domain.mesh.position(v).distance(finest.mesh.position(v)) < 1e-9 * surface.mesh().diagonal());
        }
        domain.check(surface.network()).unwrap();
        assert_eq!(report.by_ray + report.by_nearest, domain.region.class_counts().in_sheets);
    }
}

#[test]
fn an_octahedron_becomes_a_sphere() {
    let surface = Surface::smooth(fixtures::icosphere(24)).unwrap();
    let Projected { domain: Domain { mesh, .. }, report } = projected(&surface, &foreign(octahedron(), 4));
    assert_eq!(report, ProjectReport { by_ray: mesh.n_vertices(), ..ProjectReport::default() });
    // The facets of the working mesh lie below the sphere by less than this.
    let edge = surface.topology().ends(mesh_core::EdgeId(0)).map(|v| surface.mesh().position(v));
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
    let surface = Surface::smooth(TriMesh::new(positions, faces).unwrap()).unwrap();
    assert_eq!(surface.network().n_sheets, 2);
    for start in [0.9, 0.985, 1.1] {
        let scaled = octahedron().positions().iter().map(|&p| start * p).collect();
        let domain = foreign(octahedron().with_positions(scaled).unwrap(), 3);
        let Domain { mesh, region, .. } = projected(&surface, &domain).domain;
        assert!(mesh.positions().iter().all(|p| p.length() > 0.99));
        assert!(region.points.iter().all(|p| (p.face.0 as usize) < outer.n_faces()));
    }
}

#[test]
fn a_ray_that_misses_or_hits_far_away_is_replaced_by_the_nearest_point() {
    let plane = Surface::smooth(fixtures::plane()).unwrap();
    let n_edges = plane.topology().n_edges();
    let no_arcs = Network { arcs: IdVec::new(), arc_of_edge: IdVec::filled(None, n_edges), ..plane.network().clone() };
    let surface = plane.with_network(no_arcs).unwrap();
    let placed = |at: DVec3| {
        let moved = octahedron().positions().iter().map(|&p| at + p).collect();
        let finest = foreign(octahedron().with_positions(moved).unwrap(), 3);
        let Projected { domain, report } = projected(&surface, &finest);
        assert_eq!(report.by_ray + report.by_nearest, domain.mesh.n_vertices());
        (finest.mesh, domain.mesh, report)
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

#[test]
fn what_does_not_fit_is_refused() {
    let surface = Surface::smooth(fixtures::icosphere(4)).unwrap();
    let mut domain = in_one_sheet(octahedron());
    domain.region.attachments[VertexId(3)] = Attachment::Sheet(SheetId(1));
    let refused = project(&surface, &domain, None, &ProjectOptions::default()).unwrap_err();
    assert_eq!(refused, ProjectError::Region(RegionMapError::Misattached(VertexId(3))));
    let small = Domain { mesh: fixtures::plane(), ..in_one_sheet(octahedron()) };
    let refused = project(&surface, &small, None, &ProjectOptions::default()).unwrap_err();
    assert!(matches!(refused, ProjectError::Region(RegionMapError::WrongSize { what: "the mesh", .. })), "{refused}");
}

/// The new vertices of a relaxed level go to the middle of their edges over the surface, old ones stay, and those on arcs are on their arcs.
#[test]
fn a_level_more_is_placed_from_the_one_before() {
    let sphere = Surface::smooth(fixtures::icosphere(8)).unwrap();
    let cylinder = Surface::with_creases(fixtures::cylinder(1.0, 2.0, 48), 40.0).unwrap();
    for surface in [sphere, cylinder] {
        let coarse = Domain::identity(&surface);
        let finer = subdiv::subdivide(&coarse, 1).unwrap().domain;
        let projected = project_refined(&surface, &coarse, &finer).unwrap().domain;
        projected.check(surface.network()).unwrap();
        for v in finer.region.vertices() {
            let (linear, placed) = (finer.mesh.position(v), projected.mesh.position(v));
            // The domain is the surface itself: the middle of an edge is on it. A walk that begins at a corner loses a little of its length.
            assert!(linear.distance(placed) < 1e-3, "{v}: {linear} went to {placed}");
        }
    }
}

/// Two sheets of one part close together, folded like a U: a walk stays on its side, where the nearest point is on the other one.
#[test]
fn new_vertices_stay_on_their_side() {
    // A strip from x = 0 to 4 at z = 0, around the end and back at z = 0.01.
    let rows = [[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [4.0, 0.01], [2.0, 0.01], [0.0, 0.01]];
    let positions: Vec<[f64; 3]> = rows.iter().flat_map(|&[x, z]| [[x, 0.0, z], [x, 1.0, z], [x, 2.0, z]]).collect();
    let quad = |i: u32, j: u32| {
        let [a, b, c, d] = [3 * i + j, 3 * (i + 1) + j, 3 * (i + 1) + j + 1, 3 * i + j + 1];
        [[a, b, c], [a, c, d]]
    };
    let faces: Vec<[u32; 3]> = (0..5).flat_map(|i| (0..2).flat_map(move |j| quad(i, j))).collect();
    let surface = Surface::smooth(TriMesh::from_slices(&positions, &faces).unwrap()).unwrap();
    let coarse = Domain::identity(&surface);
    let mut finer = subdiv::subdivide(&coarse, 1).unwrap().domain;
    // The middles sag towards the other side, beyond the half of the way.
    let sagging = finer.mesh.positions().enumerate().map(|(v, p)| {
        let is_new = v.0 as usize >= coarse.mesh.n_vertices();
        if is_new && p.z == 0.0 { *p + 0.008 * DVec3::Z } else { *p }
    });
    finer.mesh = finer.mesh.with_positions(sagging.collect()).unwrap();
    let projected = project_refined(&surface, &coarse, &finer).unwrap().domain;
    // Those with an end inside the sheet: y = 1 is its middle.
    let inner = finer.region.vertices().filter(|&v| {
        let p = finer.mesh.position(v);
        p.z == 0.008 && matches!(finer.region.attachments[v], Attachment::Sheet(_)) && p.x < 3.0 && p.y < 1.4
    });
    let heights: Vec<f64> = inner.map(|v| projected.mesh.position(v).z).collect();
    assert!(heights.len() >= 3 && heights.iter().all(|&z| z == 0.0), "{heights:?}");
}
