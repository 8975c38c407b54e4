//! Linear 1-to-4 subdivision of a base mesh, any number of times, that keeps the region map (paper, section 4.1).
//!
//! Index arithmetic only: child faces of face `f = (a, b, c)` are `4f..4f+3` = `(a, ab, ca) (b, bc, ab) (c, ca, bc) (bc, ca, ab)`,
//! and the vertices of a level are a prefix of those of the next. A midpoint of an edge on an arc is on that arc, of any other edge
//! in the sheet of its face (two end points do not decide: two corners may be joined across a sheet).
//!
//! ```
//! use mesh_core::Topology;
//! use region_map::{ArcKind, Network, RegionMap};
//! use subdiv::subdivide;
//!
//! // A box of twelve triangles as its own base mesh, its twelve edges as arcs.
//! let base = fixtures::cube(1);
//! let topology = Topology::new(base.faces(), base.n_vertices())?;
//! let is_sharp = |e| topology.edge_faces(e).1.is_some_and(|g| base.normal(g) != base.normal(topology.edge_faces(e).0));
//! let kinds = topology.edge_ids().map(|e| is_sharp(e).then_some(ArcKind::Sharp)).collect();
//! let network = Network::trace(&base, &topology, &kinds, |_| false, Vec::new());
//!
//! let domain = subdivide(&base, &RegionMap::identity(&topology, &network), 2)?;
//! assert_eq!(domain.mesh.n_faces(), 16 * 12);
//! assert_eq!(domain.region.class_counts(), [8, 12 * 3, 54]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bisect;
mod subdivide;

pub use bisect::{Bisected, Faces, Middle, bisected};
pub use subdivide::{SubdivDomain, SubdivError, subdivide};
