//! What a file says.

use crate::attributes::Attributes;
use crate::error::Fault;
use crate::extra::{Extra, Extras};
use glam::{DVec2, DVec3};
use mesh_core::Soup;

/// The contents of a file: its triangles, and the polygons that they were cut from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// All vertices of the file, in its order and with those that no face uses, and its polygons cut into fans of triangles.
    ///
    /// Indices that are out of range stay so (one that is negative, or does not fit in 32 bits, becomes `u32::MAX`).
    pub soup: Soup,
    /// For each triangle the polygon that it was cut from, numbered from 0 in the order of the file. A triangle of a strip or
    /// fan counts as a polygon.
    pub polygon_of: Vec<u32>,
    /// Number of polygons.
    pub n_polygons: usize,
    /// Number of polygons with more than 3 sides.
    pub n_polygons_above_3: usize,
    /// Polygons with an index that is out of range, in increasing order. Their triangles are still in the soup.
    pub polygons_out_of_range: Vec<u32>,
    /// Line segments (`l` of an obj, the element `edge` of a ply) as pairs of vertices, which may be out of range. No other format
    /// has them.
    pub lines: Vec<[u32; 2]>,
    /// What else its vertices and triangles have, as far as it is read.
    pub attributes: Attributes,
    /// What else the file holds, each kind once, whether it is read or not.
    pub extras: Vec<Extra>,
}

/// What a file gives for vertices, and an attribute has for corners. Empty where it gives none.
#[derive(Default)]
pub(crate) struct OfVertices {
    pub(crate) normals: Vec<DVec3>,
    pub(crate) uvs: Vec<DVec2>,
}

/// Collects a [`Document`].
#[derive(Default)]
pub(crate) struct Builder {
    document: Document,
    /// What the vertices and triangles so far have; shorter lists are filled up at the end.
    pub(crate) attributes: Attributes,
    /// Normals and texture coordinates of vertices, which become those of corners when all triangles are known.
    pub(crate) of_vertices: OfVertices,
    /// What the file holds beside polygons.
    pub(crate) extras: Extras,
}

impl Builder {
    /// Appends a vertex.
    pub(crate) fn vertex(&mut self, position: DVec3) {
        self.document.soup.positions.push(position);
    }
    /// Number of vertices so far.
    pub(crate) fn n_vertices(&self) -> usize {
        self.document.soup.positions.len()
    }
    /// The triangles so far.
    pub(crate) fn triangles(&self) -> &[[u32; 3]] {
        &self.document.soup.triangles
    }
    /// Number of triangles so far.
    pub(crate) fn n_triangles(&self) -> usize {
        self.document.soup.triangles.len()
    }
    /// Appends a polygon as a fan around its first corner. Fewer than 3 corners give no triangle.
    pub(crate) fn polygon(&mut self, corners: &[u32]) {
        // `finish` refuses a document with too many polygons for this to be exact.
        let polygon = self.document.n_polygons as u32;
        for triangle in fan(corners) {
            self.document.soup.triangles.push(triangle);
            self.document.polygon_of.push(polygon);
        }
        self.document.n_polygons += 1;
        self.document.n_polygons_above_3 += usize::from(corners.len() > 3);
    }
    /// Appends a chain of line segments.
    pub(crate) fn polyline(&mut self, vertices: &[u32]) {
        self.document.lines.extend(vertices.windows(2).map(|w| [w[0], w[1]]));
    }
    /// The document, with its bad polygons listed. Fails when there are too many elements for 32-bit indices.
    pub(crate) fn finish(mut self) -> Result<Document, Fault> {
        let soup = &self.document.soup;
        let limit = u32::MAX as usize;
        if soup.positions.len() >= limit || 3 * soup.triangles.len() >= limit {
            return Err(Fault::unsupported("the mesh has more elements than 32-bit indices can name", "split it"));
        }
        let bad = |t: &[u32; 3]| t.iter().any(|&v| v as usize >= soup.positions.len());
        let mut polygons: Vec<u32> =
            soup.triangles.iter().zip(&self.document.polygon_of).filter(|(t, _)| bad(t)).map(|(_, &p)| p).collect();
        polygons.dedup();
        self.document.polygons_out_of_range = polygons;
        self.extras.note_if(!self.document.lines.is_empty(), Extra::PointsOrLines);
        self.attributes.complete(soup.positions.len(), soup.triangles.len());
        self.document.attributes = self.attributes;
        self.document.extras = self.extras.list();
        Ok(self.document)
    }
}

/// The fan around the first corner of a polygon, of its corners or of what they have.
pub(crate) fn fan<T: Copy>(corners: &[T]) -> impl Iterator<Item = [T; 3]> {
    corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]])
}

/// The triangles of a strip, every second one turned round.
pub(crate) fn strip_triangles<T: Copy>(corners: &[T]) -> impl Iterator<Item = [T; 3]> {
    corners.windows(3).enumerate().map(|(i, t)| if i % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] })
}

/// An index from a file as [`Soup`] holds it: what does not fit becomes `u32::MAX`, which is out of range of every soup.
pub(crate) fn saturating_index(index: i64) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}
