//! Back to an earlier state.

use super::mesh::Editor;
use super::samples::Placed;
use super::star::Face;
use glam::DVec3;
use mesh_core::{FaceId, IdVec, VertexId};
use region_map::RegionMap;
use rustc_hash::FxHashMap;

/// The state of an editor. The history of the map, which is by far the largest part, is not in it: the map takes its last edits back.
pub(crate) struct Checkpoint {
    n_edits: usize,
    faces: IdVec<FaceId, Option<Face>>,
    covered: IdVec<FaceId, Vec<Placed>>,
    lengths: FxHashMap<[VertexId; 2], f64>,
    star: IdVec<VertexId, Vec<FaceId>>,
    on_border: IdVec<VertexId, bool>,
    positions: IdVec<VertexId, DVec3>,
    region: RegionMap,
    n_vertices: usize,
}

impl Editor<'_> {
    /// The state now.
    pub(crate) fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            n_edits: self.map.n_edits(),
            faces: self.faces.clone(),
            covered: self.covered.clone(),
            lengths: self.lengths.clone(),
            star: self.star.clone(),
            on_border: self.on_border.clone(),
            positions: self.positions.clone(),
            region: self.region.clone(),
            n_vertices: self.n_vertices,
        }
    }

    /// Goes back to a state that this editor was in.
    pub(crate) fn restore(&mut self, state: Checkpoint) {
        let Checkpoint { n_edits, faces, covered, lengths, star, on_border, positions, region, n_vertices } = state;
        self.map.undo_to(n_edits);
        (self.faces, self.covered, self.lengths, self.star) = (faces, covered, lengths, star);
        (self.on_border, self.positions, self.region, self.n_vertices) = (on_border, positions, region, n_vertices);
    }

    /// Closes the gaps that faces have left in their numbering. Their order stays.
    pub(crate) fn close_gaps(&mut self) {
        let mut numbers = IdVec::<FaceId, Option<FaceId>>::filled(None, self.faces.len());
        let (mut faces, mut covered) = (IdVec::new(), IdVec::new());
        for (f, content) in std::mem::take(&mut self.covered).into_vec().into_iter().enumerate() {
            let f = FaceId(f as u32);
            if let Some(face) = self.faces[f] {
                numbers[f] = Some(faces.push(Some(face)));
                covered.push(content);
            }
        }
        (self.faces, self.covered) = (faces, covered);
        self.star.iter_mut().for_each(|star| *star = star.iter().filter_map(|&f| numbers[f]).collect());
    }
}
