//! Edges that the user marked, found in the cleaned mesh.

use crate::Error;
use glam::DVec3;
use mesh_core::{Cleaned, VertexId};

/// A marked end is a vertex this close to it, as a share of the diagonal: files round their coordinates.
const SAME_PLACE: f64 = 1e-6;

/// The marked edges, given by the positions of their ends, as vertices of the cleaned mesh.
pub(crate) fn marked_edges(cleaned: &Cleaned, positions: &[[DVec3; 2]]) -> Result<Vec<[VertexId; 2]>, Error> {
    let places = Places::new(cleaned);
    let mut marked = Vec::new();
    for (index, &[a, b]) in positions.iter().enumerate() {
        let [from, to] = [a, b].map(|p| places.vertices_at(p));
        // Cleaning leaves several vertices at a place where surfaces touch; an edge may join any two of them.
        let pairs = from.iter().flat_map(|&v| to.iter().map(move |&w| [v, w]));
        let edges: Vec<_> = pairs.filter(|&[v, w]| cleaned.topology.find_edge(v, w).is_some()).collect();
        if edges.is_empty() {
            return Err(Error::MarkedEdge { number: index + 1, from: a.to_array(), to: b.to_array() });
        }
        marked.extend(edges);
    }
    Ok(marked)
}

/// Vertices by place.
struct Places<'a> {
    cleaned: &'a Cleaned,
    tolerance: f64,
    by_x: Vec<VertexId>,
}

impl<'a> Places<'a> {
    fn new(cleaned: &'a Cleaned) -> Self {
        let mut by_x: Vec<VertexId> = cleaned.mesh.positions().ids().collect();
        by_x.sort_by(|&v, &w| cleaned.mesh.position(v).x.total_cmp(&cleaned.mesh.position(w).x));
        Self { cleaned, tolerance: SAME_PLACE * cleaned.mesh.diagonal(), by_x }
    }

    fn vertices_at(&self, p: DVec3) -> Vec<VertexId> {
        let position = |&v: &VertexId| self.cleaned.mesh.position(v);
        let start = self.by_x.partition_point(|v| position(v).x < p.x - self.tolerance);
        let near = self.by_x[start..].iter().take_while(|v| position(v).x <= p.x + self.tolerance);
        near.filter(|v| position(v).distance(p) <= self.tolerance).copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh_core::{CleanOptions, clean};

    #[test]
    fn marks_are_found_by_place() {
        let cleaned = clean(&fixtures::cube(2).to_soup(), &CleanOptions::default()).unwrap();
        let mesh = &cleaned.mesh;
        let [v, w, _] = mesh.face(mesh_core::FaceId(0));
        let marked = |shift: DVec3| marked_edges(&cleaned, &[[mesh.position(v), mesh.position(w) + shift]]);
        assert_eq!(marked(DVec3::splat(1e-8)).unwrap(), [[v, w]]);
        assert!(matches!(marked(DVec3::splat(0.1)), Err(Error::MarkedEdge { number: 1, .. })));
    }
}
