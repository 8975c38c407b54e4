//! Beds for the tests: a working mesh, and a subdivided domain that lies on it.

#![allow(unreachable_pub, dead_code, reason = "a module that only tests see, and not each of them all of it")]

use glam::DVec3;
use mesh_core::{FaceId, Id, IdVec, SurfacePoint, TriMesh, VertexId, walk};
use region_map::{ArcId, ArcSpan, Attachment, CornerId, Domain, RegionMap, Surface};
use relax::{RelaxError, RelaxOptions, Relaxed, relax, relax_holding};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

#[derive(Clone)]
pub struct Bed {
    pub surface: Surface,
    pub domain: Domain,
}

impl Bed {
    /// A working mesh with arcs where it bends by 40 degrees or more, and on its border; still without a domain.
    pub fn on(mesh: TriMesh) -> Self {
        let surface = Surface::with_creases(mesh, 40.0).unwrap();
        let region =
            RegionMap { attachments: IdVec::new(), points: IdVec::new(), sheet_of_face: IdVec::new(), spans: BTreeMap::new() };
        Self { surface, domain: Domain::new(TriMesh::new(vec![], vec![]).unwrap(), region).unwrap() }
    }

    /// With base faces between vertices at these places, subdivided.
    pub fn with_base(mut self, places: Vec<Place>, spans: Vec<(u32, u32, ArcSpan)>, faces: Vec<[u32; 3]>, levels: usize) -> Self {
        let mut region = self.domain.region;
        let (topology, network) = (self.surface.topology(), self.surface.network());
        for place in places {
            let (attachment, point) = match place {
                Place::Corner(c) => {
                    let h = topology.fan(network.corners[c]).next().unwrap();
                    (Attachment::Corner(c), SurfacePoint::at_corner(h.face(), h.corner()))
                }
                Place::Arc(arc, t) => (Attachment::Arc { arc, t }, network.arcs[arc].point(topology, t)),
                Place::Near(p) => {
                    let point = self.surface.index().closest(p).unwrap().point();
                    (Attachment::Sheet(network.sheet_of_face[point.face]), point)
                }
            };
            region.attachments.push(attachment);
            region.points.push(point);
        }
        for (a, b, span) in spans {
            region.insert_span(VertexId(a), VertexId(b), span);
        }
        let mesh = TriMesh::new(region.points.iter().map(|p| p.position(self.surface.mesh())).collect(), faces).unwrap();
        let sheet_near = |p: DVec3| network.sheet_of_face[self.surface.index().closest(p).unwrap().face];
        region.sheet_of_face = mesh.faces().ids().map(|f| sheet_near(mesh.centroid(f))).collect();
        self.domain = Domain::new(mesh, region).unwrap();
        for _ in 0..levels {
            self.subdivide();
        }
        self
    }

    /// Splits every face in four in the contract's order. Midpoints on arcs go to the mean arc length, others to the closest
    /// point of their sheet.
    fn subdivide(&mut self) {
        let Domain { mesh, topology: t, mut region } = self.domain.clone();
        let (surface, network) = (&self.surface, self.surface.network());
        let n = mesh.n_vertices() as u32;
        for e in t.edge_ids() {
            let [a, b] = t.ends(e);
            let v = VertexId(n + e.0);
            let (attachment, point) = match region.spans.remove(&[a.min(b), a.max(b)]) {
                Some(ArcSpan { arc, from, to }) => {
                    let middle = 0.5 * (from + to);
                    region.insert_span(a.min(b), v, ArcSpan { arc, from, to: middle });
                    region.insert_span(v, a.max(b), ArcSpan { arc, from: middle, to });
                    let on = &network.arcs[arc];
                    (Attachment::Arc { arc, t: on.normalise(middle) }, on.point(surface.topology(), middle))
                }
                None => {
                    let sheet = region.sheet_of_face[t.halfedge(e).face()];
                    let middle = mesh.position(a).midpoint(mesh.position(b));
                    let inside = |f: FaceId| network.sheet_of_face[f] == sheet;
                    (Attachment::Sheet(sheet), surface.index().closest_where(middle, inside).unwrap().point())
                }
            };
            region.attachments.push(attachment);
            region.points.push(point);
        }
        let children = t.faces().enumerate().flat_map(|(f, [a, b, c])| {
            let [ab, bc, ca] = t.halfedges(f).map(|h| n + t.edge(h).0);
            [[a.0, ab, ca], [b.0, bc, ab], [c.0, ca, bc], [bc, ca, ab]]
        });
        let faces = children.collect();
        region.sheet_of_face = region.sheet_of_face.iter().flat_map(|&s| [s; 4]).collect();
        let mesh = TriMesh::new(region.points.iter().map(|p| p.position(surface.mesh())).collect(), faces).unwrap();
        self.domain = Domain::new(mesh, region).unwrap();
    }

