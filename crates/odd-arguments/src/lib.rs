//! Arguments that nobody means to hand in, for property tests: whatever they are, a verb gives a result or an error.
//!
//! ```
//! use odd_arguments::{damaged, shape};
//! use region_map::{Domain, Surface};
//!
//! let surface = Surface::with_creases(shape(1, 1.0), 40.0)?;
//! let domain = Domain::identity(&surface);
//! assert!(domain.check(surface.network()).is_ok());
//! assert!(damaged(&domain, 3, 1_000, 0.0, shape(0, 1.0)).check(surface.network()).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod domain;
mod number;
mod shape;

pub use domain::damaged;
pub use number::{id, odd, unit, value};
pub use shape::shape;
