//! Counts, order, attachments and origins of subdivided meshes: meshes of every topology, each as its own base.

use glam::DVec3;
use mesh_core::{FaceId, IdVec, TriMesh, VertexId};
use region_map::{Attachment, ClassCounts, Domain, RegionMap, RegionMapError, SheetId, Surface};
use subdiv::{SubdivDomain, SubdivError, subdivide};

/// A base mesh with the network of its own borders and creases.
struct Base {
    name: &'static str,
    surface: Surface,
    domain: Domain,
}

impl Base {
    fn new(name: &'static str, mesh: TriMesh) -> Self {
        let surface = Surface::with_creases(mesh, 40.0).unwrap();
        Self { name, domain: Domain::identity(&surface), surface }
    }

    fn mesh(&self) -> &TriMesh {
        &self.domain.mesh
    }

    fn subdivided(&self, levels: u32) -> SubdivDomain {
        subdivide(&self.domain, levels).unwrap()
    }
}

fn bases() -> Vec<Base> {
    vec![
        Base::new("triangles", fixtures::plane()),
        Base::new("cube", fixtures::cube(1)),
        Base::new("L", fixtures::l_block(1)),
        Base::new("cylinder", fixtures::cylinder(1.0, 1.0, 8)),
        Base::new("cone", fixtures::cone(1.0, 1.0, 8)),
        Base::new("sphere", fixtures::icosphere(2)),
        Base::new("torus", fixtures::torus(1.0, 0.4, 12, 10)),
        Base::new("shell", fixtures::shell(8)),
        Base::new("two boxes", fixtures::crossing_boxes(1)),
        Base::new("brick", fixtures::brick(8)),
    ]
}

/// Vertices, Euler number, border edges and faces of every component.
fn component_counts(Domain { mesh, topology, .. }: &Domain) -> Vec<[i64; 4]> {
    let (component, n) = topology.components();
    let of = |v| topology.fan(v).next().map(|h| component[h.face()] as usize);
    let mut counts = vec![[0; 4]; n];
    mesh.positions().ids().filter_map(of).for_each(|c| counts[c][0] += 1);
    mesh.faces().ids().for_each(|f| counts[component[f] as usize][3] += 1);
    let mut n_edges = vec![0; n];
    for e in topology.edge_ids() {
        let c = component[topology.edge_faces(e).0] as usize;
        n_edges[c] += 1;
        counts[c][2] += i64::from(topology.is_border_edge(e));
    }
    for (c, e) in counts.iter_mut().zip(n_edges) {
        c[1] = c[0] - e + c[3];
    }
    counts
}

#[test]
fn counts_follow_the_formula_in_every_component() {
    for base in bases() {
        let coarse = component_counts(&base.domain);
        for levels in 0..4 {
            let (four, two) = (4i64.pow(levels), 2i64.pow(levels));
            let expected: Vec<_> =
                coarse.iter().map(|&[v, x, b, f]| [four * (v - x) + x - (four - two) * b / 2, x, two * b, four * f]).collect();
            assert_eq!(component_counts(&base.subdivided(levels).domain), expected, "{} at level {levels}", base.name);
        }
    }
}

#[test]
fn children_are_in_the_order_of_the_contract() {
    for base in bases() {
        let Domain { mesh, .. } = base.subdivided(1).domain;
        for f in base.mesh().faces().ids() {
            let [a, b, c] = base.mesh().face(f);
            let [pa, pb, pc] = base.mesh().triangle(f);
            let child = |k: u32| mesh.face(FaceId(4 * f.0 + k));
            let [bc, ca, ab] = child(3);
            let middles = [pb.midpoint(pc), pc.midpoint(pa), pa.midpoint(pb)];
            assert_eq!([bc, ca, ab].map(|v| mesh.position(v)), middles, "{}", base.name);
            assert_eq!([child(0), child(1), child(2)], [[a, ab, ca], [b, bc, ab], [c, ca, bc]], "{}", base.name);
        }
    }
}

#[test]
fn levels_are_prefixes_and_can_be_done_one_by_one() {
    for base in bases() {
        let mut step = base.subdivided(0).domain;
        assert_eq!(&step.mesh, base.mesh());
        for level in 1..4 {
            let next = subdivide(&step, 1).unwrap().domain;
            let n = step.mesh.n_vertices();
            assert_eq!(&next.mesh.positions().as_slice()[..n], step.mesh.positions().as_slice(), "{}", base.name);
            assert_eq!(&next.region.attachments.as_slice()[..n], step.region.attachments.as_slice(), "{}", base.name);
            let whole = base.subdivided(level);
            assert_eq!((whole.level, &whole.domain.mesh), (level, &next.mesh), "{}", base.name);
            assert_eq!(whole.domain.region.spans, next.region.spans, "{}", base.name);
            step = next;
        }
    }
}

