//! Better connectivity for a base mesh: edits that lower the shape energy of its relaxed first subdivision.
//!
//! [`reconnect`] flips edges, and takes vertices away while it puts as many in elsewhere. What a base mesh is good for shows only
//! in what it can be relaxed to. So every edit is tried where that shows first: in the first subdivision the faces around are
//! relaxed with their border held, and the edit is good if their energy falls. No map is needed for that, as the middles of the
//! base edges are on the surface already.
//!
//! The relaxation of a place is that of the crate `relax`, by its module `parts`: of a place this crate knows which triangles it
//! has and where its vertices begin, and how they then move is known there alone. The edits are only found here; who called
//! carries them out.
//!
//! ```
//! use mesh_core::TriMesh;
//! use reconnect::{ReconnectOptions, reconnect};
//! use region_map::{Domain, Sizing, Surface};
//!
//! // A grid of 4 by 4 rhombi, each cut along its long diagonal.
//! let positions: Vec<[f64; 3]> = (0..25).map(|i| [(i % 5) as f64 + 0.5 * (i / 5) as f64, 0.9 * (i / 5) as f64, 0.0]).collect();
//! let cells = (0..20).filter(|i| i % 5 < 4);
//! let faces: Vec<[u32; 3]> = cells.flat_map(|i| [[i, i + 1, i + 6], [i, i + 6, i + 5]]).collect();
//! let base = Domain::identity(&Surface::smooth(TriMesh::from_slices(&positions, &faces)?)?);
//! let surface = Surface::smooth(subdiv::subdivide(&base, 1)?.domain.mesh)?;
//! let (domain, sizing) = (Domain::identity(&surface), Sizing::uniform(surface.mesh()));
//! let found = reconnect(&surface, &domain, &sizing, &ReconnectOptions::default(), |_edit| true)?;
//! assert!(found.energy_at_end < 0.5 * found.energy_at_start);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod base_face;
mod change;
mod editable_base;
mod error;
mod exchange;
mod flip;
mod options;
mod reconnect;
mod reconnected;
mod region;
mod remove;
mod search;
mod split;
mod trial;

pub use error::ReconnectError;
pub use options::ReconnectOptions;
pub use reconnect::reconnect;
pub use reconnected::Reconnected;
