//! Which bends and creases have poor triangles beside them.

use crate::{LetGo, SnapError, SnapOptions, Snapped, Track};
use mesh_core::{FaceId, TriMesh, VertexId, aspect_ratio};
use region_map::RegionMapError;
use std::collections::BTreeSet;

/// A triangle may keep this share of the quality that was the worst around.
const MOST_LOSS: f64 = 0.9;

impl Snapped {
    /// The bends and the halves of pieces of minor creases that came out poor: some triangle beside them has turned over, is in
    /// `refused` or shares a vertex with one that is, or has a quality below the bound in the options and below the worst one
    /// there before. Where nothing is refused, and that holds for edges that are only followed as a person sees them as sharp, they are told of alone: what
    /// is beside them may be sound without them.
    ///
    /// `before` and `after` are the domain before snapping, and relaxed after it. Fails where one of them has other numbers of
    /// vertices or faces than this domain. What is in `refused` and no face of the domain is passed over.
    pub fn poor(&self, [before, after]: [&TriMesh; 2], refused: &[FaceId], options: &SnapOptions) -> Result<LetGo, SnapError> {
        let topology = &self.domain.topology;
        for mesh in [before, after] {
            let sizes = [(mesh.n_vertices(), topology.n_vertices()), (mesh.n_faces(), topology.n_faces())];
            if let Some((found, expected)) = sizes.into_iter().find(|(found, expected)| found != expected) {
                return Err(RegionMapError::WrongSize { what: "the mesh", found, expected }.into());
            }
        }
        let corners = refused.iter().filter_map(|&f| topology.faces().get(f)).flatten();
        let refused: BTreeSet<FaceId> = corners.flat_map(|&v| topology.faces_at(v)).collect();
        let is_poor = |vertices: &[VertexId]| {
            let star: BTreeSet<FaceId> = vertices.iter().flat_map(|&v| topology.faces_at(v)).collect();
            let worst = |mesh: &TriMesh| star.iter().map(|&f| aspect_ratio(mesh.triangle(f))).fold(f64::INFINITY, f64::min);
            let turned = |&f: &FaceId| before.normal(f).dot(after.normal(f)) <= 0.0;
            star.iter().any(|f| turned(f) || refused.contains(f))
                || worst(after) < options.least_quality.min(MOST_LOSS * worst(before))
        };
        let poor_edges = |only_seen: bool| {
            let mut edges = BTreeSet::new();
            for Track { edges: of_track, path, .. } in self.tracks.iter().filter(|track| track.only_seen == only_seen) {
                let ([first, second], [start, end]) = (halves(of_track), halves(path));
                edges.extend(first.iter().filter(|_| is_poor(start)).chain(second.iter().filter(|_| is_poor(end))));
            }
            edges
        };
        let only_seen = poor_edges(true);
        if refused.is_empty() && !only_seen.is_empty() {
            return Ok(LetGo { minor: only_seen, ..LetGo::default() });
        }
        let bends = self.bends.iter().filter(|bend| is_poor(&[bend.vertex])).map(|bend| bend.at).collect();
        Ok(LetGo { bends, minor: only_seen.into_iter().chain(poor_edges(false)).collect() })
    }
}

/// Both halves of a list, the one in the middle in both.
fn halves<T>(list: &[T]) -> [&[T]; 2] {
    [&list[..list.len().div_ceil(2)], &list[list.len() / 2..]]
}