#[test]
fn vertices_lie_where_their_attachments_and_origins_say() {
    for base in bases() {
        let size = base.mesh().diagonal();
        let SubdivDomain { domain, origins, level } = base.subdivided(3);
        let (network, Domain { mesh, region, .. }) = (base.surface.network(), &domain);
        domain.check(network).unwrap_or_else(|e| panic!("{}: {e}", base.name));
        for v in mesh.positions().ids() {
            let position = mesh.position(v);
            assert!(origins[v].position(base.mesh()).distance(position) < 1e-14 * size, "{} {v}", base.name);
            match region.attachments[v] {
                Attachment::Corner(c) => assert_eq!(base.mesh().position(network.corners[c]), position),
                Attachment::Arc { arc, t } => {
                    assert!(network.arcs[arc].position(base.mesh(), t).distance(position) < 1e-9 * size, "{} {v}", base.name);
                }
                Attachment::Sheet(s) => assert_eq!(network.sheet_of_face[origins[v].face], s),
            }
        }
        for (f, &sheet) in region.sheet_of_face.enumerate() {
            assert_eq!(network.sheet_of_face[FaceId(f.0 >> (2 * level))], sheet);
        }
        // 2^3 spans for every base edge on an arc, as long as it all together.
        assert_eq!(region.spans.len(), base.domain.region.spans.len() << level);
        let on_arcs = region.class_counts().on_arcs;
        let n_edges = base.domain.region.spans.len();
        assert_eq!(on_arcs, base.domain.region.class_counts().on_arcs + n_edges * ((1 << level) - 1));
        assert_eq!(origins.len(), mesh.n_vertices());
    }
}

#[test]
fn two_corners_may_be_joined_across_a_sheet() {
    // The diagonals of a cube's sides join corners, but their middles are inside the sides.
    let base = Base::new("cube", fixtures::cube(1));
    let counts = base.subdivided(1).domain.region.class_counts();
    assert_eq!(counts, ClassCounts { at_corners: 8, on_arcs: 12, in_sheets: 6 });
}

/// All of it in one sheet without arcs.
fn in_one_sheet(mesh: TriMesh) -> Domain {
    let region = RegionMap {
        attachments: IdVec::filled(Attachment::Sheet(SheetId(0)), mesh.n_vertices()),
        points: IdVec::filled(mesh_core::SurfacePoint::at_corner(FaceId(0), 0), mesh.n_vertices()),
        sheet_of_face: IdVec::filled(SheetId(0), mesh.n_faces()),
        spans: Default::default(),
    };
    Domain::new(mesh, region).unwrap()
}

#[test]
fn a_vertex_without_faces_stays_without() {
    let mut positions = fixtures::plane().positions().as_slice().to_vec();
    positions.push(DVec3::Z);
    let mesh = TriMesh::new(positions, fixtures::plane().faces().iter().map(|f| f.map(|v| v.0)).collect()).unwrap();
    let SubdivDomain { domain, origins, .. } = subdivide(&in_one_sheet(mesh), 2).unwrap();
    assert_eq!((domain.mesh.n_vertices(), origins.len()), (26, 26));
    assert!(domain.topology.fan(VertexId(4)).next().is_none());
}

#[test]
fn what_does_not_fit_is_refused() {
    let base = Base::new("cube", fixtures::cube(1));
    // 36 * 4^13 halfedges fit in 32 bits, 36 * 4^14 don't; beyond 4^31 even the count would overflow.
    for levels in [14, 20, 31, 32, u32::MAX] {
        let refused = subdivide(&base.domain, levels).unwrap_err();
        assert_eq!(refused, SubdivError::TooLarge { faces: 12, levels });
    }
    let other = Base::new("L", fixtures::l_block(1));
    for levels in [0, 1] {
        let refused = subdivide(&Domain { region: other.domain.region.clone(), ..base.domain.clone() }, levels).unwrap_err();
        assert!(matches!(refused, SubdivError::Region(RegionMapError::WrongSize { what: "attachments", .. })), "{refused}");
        let refused = subdivide(&Domain { mesh: other.mesh().clone(), ..base.domain.clone() }, levels).unwrap_err();
        assert!(matches!(refused, SubdivError::Region(RegionMapError::WrongSize { what: "the mesh", .. })), "{refused}");
    }
    let far = fixtures::cube(1).positions().iter().map(|p| p * f64::MAX).collect();
    let huge = fixtures::cube(1).with_positions(far).unwrap();
    let refused = subdivide(&Domain { mesh: huge, ..base.domain }, 1).unwrap_err();
    assert!(matches!(refused, SubdivError::NotFinite(_)), "{refused}");
    let nothing = in_one_sheet(TriMesh::new(vec![], vec![]).unwrap());
    assert_eq!(subdivide(&nothing, 30).unwrap().domain.mesh.n_faces(), 0);
}