    /// Moves every vertex inside a sheet at random by up to `share` of the mean length of its edges.
    pub fn jitter(mut self, share: f64, seed: u64) -> Self {
        let mut random = Random(seed);
        let mut region = self.domain.region.clone();
        for v in region.vertices() {
            let direction = DVec3::new(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5).normalize_or_zero();
            let ring: Vec<_> = self.domain.topology.one_ring(v).map(|w| self.domain.mesh.distance(v, w)).collect();
            let length = share * random.next() * ring.iter().sum::<f64>() / ring.len() as f64;
            if let Attachment::Sheet(_) = region.attachments[v] {
                region.points[v] = self.walked(region.points[v], length * direction);
            }
        }
        self.domain = self.domain.placed(&self.surface, region).unwrap();
        self
    }

    /// The end of a walk inside a sheet.
    pub fn walked(&self, from: SurfacePoint, way: DVec3) -> SurfacePoint {
        let may_cross = |e| !self.surface.network().is_barrier(e);
        walk(self.surface.mesh(), self.surface.topology(), from, way, may_cross).end
    }

    pub fn try_relax(&self, options: &RelaxOptions) -> Result<Relaxed, RelaxError> {
        relax(&self.surface, &self.domain, options)
    }

    /// Relaxes and checks what always holds.
    pub fn relax(&self, options: &RelaxOptions) -> Relaxed {
        self.checked(self.try_relax(options).unwrap())
    }

    /// The same with vertices held.
    pub fn relax_holding(&self, held: &[VertexId], options: &RelaxOptions) -> Relaxed {
        self.checked(relax_holding(&self.surface, &self.domain, held, options).unwrap())
    }

    /// Checks what always holds of a relaxed domain.
    pub fn checked(&self, relaxed: Relaxed) -> Relaxed {
        let (surface, network, region) = (&self.surface, self.surface.network(), &relaxed.domain.region);
        relaxed.domain.check(network).unwrap();
        assert_eq!(relaxed.domain.mesh.faces(), self.domain.mesh.faces());
        for v in region.vertices() {
            let point = region.points[v];
            assert_eq!(relaxed.domain.mesh.position(v), point.position(surface.mesh()));
            match region.attachments[v] {
                Attachment::Corner(_) => assert_eq!(point, self.domain.region.points[v]),
                Attachment::Sheet(s) => assert_eq!(network.sheet_of_face[point.face], s),
                Attachment::Arc { arc, t } => {
                    let position = network.arcs[arc].position(surface.mesh(), t);
                    assert!(position.distance(relaxed.domain.mesh.position(v)) < 1e-12);
                }
            }
        }
        for (ends, span) in &region.spans {
            let before = self.domain.region.spans[ends];
            assert!((span.to - span.from) * (before.to - before.from) > 0.0, "order on the arc");
        }
        let (start, end) = (relaxed.report.start, relaxed.report.end);
        assert!(end.inverted < start.inverted || (end.inverted == start.inverted && end.ar_mean >= start.ar_mean));
        relaxed
    }
}

/// Where a base vertex shall be.
pub enum Place {
    Corner(CornerId),
    Arc(ArcId, f64),
    /// Inside the sheet of the closest point.
    Near(DVec3),
}

struct Random(u64);

impl Random {
    /// In [0, 1).
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

pub const OCTAHEDRON: [[u32; 3]; 8] = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];

pub fn octahedron() -> Vec<DVec3> {
    [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z].to_vec()
}

