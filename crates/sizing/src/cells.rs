//! Cells of about equal size, which curvature is measured between: larger than the noise of a scan, smaller than its limbs.

use mesh_core::{FaceId, IdVec};
use region_map::Surface;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A cell reaches this many radii at most, so that it stays compact where no other centre is near.
const MOST_REACH: f64 = 2.0;

/// A partition of the faces into cells that do not cross arcs.
pub(crate) struct Cells {
    /// The cell of every face.
    pub(crate) of_face: IdVec<FaceId, u32>,
    /// Number of cells.
    pub(crate) n: usize,
}

impl Cells {
    /// Grows cells of about the given radius: each face that is farther than it from all centres so far becomes a centre, in the
    /// order of ids, and takes the faces that are nearer to it than to others.
    pub(crate) fn grow(surface: &Surface, radius: f64) -> Self {
        let (mesh, topology, network) = (surface.mesh(), surface.topology(), surface.network());
        let mut cells = Self { of_face: IdVec::filled(u32::MAX, mesh.n_faces()), n: 0 };
        let mut distance = IdVec::<FaceId, f64>::filled(f64::INFINITY, mesh.n_faces());
        let mut queue = BinaryHeap::new();
        for centre in mesh.faces().ids() {
            if distance[centre] <= radius {
                continue;
            }
            let cell = cells.n as u32;
            cells.n += 1;
            (distance[centre], cells.of_face[centre]) = (0.0, cell);
            // Distances are not negative: their bits order like the numbers.
            queue.push(Reverse((0f64.to_bits(), centre)));
            while let Some(Reverse((bits, f))) = queue.pop() {
                let d = f64::from_bits(bits);
                if d > distance[f] || cells.of_face[f] != cell {
                    continue;
                }
                for h in topology.halfedges(f) {
                    let Some(twin) = topology.twin(h) else { continue };
                    let g = twin.face();
                    let further = d + mesh.centroid(f).distance(mesh.centroid(g));
                    if further < distance[g] && further <= MOST_REACH * radius && !network.is_barrier(topology.edge(h)) {
                        (distance[g], cells.of_face[g]) = (further, cell);
                        queue.push(Reverse((further.to_bits(), g)));
                    }
                }
            }
        }
        cells
    }
}
