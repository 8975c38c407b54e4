//! The stage: short creases contracted, flips in planes, splits of long edges.

use crate::contract::contract;
use crate::editable_mesh::EditableMesh;
use crate::options::{RefineError, RefineOptions};
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, Id as _, IdVec, Topology, TriMesh, VertexId};
use rustc_hash::FxHashSet;
use std::collections::BinaryHeap;

/// The same surface in other triangles.
#[derive(Clone, Debug)]
pub struct Refined {
    /// The mesh. The vertices of the input that are left come first, in their order.
    pub mesh: TriMesh,
    /// Its connectivity.
    pub topology: Topology,
    /// For every face the input's that it lies in; after flips in a plane, one of those.
    pub source_face: IdVec<FaceId, FaceId>,
    /// The marked edges, halved where they were split.
    pub marked: Vec<[VertexId; 2]>,
    /// Number of edges contracted.
    pub contractions: usize,
    /// Number of edges flipped.
    pub flips: usize,
    /// Number of edges halved.
    pub splits: usize,
}

/// Refines a mesh. `marked` edges, as pairs of vertices of this mesh, are never flipped.
///
/// Fails where an option is out of its range, the topology is of another mesh, or a marked pair is no edge.
pub fn refine(
    mesh: &TriMesh,
    topology: &Topology,
    marked: &[[VertexId; 2]],
    options: &RefineOptions,
) -> Result<Refined, RefineError> {
    options.check()?;
    check(mesh, topology, marked)?;
    let contracted = contract(mesh, topology, marked, options)?;
    let (editable, marked, contractions) = match &contracted {
        Some(c) => (EditableMesh::new(&c.mesh, &c.topology, c.source.clone()), &c.marked[..], c.contractions),
        None => (EditableMesh::new(mesh, topology, mesh.faces().ids().collect()), marked, 0),
    };
    let mut refiner = Refiner {
        tolerance: options.flatness * mesh.diagonal(),
        sliver: options.shortest_edge,
        marked: marked.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect(),
        mesh: editable,
        contractions,
        flips: 0,
        splits: 0,
    };
    let all: Vec<HalfedgeId> = refiner.mesh.halfedges().collect();
    refiner.flip_to_delaunay(all);
    refiner.halve(options.longest_edge, options.most_faces(mesh.n_faces()));
    refiner.finish()
}

fn check(mesh: &TriMesh, topology: &Topology, marked: &[[VertexId; 2]]) -> Result<(), RefineError> {
    if topology.n_vertices() != mesh.n_vertices() || topology.faces() != mesh.faces() {
        return Err(RefineError::OtherMesh);
    }
    let is_there = |v: VertexId| v.index() < mesh.n_vertices();
    let is_edge = |&[a, b]: &[VertexId; 2]| is_there(a) && is_there(b) && topology.find_edge(a, b).is_some();
    match marked.iter().find(|edge| !is_edge(edge)) {
        Some(&[a, b]) => Err(RefineError::NotAnEdge(a, b)),
        None => Ok(()),
    }
}

/// Flips must lessen the sum of both opposite angles below pi by this much, so that rounding cannot make them cycle.
const ANGLE_MARGIN: f64 = 1e-6;
/// So many flips an edge are more than any plane needs; in nearly flat places the angles could go round.
const MOST_FLIPS: usize = 20;
/// A triangle lower than this share of its longest edge has no normal worth asking for.
const NO_HEIGHT: f64 = 1e-6;

/// A low triangle is a sliver only below this share of its longest edge. More takes the noise of scans for slivers (fixture scan: mean AR .888
/// without these flips, .847 with all low triangles flipped, .880 so).
const THIN: f64 = 0.01;

/// And only where its apex is over the middle of that edge, this share of it away from both ends at least: the long triangles of fillets, which are
/// no slivers, have it over an end.
const CAP: f64 = 0.05;

struct Refiner {
    mesh: EditableMesh,
    /// Ends in rising order.
    marked: FxHashSet<[VertexId; 2]>,
    tolerance: f64,
    /// A triangle lower than this has no say in where the surface is: its longest edge is flipped wherever its neighbours lie, which moves the
    /// surface by its height. Else needles between two lines that are one crease would stay.
    sliver: f64,
    contractions: usize,
    flips: usize,
    splits: usize,
}

impl Refiner {
    /// Lawson's algorithm: flips edges and those around them until all that may be flipped are Delaunay. Returns the
    /// halfedges that run elsewhere than before.
    fn flip_to_delaunay(&mut self, mut edges: Vec<HalfedgeId>) -> Vec<HalfedgeId> {
        edges.reverse();
        let most = MOST_FLIPS * edges.len();
        let (mut flips, mut changed) = (0, Vec::new());
        while let Some(h) = edges.pop() {
            let Some(twin) = self.mesh.twin(h) else { continue };
            if flips < most && self.may_flip(h, twin) {
                let around = self.mesh.flip(h, twin);
                edges.extend(around);
                changed.extend(around);
                changed.push(h);
                flips += 1;
            }
        }
        self.flips += flips;
        changed
    }

