//! Base meshes with a long history get a map without one: the same mesh, exact round trips.

use basemesh::{BaseOptions, build};
use glam::{DVec2, DVec3};
use mesh_core::{EdgeId, FaceId, Id as _, SurfacePoint, Topology, TriMesh, equilateral_edge_length};
use region_map::{Attachment, BaseMesh, Cells, Sizing, Surface};
use segment_cvt::{CvtOptions, sample};
use trace_base::{TracedBase, retrace, trace};

struct Shape {
    surface: Surface,
}

impl Shape {
    fn new(mesh: TriMesh, base_vertices: usize) -> Self {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let base_edge_length = equilateral_edge_length(mesh.total_area(), base_vertices);
        let network = features::detect(&mesh, &topology, &[], base_edge_length, &Default::default()).unwrap();
        Self { surface: Surface::new(mesh, topology, network).unwrap() }
    }

    /// A base mesh by way of patches.
    fn base(&self, base_vertices: usize) -> BaseMesh {
        let (patches, _) = segment_vsa::segment(&self.surface, &Default::default()).unwrap();
        let cells = Cells::trace(&self.surface, &patches).unwrap();
        let sizing = Sizing::uniform(self.surface.mesh());
        let wanted = CvtOptions { base_vertices, ..Default::default() };
        let sites = sample(&self.surface, &cells, &sizing, &wanted).unwrap().sites;
        let options = BaseOptions { base_vertices, max_shrunk: 1.0, ..Default::default() };
        build(&self.surface, &cells, &sites, &sizing, &options).unwrap()
    }

    /// Retraces, and checks all that is promised.
    fn retraced(&self, base: &BaseMesh) -> BaseMesh {
        let new = retrace(&self.surface, base).unwrap();
        new.domain.check(self.surface.network()).unwrap();
        assert_eq!(new.mesh().faces(), base.mesh().faces());
        let (region, old) = (&new.domain.region, &base.domain.region);
        assert_eq!(region.sheet_of_face, old.sheet_of_face);
        assert_eq!(region.spans, old.spans);
        assert_eq!(region.attachments, old.attachments);
        self.check_points(&new, base);
        self.check_map(&new);
        new
    }

    /// Corners and vertices on arcs stay to the last bit, the others unless they are beside a working edge.
    fn check_points(&self, new: &BaseMesh, base: &BaseMesh) {
        let topology = self.surface.topology();
        let longest = topology.edge_ids().map(|e| topology.ends(e)).map(|[a, b]| self.surface.mesh().distance(a, b));
        let near = 2e-3 * longest.fold(0.0, f64::max);
        for v in base.domain.region.vertices() {
            let moved = new.mesh().position(v).distance(base.mesh().position(v));
            let may_move = matches!(base.domain.region.attachments[v], Attachment::Sheet(_));
            assert!(moved <= if may_move { near } else { 0.0 }, "{v} by {moved}");
        }
    }

