//! A small surface that stands for a dense one while its base mesh is made.
//!
//! Most of what leads to a base mesh takes time in proportion to the faces that it runs on, and needs some twenty to thirty faces for
//! each base face. [`Proxy::new`] merges the vertices of a dense surface by quadrics (Garland and Heckbert 1997) until it has about that many,
//! with all corners, arcs and sheets kept. [`Proxy::carried`] brings what was made on it back to the dense surface.
//!
//! ```
//! use proxy::{Proxy, ProxyOptions};
//! use region_map::{Domain, Sizing, Surface};
//!
//! let dense = Surface::with_creases(fixtures::cube(20), 40.0)?;
//! let options = ProxyOptions { faces: 300, longest_edge: 0.5, distance: 0.01 };
//! let proxy = Proxy::new(&dense, &Sizing::uniform(dense.mesh()), &options)?;
//! assert!(proxy.surface.mesh().n_faces() <= 300);
//! let domain = proxy.carried(&Domain::identity(&proxy.surface), &dense)?;
//! assert!(domain.check(dense.network()).is_ok());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod carry;
mod collapse;
mod error;
mod options;
mod proxy;
mod quadric;
mod triangles;

pub use error::ProxyError;
pub use options::ProxyOptions;
pub use proxy::Proxy;