pub fn icosahedron() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let p = [
        [-1.0, g, 0.0],
        [1.0, g, 0.0],
        [-1.0, -g, 0.0],
        [1.0, -g, 0.0],
        [0.0, -1.0, g],
        [0.0, 1.0, g],
        [0.0, -1.0, -g],
        [0.0, 1.0, -g],
        [g, 0.0, -1.0],
        [g, 0.0, 1.0],
        [-g, 0.0, -1.0],
        [-g, 0.0, 1.0],
    ];
    let f = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    (p.iter().map(|&p| DVec3::from_array(p).normalize()).collect(), f.to_vec())
}

/// A unit sphere of rings and meridians.
pub fn uv_sphere(rings: u32, meridians: u32) -> TriMesh {
    let mut p = vec![DVec3::Z, DVec3::NEG_Z];
    for i in 1..rings {
        let a = TAU / 2.0 * f64::from(i) / f64::from(rings);
        for j in 0..meridians {
            let b = TAU * f64::from(j) / f64::from(meridians);
            p.push(DVec3::new(a.sin() * b.cos(), a.sin() * b.sin(), a.cos()));
        }
    }
    let at = |i: u32, j: u32| 2 + (i - 1) * meridians + j % meridians;
    let mut f = Vec::new();
    for j in 0..meridians {
        f.extend([[0, at(1, j), at(1, j + 1)], [1, at(rings - 1, j + 1), at(rings - 1, j)]]);
        for i in 1..rings - 1 {
            f.extend([[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]);
        }
    }
    TriMesh::new(p, f).unwrap()
}

/// A sphere with a domain subdivided from these faces, each base vertex at the nearest point.
pub fn on_sphere(positions: Vec<DVec3>, faces: &[[u32; 3]], levels: usize) -> Bed {
    let places = positions.into_iter().map(Place::Near).collect();
    Bed::on(uv_sphere(24, 48)).with_base(places, vec![], faces.to_vec(), levels)
}

/// A grid of `m` by `n` quads, closed both ways, at `at(i / m, j / n)`.
pub fn torus_grid(m: u32, n: u32, at: impl Fn(f64, f64) -> DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let id = |i: u32, j: u32| (i % m) * n + j % n;
    let p = (0..m * n).map(|k| at(f64::from(k / n) / f64::from(m), f64::from(k % n) / f64::from(n))).collect();
    let quads = (0..m).flat_map(|i| (0..n).map(move |j| (i, j)));
    let f = quads.flat_map(|(i, j)| [[id(i, j), id(i + 1, j), id(i + 1, j + 1)], [id(i, j), id(i + 1, j + 1), id(i, j + 1)]]);
    (p, f.collect())
}

/// A torus of radii 2 and 0.7 with a coarse grid as domain.
pub fn torus(levels: usize) -> Bed {
    let at = |u: f64, v: f64| {
        let (u, v) = (TAU * u, TAU * v);
        DVec3::new((2.0 + 0.7 * v.cos()) * u.cos(), (2.0 + 0.7 * v.cos()) * u.sin(), 0.7 * v.sin())
    };
    let (p, f) = torus_grid(48, 24, at);
    let (places, faces) = torus_grid(9, 4, at);
    Bed::on(TriMesh::new(p, f).unwrap()).with_base(places.into_iter().map(Place::Near).collect(), vec![], faces, levels)
}

/// The unit cube, every side a grid of `n` by `n` quads, and as domain its 12 triangles.
pub fn cube(n: u32, levels: usize) -> Bed {
    let mut ids = BTreeMap::new();
    let mut p = Vec::new();
    let mut f = Vec::new();
    for (axis, low) in (0..3).flat_map(|a| [(a, true), (a, false)]) {
        let mut id = |i: u32, j: u32| {
            let mut at = [0; 3];
            (at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3]) = (if low { 0 } else { n }, i, j);
            *ids.entry(at).or_insert_with(|| {
                p.push(DVec3::from_array(at.map(|x| f64::from(x) / f64::from(n))));
                p.len() as u32 - 1
            })
        };
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
            f.extend(if low { [[a, c, b], [a, d, c]] } else { [[a, b, c], [a, c, d]] });
        }
    }
    let bed = Bed::on(TriMesh::new(p, f).unwrap());
    let network = bed.surface.network();
    assert_eq!((network.corners.len(), network.arcs.len(), network.n_sheets), (8, 12, 6));
    let corners = &network.corners;
    let base = |p: DVec3| corners.ids().find(|&c| bed.surface.mesh().position(corners[c]) == p).unwrap().0;
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let at = |i: u32| base(DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)));
    let faces = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).map(|f| f.map(at)).collect();
    let spans = bed.surface.network().arcs.enumerate().map(|(id, arc)| {
        let [a, b] = arc.corners.unwrap();
        (a.0, b.0, ArcSpan { arc: id, from: 0.0, to: arc.length() })
    });
    let spans = spans.collect();
    let places = corners.ids().map(Place::Corner).collect();
    bed.with_base(places, spans, faces, levels)
}

