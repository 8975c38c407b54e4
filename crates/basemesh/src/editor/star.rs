//! Base faces, their quality, and the ring of neighbours round a vertex.

use glam::DVec3;
use mesh_core::{FaceId, VertexId};
use region_map::{MapFaceId, SheetId};

/// A base face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    pub(crate) vertices: [VertexId; 3],
    /// Unit normal of the surface under the face: the mean of the samples that it covers, or, where it covers none, the normal at
    /// the point that the map gives its middle.
    pub(crate) normal: DVec3,
    /// The sheet of the face.
    pub(crate) sheet: SheetId,
    /// The face of the base map, with the same order of corners.
    pub(crate) map: MapFaceId,
}

impl Face {
    /// The corner of the face at a vertex.
    pub(crate) fn corner(&self, v: VertexId) -> Option<usize> {
        self.vertices.iter().position(|&w| w == v)
    }
    /// The face with its corners turned so that `v` comes first.
    pub(crate) fn from(&self, v: VertexId) -> [VertexId; 3] {
        let c = self.corner(v).unwrap_or(0);
        [0, 1, 2].map(|i| self.vertices[(c + i) % 3])
    }
}

/// The neighbours of a vertex, counter-clockwise, and the faces between one and the next.
#[derive(Clone, Debug)]
pub(crate) struct Ring {
    pub(crate) vertices: Vec<VertexId>,
    /// The face between each neighbour and the next.
    pub(crate) faces: Vec<FaceId>,
    /// True all round, false from border to border.
    pub(crate) closed: bool,
}

/// The edges of faces, each once, ends rising, in order.
pub(crate) fn edges_of<'f>(faces: impl Iterator<Item = &'f Face>) -> Vec<[VertexId; 2]> {
    let sides = faces.flat_map(|f| (0..3).map(|c| [f.vertices[c], f.vertices[(c + 1) % 3]]));
    let mut edges: Vec<_> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// The part of a ring from one of its vertices to another, counter-clockwise; `None` where the border lies between.
pub(crate) fn side_between(ring: &Ring, first: VertexId, last: VertexId) -> Option<Ring> {
    let n = ring.vertices.len();
    let start = ring.vertices.iter().position(|&v| v == first)?;
    let end = ring.vertices.iter().position(|&v| v == last)?;
    if !ring.closed && end < start {
        return None;
    }
    let count = (end + n - start) % n;
    let vertices = (0..=count).map(|i| ring.vertices[(start + i) % n]).collect();
    let faces = (0..count).map(|i| ring.faces[(start + i) % n]).collect();
    Some(Ring { vertices, faces, closed: false })
}

/// Quality (AR) of a triangle, negative for one that faces against `normal`.
pub(crate) fn signed_quality(t: [DVec3; 3], normal: DVec3) -> f64 {
    mesh_core::aspect_ratio(t).copysign(mesh_core::vector_area(t).dot(normal))
}