    /// Would the other diagonal be better, and the surface the same?
    fn may_flip(&self, h: HalfedgeId, twin: HalfedgeId) -> bool {
        let mesh = &self.mesh;
        let [a, b] = mesh.ends(h);
        let (c, d) = (mesh.opposite(h), mesh.opposite(twin));
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| mesh.positions[v]);
        angle(pc, pa, pb) + angle(pd, pa, pb) > std::f64::consts::PI + ANGLE_MARGIN
            && !self.marked.contains(&[a.min(b), a.max(b)])
            && is_same_surface([pa, pb, pc, pd], self.tolerance, self.sliver)
            && c != d
            && !mesh.are_joined(h.prev(), d)
    }

    /// Halves edges, the longest first, and flips what became possible.
    fn halve(&mut self, longest: f64, most_faces: usize) {
        let mut queue: BinaryHeap<(u64, HalfedgeId)> = BinaryHeap::new();
        let key = |mesh: &EditableMesh, h: HalfedgeId| {
            let length = mesh.length(h);
            (length > longest).then(|| (length.to_bits(), h)) // lengths are not negative: their bits are in order
        };
        queue.extend(self.mesh.halfedges().filter_map(|h| key(&self.mesh, h)));
        while let Some((bits, h)) = queue.pop() {
            if self.mesh.length(h).to_bits() != bits {
                continue; // it has been halved or flipped since
            }
            if self.mesh.faces.len() + 2 > most_faces {
                break;
            }
            let ends = self.mesh.ends(h);
            let (middle, mut changed) = self.mesh.split(h);
            self.mark_halves(ends, middle);
            self.splits += 1;
            changed.extend(self.flip_to_delaunay(changed.clone()));
            queue.extend(changed.into_iter().filter_map(|h| key(&self.mesh, h)));
        }
    }

    fn mark_halves(&mut self, [a, b]: [VertexId; 2], middle: VertexId) {
        if self.marked.remove(&[a.min(b), a.max(b)]) {
            self.marked.extend([[a, middle], [b, middle]]); // new vertices have the highest ids
        }
    }

    fn finish(self) -> Result<Refined, RefineError> {
        let EditableMesh { positions, faces, source, .. } = self.mesh;
        let faces: Vec<[u32; 3]> = faces.iter().map(|f| f.map(|v| v.0)).collect();
        let mesh = TriMesh::new(positions.into_vec(), faces)?;
        let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
        let mut marked: Vec<[VertexId; 2]> = self.marked.into_iter().collect();
        marked.sort_unstable();
        let Self { contractions, flips, splits, .. } = self;
        Ok(Refined { mesh, topology, source_face: source, marked, contractions, flips, splits })
    }
}

/// The angle at `o` in radians.
fn angle(o: DVec3, a: DVec3, b: DVec3) -> f64 {
    let (u, v) = (a - o, b - o);
    u.cross(v).length().atan2(u.dot(v))
}

/// Do the triangles `a d c` and `d b c` cover what `a b c` and `b a d` do, to the tolerance? Where one of these is lower than `sliver` over
/// `a b`, to that.
fn is_same_surface([a, b, c, d]: [DVec3; 4], tolerance: f64, sliver: f64) -> bool {
    let (ab, cd) = (b - a, d - c);
    let across = ab.cross(cd);
    let size = across.length();
    let is_low = |p: DVec3| {
        let foot = (p - a).dot(ab) / ab.length_squared();
        (CAP..1.0 - CAP).contains(&foot) && (p - a).cross(ab).length() < sliver.min(THIN * ab.length()) * ab.length()
    };
    let tolerance = if is_low(c) || is_low(d) { sliver.max(tolerance) } else { tolerance };
    // Both diagonals cross, seen along the normal of the quad: at their distance, the surface moves most.
    if size <= 0.0 || (c - a).dot(across).abs() > tolerance * size {
        return false;
    }
    let normal = across / -size;
    let faces_up = |t: [DVec3; 3]| mesh_core::vector_area(t).dot(normal);
    let has_height = |t: [DVec3; 3]| {
        let longest = t[0].distance(t[1]).max(t[1].distance(t[2])).max(t[2].distance(t[0]));
        mesh_core::area(t) > (NO_HEIGHT * longest).max(0.5 * sliver.min(THIN * longest)) * longest
    };
    let old = [[a, b, c], [b, a, d]];
    let new = [[a, d, c], [d, b, c]];
    old.into_iter().all(|t| !has_height(t) || faces_up(t) > 0.0) && new.into_iter().all(|t| faces_up(t) > 0.0)
}
