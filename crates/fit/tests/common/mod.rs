//! Beds for the tests: a fine surface, and a coarse domain whose vertices are on it.

#![allow(unreachable_pub, reason = "a module that only tests see")]

use fit::{FitOptions, Fitted, fit_holding};
use glam::DVec3;
use mesh_core::{FaceId, Id, SurfaceIndex, SurfacePoint, Topology, TriMesh, VertexId};
use region_map::{ArcId, ArcKind, ArcSpan, Attachment, Domain, Network, Surface};
use std::collections::BTreeMap;

pub struct Bed {
    pub surface: Surface,
    pub domain: Domain,
}

/// A surface whose arcs are its border and the edges where it bends by more than this angle in degrees.
fn surface_of(mesh: TriMesh, bend: f64) -> Surface {
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let kinds = ArcKind::by_angle(&mesh, &topology, bend);
    // Right angles along a chain are corners.
    let is_corner = |v: VertexId| {
        let ends: Vec<DVec3> = topology
            .one_ring(v)
            .filter(|&w| topology.find_edge(v, w).is_some_and(|e| kinds[e].is_some()))
            .map(|w| (mesh.position(w) - mesh.position(v)).normalize_or_zero())
            .collect();
        ends.len() == 2 && ends[0].dot(ends[1]) > -0.5
    };
    let network = Network::trace(&mesh, &topology, &kinds, is_corner, vec![]).unwrap();
    Surface::new(mesh, topology, network).unwrap()
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
        let surface = surface_of(mesh, bend);
        let (mesh, network) = (surface.mesh(), surface.network());
        let coarse_surface = surface_of(coarse.clone(), bend);
        let mut domain = Domain::identity(&coarse_surface);
        let map = &mut domain.region;
        // Sheets, arcs and corners of the coarse mesh are named by the surface's that lie there.
        let sheet = |f: FaceId| {
            let (middle, normal) = (coarse.centroid(f), coarse.normal(f));
            let facing = |g: FaceId| mesh.normal(g).dot(normal) > 0.9;
            network.sheet_of_face[surface.index().closest_where(middle, facing).unwrap().face]
        };
        map.sheet_of_face = coarse.faces().ids().map(sheet).collect();
        let on_arc = |a: DVec3, b: DVec3| nearest_arc(mesh, network, a.midpoint(b));
        map.spans = BTreeMap::new();
        for e in domain.topology.edge_ids().filter(|&e| coarse_surface.network().is_barrier(e)) {
            let [a, b] = domain.topology.ends(e);
            let ends = [a, b].map(|v| coarse.position(v));
            map.insert_span(a, b, span(mesh, network, on_arc(ends[0], ends[1]), ends));
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
                Attachment::Sheet(_) => Attachment::Sheet(map.sheet_of_face[domain.topology.fan(v).next().unwrap().face()]),
            };
        }
        let finest = subdiv::subdivide(&domain, levels).unwrap().domain;
        Self { domain: projected(&surface, &finest), surface }
    }

    pub fn fit(&self, options: &FitOptions) -> Fitted {
        self.fit_holding(&[], options)
    }

    /// Fits and checks what always holds.
    pub fn fit_holding(&self, still: &[FaceId], options: &FitOptions) -> Fitted {
        let Self { surface, domain } = self;
        let fitted = fit_holding(surface, domain, still, options).unwrap();
        fitted.domain.check(surface.network()).unwrap();
        let (input, start, end) = (surface.mesh(), &domain.mesh, &fitted.domain.mesh);
        let index = [input, start, end].map(SurfaceIndex::new);
        let greatest = |points: &TriMesh, to: usize| {
            let middles = points.faces().ids().map(|f| points.centroid(f));
            let points = points.positions().iter().copied().chain(middles);
            points.map(|p| index[to].closest(p).unwrap().distance).fold(0.0, f64::max)
        };
        let (before, after) = (greatest(start, 0).max(greatest(input, 1)), greatest(end, 0).max(greatest(input, 2)));
        assert!(after <= 1.02 * before + 1e-12, "the greatest distance grows from {before} to {after}");
        assert!(fitted.report.end.max <= fitted.report.start.max);
        for (v, point) in fitted.domain.region.points.enumerate() {
            let position = point.position(input) + fitted.offsets[v] * surface.normals().at(*point);
            match domain.region.attachments[v] {
                Attachment::Sheet(_) => assert!(position.distance(end.position(v)) < 1e-12, "{v}"),
                _ => assert!(fitted.offsets[v] == 0.0 && end.position(v) == start.position(v), "{v}"),
            }
        }
        for f in start.faces().ids() {
            assert!(start.normal(f).dot(end.normal(f)) > 0.0, "face {f} turns over");
        }
        fitted
    }
}

/// The domain with every vertex at its corner, at its place on its arc, or at the nearest point of its sheet.
fn projected(surface: &Surface, domain: &Domain) -> Domain {
    let (topology, network) = (surface.topology(), surface.network());
    let mut region = domain.region.clone();
    for v in region.vertices() {
        region.points[v] = match region.attachments[v] {
            Attachment::Corner(c) => {
                let h = topology.fan(network.corners[c]).next().unwrap();
                SurfacePoint::at_corner(h.face(), h.corner())
            }
            Attachment::Arc { arc, t } => network.arcs[arc].point(topology, t),
            Attachment::Sheet(sheet) => surface.sheet_index(sheet).unwrap().closest(domain.mesh.position(v)).unwrap().point(),
        };
    }
    domain.placed(surface, region).unwrap()
}

fn nearest_arc(mesh: &TriMesh, network: &Network, p: DVec3) -> ArcId {
    let distance = |arc: ArcId| {
        let positions = network.arcs[arc].vertices.iter().map(|&v| mesh.position(v)).collect::<Vec<_>>();
        positions.windows(2).map(|w| mesh_core::distance_to_segment(p, w[0], w[1])).fold(f64::INFINITY, f64::min)
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
    let Domain { mesh, region, .. } = &fitted.domain;
    let bits = |p: &SurfacePoint| [p.face.index() as u64].into_iter().chain(p.barycentric.to_array().map(f64::to_bits));
    let points = region.points.iter().flat_map(bits);
    let positions = mesh.positions().iter().flat_map(|p| p.to_array().map(f64::to_bits));
    points.chain(positions).chain(fitted.offsets.iter().map(|h| h.to_bits())).collect()
}
