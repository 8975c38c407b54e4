//! Beds for the tests: a fine surface, and a coarse domain whose vertices are on it.

#![allow(unreachable_pub, reason = "a module that only tests see")]

use fit::{FitError, FitOptions, Fitted, fit};
use glam::DVec3;
use mesh_core::{EdgeId, FaceId, Id, IdVec, SurfaceIndex, SurfacePoint, Topology, TriMesh, VertexId};
use region_map::{ArcId, ArcKind, ArcSpan, Attachment, Network, RegionMap, SheetNormals, Surface};
use std::collections::BTreeMap;

pub struct Bed {
    pub mesh: TriMesh,
    pub mesh_topology: Topology,
    pub network: Network,
    pub normals: SheetNormals,
    pub domain: TriMesh,
    pub topology: Topology,
    pub map: RegionMap,
}

/// The arcs of a mesh: where it bends by this angle in degrees or more, and its border.
fn network_of(mesh: &TriMesh, topology: &Topology, bend: f64) -> Network {
    let kinds: IdVec<EdgeId, Option<ArcKind>> = topology
        .edge_ids()
        .map(|e| match topology.edge_faces(e) {
            (_, None) => Some(ArcKind::Border),
            (f, Some(g)) => (mesh.normal(f).angle_between(mesh.normal(g)) > bend.to_radians()).then_some(ArcKind::Sharp),
        })
        .collect();
    // Right angles along a chain are corners.
    let is_corner = |v: VertexId| {
        let ends: Vec<DVec3> = topology
            .one_ring(v)
            .filter(|&w| topology.find_edge(v, w).is_some_and(|e| kinds[e].is_some()))
            .map(|w| (mesh.position(w) - mesh.position(v)).normalize_or_zero())
            .collect();
        ends.len() == 2 && ends[0].dot(ends[1]) > -0.5
    };
    Network::trace(mesh, topology, &kinds, is_corner, vec![])
}

impl Bed {
    /// A surface, and as domain a coarse mesh of the same shape, subdivided, whose creases lie where those of the surface are.
    pub fn new(mesh: TriMesh, coarse: &TriMesh, levels: u32) -> Self {
        Self::with_creases(mesh, coarse, levels, 40.0)
    }

    /// A closed surface without creases.
    pub fn smooth(mesh: TriMesh, coarse: &TriMesh, levels: u32) -> Self {
        Self::with_creases(mesh, coarse, levels, 181.0)
    }

    fn with_creases(mesh: TriMesh, coarse: &TriMesh, levels: u32, bend: f64) -> Self {
        let mesh_topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let network = network_of(&mesh, &mesh_topology, bend);
        let normals = SheetNormals::new(&mesh, &mesh_topology, &network);
        let index = SurfaceIndex::new(&mesh);

        let coarse_topology = Topology::new(coarse.faces(), coarse.n_vertices()).unwrap();
        let coarse_network = network_of(coarse, &coarse_topology, bend);
        let mut map = RegionMap::identity(&coarse_topology, &coarse_network);
        // Sheets, arcs and corners of the coarse mesh are named by the surface's that lie there.
        let sheet = |f: FaceId| {
            let (middle, normal) = (coarse.centroid(f), coarse.normal(f));
            let facing = |g: FaceId| mesh.normal(g).dot(normal) > 0.9;
            network.sheet_of_face[index.closest_where(middle, facing).unwrap().face]
        };
        map.sheet_of_face = coarse.faces().ids().map(sheet).collect();
        let on_arc = |a: DVec3, b: DVec3| nearest_arc(&mesh, &network, a.midpoint(b));
        map.spans = BTreeMap::new();
        for e in coarse_topology.edge_ids().filter(|&e| coarse_network.is_barrier(e)) {
            let [a, b] = coarse_topology.ends(e);
            let ends = [a, b].map(|v| coarse.position(v));
            map.insert_span(a, b, span(&mesh, &network, on_arc(ends[0], ends[1]), ends));
        }
        for v in coarse.positions().ids() {
            let p = coarse.position(v);
            map.attachments[v] = match map.attachments[v] {
                Attachment::Corner(_) => {
                    let corner = network.corners.enumerate().find(|(_, w)| mesh.position(**w).distance(p) < 1e-9);
                    Attachment::Corner(corner.unwrap().0)
                }
                Attachment::Arc { .. } => {
                    let (key, span) = map.spans.iter().find(|(k, _)| k.contains(&v)).unwrap();
                    let t = if key[0] == v { span.from } else { span.to };
                    Attachment::Arc { arc: span.arc, t: network.arcs[span.arc].normalise(t) }
                }
                Attachment::Sheet(_) => Attachment::Sheet(map.sheet_of_face[coarse_topology.fan(v).next().unwrap().face()]),
            };
        }
        let fine = subdiv::subdivide(coarse, &map, levels).unwrap();
        let mut bed = Self {
            topology: Topology::new(fine.mesh.faces(), fine.mesh.n_vertices()).unwrap(),
            domain: fine.mesh,
            map: fine.region,
            mesh,
            mesh_topology,
            network,
            normals,
        };
        bed.project(&index);
        bed
    }