    fn check_map(&self, new: &BaseMesh) {
        assert_eq!((new.map.n_edits(), new.map.charts().len()), (0, new.mesh().n_faces()));
        assert!(new.round_trip_error(self.surface.mesh(), 1000) < 1e-9);
        // The charts cover the surface once.
        let area = |f: &region_map::ChartFace| {
            let corners = f.barycentric.map(|b| SurfacePoint { face: f.source, barycentric: b }.position(self.surface.mesh()));
            mesh_core::area(corners)
        };
        let covered: f64 = new.map.charts().iter().flat_map(|c| c.faces()).map(area).sum();
        assert!((covered / self.surface.mesh().total_area() - 1.0).abs() < 1e-9);
        for f in new.mesh().faces().ids() {
            for (corner, w) in [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate() {
                let at = new.locate(f, w).position(self.surface.mesh());
                assert!(at.distance(new.mesh().position(new.mesh().face(f)[corner])) < 1e-9 * self.surface.mesh().diagonal());
            }
            let middle = new.locate(f, DVec3::ONE / 3.0);
            assert_eq!(self.surface.network().sheet_of_face[middle.face], new.domain.region.sheet_of_face[f]);
        }
    }

    fn farthest_apart(&self, a: &BaseMesh, b: &BaseMesh) -> f64 {
        let at = |base: &BaseMesh, f| base.locate(f, DVec3::new(0.2, 0.3, 0.5)).position(self.surface.mesh());
        a.mesh().faces().ids().map(|f| at(a, f).distance(at(b, f))).fold(0.0, f64::max)
    }
}

/// Flips every edge between two faces of a sheet and back, each time in another flat quad: the same base mesh, a map that winds.
fn scrambled(mut base: BaseMesh, rounds: usize) -> BaseMesh {
    let topology = base.domain.topology.clone();
    for i in 0..rounds * topology.n_edges() {
        let h = topology.halfedge(EdgeId::new(i % topology.n_edges()));
        let Some(t) = topology.twin(h).filter(|_| base.domain.region.span(topology.from(h), topology.to(h)).is_none()) else {
            continue;
        };
        // The edge from a to b, c on its left and d on its right.
        let quad = |skew: f64| [DVec2::ZERO, DVec2::new(1.0, skew), DVec2::new(0.3 + skew, 0.8), DVec2::new(0.6, -0.7 - skew)];
        // A face of the map has the order of corners of its base face.
        let turned = |layout: [DVec2; 3], first: usize| [0, 1, 2].map(|c| layout[(c + 3 - first) % 3]);
        let [a, b, c, d] = quad(0.2);
        let own = [(h, [a, b, c]), (t, [b, a, d])].map(|(h, layout)| (base.map_faces[h.face()], turned(layout, h.corner())));
        let flipped = base.map.replace(&own, &[[d, b, c], [c, a, d]]).unwrap();
        let [a, b, c, d] = quad(-0.2);
        let other = [(flipped[0], [d, b, c]), (flipped[1], [c, a, d])];
        let back = [(h, [a, b, c]), (t, [b, a, d])];
        let made = base.map.replace(&other, &back.map(|(h, layout)| turned(layout, h.corner()))).unwrap();
        back.iter().zip(made).for_each(|((h, _), new)| base.map_faces[h.face()] = new);
    }
    base
}

#[test]
fn base_meshes_of_patches() {
    for (mesh, n) in [
        (fixtures::cube(8), 60),
        (fixtures::torus(1.0, 0.4, 40, 20), 50),
        (fixtures::cylinder(0.5, 1.5, 48), 60),
        (fixtures::l_block(5), 80),
    ] {
        let shape = Shape::new(mesh, n);
        let base = shape.base(n);
        assert!(base.map.n_edits() > 0);
        let new = shape.retraced(&base);
        // Once more changes little: the map is where its edges were.
        assert!(
            shape.farthest_apart(&shape.retraced(&new), &new)
                < 0.3 * equilateral_edge_length(shape.surface.mesh().total_area(), n)
        );
    }
}

#[test]
fn a_history_that_winds_is_forgotten() {
    for (mesh, coarse) in [
        (fixtures::torus(1.0, 0.4, 40, 20), fixtures::torus(1.0, 0.4, 7, 5)),
        (fixtures::icosphere(14), fixtures::icosphere(2)),
        (fixtures::cube(9), fixtures::cube(3)),
    ] {
        let shape = Shape::new(mesh, coarse.n_vertices());
        let TracedBase::Mapped(first) = trace(&shape.surface, &coarse).unwrap().base else { panic!("no map") };
        let (mild, wild) = (scrambled(first.clone(), 1), scrambled(first.clone(), 6));
        let edge = equilateral_edge_length(shape.surface.mesh().total_area(), coarse.n_vertices());
        assert!(shape.farthest_apart(&wild, &first) > edge);
        assert!(shape.farthest_apart(&shape.retraced(&mild), &first) < 0.25 * edge);
        assert!(shape.farthest_apart(&shape.retraced(&wild), &first) < 0.25 * edge);
    }
}

#[test]
fn the_same_map_on_any_number_of_threads() {
    let shape = Shape::new(fixtures::torus(1.0, 0.4, 40, 20), 60);
    let base = shape.base(60);
    let points = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let new = pool.install(|| shape.retraced(&base));
        let at = |f: FaceId| new.locate(f, DVec3::new(0.2, 0.3, 0.5)).position(shape.surface.mesh());
        new.mesh().faces().ids().map(at).collect::<Vec<_>>()
    };
    assert_eq!(points(1), points(4));
}
