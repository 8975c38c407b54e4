//! Triangles whose vertices are merged into their neighbours, one after the other.

use glam::DVec3;
use mesh_core::{aspect_ratio, vector_area};
use region_map::{Network, Surface};

/// What a vertex may be merged into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Freedom {
    /// Nothing: it is a corner.
    Fixed,
    /// The vertices before and after it on its arc.
    Arc([u32; 2]),
    /// Any neighbour.
    Sheet,
}

/// How much a triangle may change in one merge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guards {
    /// The least cosine of the angle that its normal turns by.
    pub(crate) cosine: f64,
    /// The least quality (AR), where it had more before.
    pub(crate) quality: f64,
}

/// Triangles that get fewer. Vertices keep their positions.
pub(crate) struct Triangles<'a> {
    positions: &'a [DVec3],
    /// `None` where one is gone.
    pub(crate) faces: Vec<Option<[u32; 3]>>,
    pub(crate) n_faces: usize,
    /// The triangles around every vertex; none where it is gone.
    around: Vec<Vec<u32>>,
    /// The vertex that each was merged into; itself where it is there.
    merged_into: Vec<u32>,
    pub(crate) freedoms: Vec<Freedom>,
}

impl<'a> Triangles<'a> {
    pub(crate) fn new(surface: &'a Surface) -> Self {
        let mesh = surface.mesh();
        let mut around = vec![Vec::with_capacity(8); mesh.n_vertices()];
        let faces: Vec<Option<[u32; 3]>> = mesh.faces().iter().map(|f| Some(f.map(|v| v.0))).collect();
        for (f, face) in faces.iter().enumerate() {
            face.iter().flatten().for_each(|&v| around[v as usize].push(f as u32));
        }
        let freedoms = freedoms(mesh.n_vertices(), surface.network());
        Self {
            positions: mesh.positions().as_slice(),
            n_faces: faces.len(),
            faces,
            around,
            merged_into: (0..mesh.n_vertices() as u32).collect(),
            freedoms,
        }
    }

    pub(crate) fn position(&self, v: u32) -> DVec3 {
        self.positions[v as usize]
    }

    pub(crate) fn is_there(&self, v: u32) -> bool {
        !self.around[v as usize].is_empty()
    }

    /// The vertex that stands for each: the one that it was merged into, with all that were merged into one another before.
    pub(crate) fn representatives(&self) -> Vec<u32> {
        let mut representatives = self.merged_into.clone();
        for v in 0..representatives.len() {
            let mut end = v;
            while representatives[end] as usize != end {
                end = representatives[end] as usize;
            }
            let mut at = v;
            while at != end {
                at = std::mem::replace(&mut representatives[at], end as u32) as usize;
            }
        }
        representatives
    }

    fn faces_at(&self, v: u32) -> impl Iterator<Item = (u32, [u32; 3])> + '_ {
        self.around[v as usize].iter().filter_map(|&f| Some((f, self.faces[f as usize]?)))
    }

    /// The neighbours of a vertex, in rising order.
    pub(crate) fn ring(&self, v: u32) -> Vec<u32> {
        let mut ring: Vec<u32> = self.faces_at(v).flat_map(|(_, face)| face).filter(|&w| w != v).collect();
        ring.sort_unstable();
        ring.dedup();
        ring
    }

    /// The neighbours that a vertex may be merged into, as far as its arc goes.
    pub(crate) fn targets(&self, v: u32) -> Vec<u32> {
        match self.freedoms[v as usize] {
            Freedom::Fixed => Vec::new(),
            Freedom::Arc(ends) => ends.to_vec(),
            Freedom::Sheet => self.ring(v),
        }
    }

    /// Whether `from` can be merged into its neighbour `into`: all stays a manifold of the same topology, no new edge is longer than
    /// `longest` says for its ends, and no triangle changes beyond the guards.
    pub(crate) fn can_merge(&self, from: u32, into: u32, longest: impl Fn(u32, u32) -> f64, guards: &Guards) -> bool {
        let (ring, other) = (self.ring(from), self.ring(into));
        let shared: Vec<u32> = ring.iter().copied().filter(|v| other.binary_search(v).is_ok()).collect();
        let is_beside = |&(_, face): &(u32, [u32; 3])| face.contains(&into);
        if shared.len() != self.faces_at(from).filter(is_beside).count() || shared.iter().any(|&v| !self.can_lose_a_face(v)) {
            return false;
        }
        // Two edges on arcs would become one.
        if let Freedom::Arc(ends) = self.freedoms[from as usize]
            && ends.iter().any(|v| *v != into && (*v == from || shared.contains(v)))
        {
            return false;
        }
        let is_long = |v: u32| self.position(v).distance(self.position(into)) > longest(v, into);
        if ring.iter().any(|&v| v != into && !shared.contains(&v) && is_long(v)) {
            return false;
        }
        self.faces_at(from).filter(|face| !is_beside(face)).all(|(_, face)| self.bears(face, from, into, guards))
    }

    /// Whether a vertex has enough triangles to lose one.
    fn can_lose_a_face(&self, v: u32) -> bool {
        let n = self.around[v as usize].len();
        let is_inside = || self.ring(v).len() == n;
        n > 3 || (n > 1 && !is_inside())
    }

    /// Whether a triangle stays within the guards when its corner `from` goes to `into`.
    fn bears(&self, face: [u32; 3], from: u32, into: u32, guards: &Guards) -> bool {
        let before = face.map(|v| self.position(v));
        let after = face.map(|v| self.position(if v == from { into } else { v }));
        let (old, new) = (vector_area(before), vector_area(after));
        new.dot(old) > guards.cosine * new.length() * old.length()
            && aspect_ratio(after) >= guards.quality.min(aspect_ratio(before))
    }

    /// Merges a vertex into a neighbour.
    pub(crate) fn merge(&mut self, from: u32, into: u32) {
        self.merged_into[from as usize] = into;
        for f in std::mem::take(&mut self.around[from as usize]) {
            let Some(face) = self.faces[f as usize] else { continue };
            if face.contains(&into) {
                self.faces[f as usize] = None;
                self.n_faces -= 1;
                face.iter().filter(|&&v| v != from).for_each(|&v| self.around[v as usize].retain(|&g| g != f));
            } else {
                self.faces[f as usize] = Some(face.map(|v| if v == from { into } else { v }));
                self.around[into as usize].push(f);
            }
        }
        if let Freedom::Arc([before, after]) = self.freedoms[from as usize] {
            let other = if before == into { after } else { before };
            for (v, new) in [(other, into), (into, other)] {
                if let Freedom::Arc(ends) = &mut self.freedoms[v as usize] {
                    ends.iter_mut().filter(|end| **end == from).for_each(|end| *end = new);
                }
            }
        }
    }
}

/// What each vertex may be merged into, by the network.
fn freedoms(n_vertices: usize, network: &Network) -> Vec<Freedom> {
    let mut freedoms = vec![Freedom::Sheet; n_vertices];
    for arc in network.arcs.iter() {
        for three in arc.vertices.windows(3) {
            freedoms[three[1].0 as usize] = Freedom::Arc([three[0].0, three[2].0]);
        }
        if let [first, second, .., last_but_one, _] = arc.vertices[..]
            && arc.is_loop()
        {
            freedoms[first.0 as usize] = Freedom::Arc([last_but_one.0, second.0]);
        }
    }
    network.corners.iter().for_each(|v| freedoms[v.0 as usize] = Freedom::Fixed);
    freedoms
}