    fn project(&mut self, index: &SurfaceIndex) {
        for v in self.map.vertices() {
            self.map.points[v] = match self.map.attachments[v] {
                Attachment::Corner(c) => {
                    let h = self.mesh_topology.fan(self.network.corners[c]).next().unwrap();
                    SurfacePoint::at_corner(h.face(), h.corner())
                }
                Attachment::Arc { arc, t } => self.network.arcs[arc].point(&self.mesh_topology, t),
                Attachment::Sheet(sheet) => {
                    let inside = |f: FaceId| self.network.sheet_of_face[f] == sheet;
                    index.closest_where(self.domain.position(v), inside).unwrap().point()
                }
            };
        }
        let positions = self.map.points.iter().map(|p| p.position(&self.mesh)).collect();
        self.domain = self.domain.with_positions(positions).unwrap();
    }

    pub fn try_fit(&self, options: &FitOptions) -> Result<Fitted, FitError> {
        let Self { mesh, mesh_topology, network, normals, .. } = self;
        let surface = Surface { mesh, topology: mesh_topology, network, normals };
        fit(&surface, &self.domain, &self.topology, &self.map, options)
    }

    /// Fits and checks what always holds.
    pub fn fit(&self, options: &FitOptions) -> Fitted {
        let fitted = self.try_fit(options).unwrap();
        fitted.map.check(&self.topology, &self.network).unwrap();
        let index = [SurfaceIndex::new(&self.mesh), SurfaceIndex::new(&self.domain), SurfaceIndex::new(&fitted.mesh)];
        let greatest = |points: &TriMesh, to: usize| {
            let middles = points.faces().ids().map(|f| points.centroid(f));
            let points = points.positions().iter().copied().chain(middles);
            points.map(|p| index[to].closest(p).unwrap().distance).fold(0.0, f64::max)
        };
        let (before, after) =
            (greatest(&self.domain, 0).max(greatest(&self.mesh, 1)), greatest(&fitted.mesh, 0).max(greatest(&self.mesh, 2)));
        assert!(after <= 1.02 * before + 1e-12, "the greatest distance grows from {before} to {after}");
        assert!(fitted.report.end.max <= fitted.report.start.max);
        for (v, point) in fitted.map.points.enumerate() {
            let position = point.position(&self.mesh) + fitted.offsets[v] * self.normals.at(*point);
            match self.map.attachments[v] {
                Attachment::Sheet(_) => assert!(position.distance(fitted.mesh.position(v)) < 1e-12, "{v}"),
                _ => assert!(fitted.offsets[v] == 0.0 && fitted.mesh.position(v) == self.domain.position(v), "{v}"),
            }
        }
        for f in self.domain.faces().ids() {
            assert!(self.domain.normal(f).dot(fitted.mesh.normal(f)) > 0.0, "face {f} turns over");
        }
        fitted
    }
}

fn nearest_arc(mesh: &TriMesh, network: &Network, p: DVec3) -> ArcId {
    let distance = |arc: ArcId| {
        let positions = network.arcs[arc].vertices.iter().map(|&v| mesh.position(v)).collect::<Vec<_>>();
        let on = positions.windows(2).map(|w| w[0].lerp(w[1], mesh_core::closest_on_segment(p, w[0], w[1])).distance(p));
        on.fold(f64::INFINITY, f64::min)
    };
    network.arcs.ids().min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap()
}

/// The span of an edge between two positions on an arc; on a loop the shorter way round.
fn span(mesh: &TriMesh, network: &Network, arc: ArcId, ends: [DVec3; 2]) -> ArcSpan {
    let on = &network.arcs[arc];
    let at = |p: DVec3| {
        let vertex = (0..on.vertices.len()).min_by(|&i, &j| {
            let distance = |i: usize| mesh.position(on.vertices[i]).distance(p);
            distance(i).total_cmp(&distance(j))
        });
        on.lengths[vertex.unwrap()]
    };
    let [from, mut to] = ends.map(at);
    if on.is_loop() {
        to -= on.length() * ((to - from) / on.length()).round();
    }
    ArcSpan { arc, from, to }
}

/// A flat square of side 1 of `n` by `n` quads.
pub fn grid(n: u32) -> TriMesh {
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let positions = (0..=n).flat_map(|i| (0..=n).map(move |j| DVec3::new(f64::from(i), f64::from(j), 0.0) / f64::from(n)));
    let quads = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let faces = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    TriMesh::new(positions.collect(), faces.collect()).unwrap()
}

/// Every vertex off the border moved by up to `size` along z.
pub fn with_noise(mesh: &TriMesh, size: f64) -> TriMesh {
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let mut state = 1u64;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let moved = mesh.positions().enumerate().map(|(v, &p)| {
        let by = size * (2.0 * random() - 1.0);
        if topology.is_border_vertex(v) { p } else { p + by * DVec3::Z }
    });
    mesh.with_positions(moved.collect()).unwrap()
}

/// All bytes of a result that matter.
pub fn bytes(fitted: &Fitted) -> Vec<u64> {
    let points = fitted
        .map
        .points
        .iter()
        .flat_map(|p| [p.face.index() as u64].into_iter().chain(p.barycentric.to_array().map(f64::to_bits)));
    let positions = fitted.mesh.positions().iter().flat_map(|p| p.to_array().map(f64::to_bits));
    points.chain(positions).chain(fitted.offsets.iter().map(|h| h.to_bits())).collect()
}