/// A closed frustum of these radii and height, and as domain `k` vertices on each rim and one in each lid.
pub fn frustum([bottom, top]: [f64; 2], height: f64, k: u32, levels: usize) -> Bed {
    let (n, rows) = (48, 8);
    let ring = |r: f64, z: f64| {
        (0..n).map(move |i| TAU * f64::from(i) / f64::from(n)).map(move |a| DVec3::new(r * a.cos(), r * a.sin(), z))
    };
    let row = |i: u32| f64::from(i) / f64::from(rows);
    let side = (0..=rows).flat_map(|i| ring(bottom + (top - bottom) * row(i), height * row(i)));
    let mut p: Vec<DVec3> = side.collect();
    p.extend([DVec3::ZERO, height * DVec3::Z]);
    let (low, high) = (p.len() as u32 - 2, p.len() as u32 - 1);
    let mut f = Vec::new();
    for (i, j) in (0..n).map(|i| (i, (i + 1) % n)) {
        f.extend([[low, j, i], [high, rows * n + i, rows * n + j]]);
        for row in 0..rows {
            let (a, b) = (row * n, (row + 1) * n);
            f.extend([[a + i, a + j, b + j], [a + i, b + j, b + i]]);
        }
    }
    let bed = Bed::on(TriMesh::new(p, f).unwrap());
    assert!(bed.surface.network().arcs.len() == 2 && bed.surface.network().arcs.iter().all(|a| a.is_loop()));

    let (mut places, mut spans, mut faces) = (Vec::new(), Vec::new(), Vec::new());
    // Both loops go round the same way or not: make the domain's rings do.
    for (id, arc) in bed.surface.network().arcs.enumerate() {
        let first = arc.position(bed.surface.mesh(), 0.0);
        let ccw = first.cross(arc.position(bed.surface.mesh(), 0.1 * arc.length())).z > 0.0;
        let start = k * id.0;
        let at = |i: u32| arc.length() * f64::from(if ccw { i } else { k - i }) / f64::from(k);
        for i in 0..k {
            places.push(Place::Arc(id, arc.normalise(at(i))));
            spans.push((start + i, start + (i + 1) % k, ArcSpan { arc: id, from: at(i), to: at(i + 1) }));
        }
    }
    places.extend([DVec3::ZERO, height * DVec3::Z].map(Place::Near));
    // The first arc is at the bottom, since its vertices come first.
    for (i, j) in (0..k).map(|i| (i, (i + 1) % k)) {
        faces.extend([[2 * k, j, i], [2 * k + 1, k + i, k + j], [i, j, k + j], [i, k + j, k + i]]);
    }
    bed.with_base(places, spans, faces, levels)
}

/// All bytes of a result that matter.
pub fn bytes(relaxed: &Relaxed) -> Vec<u64> {
    let points = relaxed
        .domain
        .region
        .points
        .iter()
        .flat_map(|p| [p.face.index() as u64].into_iter().chain(p.barycentric.to_array().map(f64::to_bits)));
    let spans = relaxed.domain.region.spans.values().flat_map(|s| [s.from.to_bits(), s.to.to_bits()]);
    let positions = relaxed.domain.mesh.positions().iter().flat_map(|p| p.to_array().map(f64::to_bits));
    points.chain(spans).chain(positions).collect()
}
