//! A semi-regular mesh as its base mesh and, for each level, displacements of the new vertices.
//!
//! A new vertex of a level is predicted in the middle of its edge of the level before. Its displacement from there has a part along the
//! normal of that edge, the *scalar displacement*, and a part across it, the *tangential residual*; [`Frame`] says along which axes. With both
//! the mesh comes back to rounding. Where vertices were placed along normals, the residual is small and can be dropped; where they were moved along
//! the surface, as in a relaxed mesh, it is as large as the scalar.
//!
//! ```
//! use displacement::{EncodeOptions, Residual, encode, figures};
//! use mesh_core::TriMesh;
//!
//! // A triangle, and its one subdivision with the middles lifted by .1.
//! let positions = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.1], [1.0, 1.0, 0.1], [0.0, 1.0, 0.1]];
//! let mesh = TriMesh::from_slices(&positions, &[[0, 3, 5], [1, 4, 3], [2, 5, 4], [4, 5, 3]])?;
//!
//! let displacement = encode(&mesh, 1, &EncodeOptions::default())?;
//! assert_eq!(displacement.base.face_arrays(), [[0, 1, 2]]);
//! assert_eq!(displacement.levels[0].scalar.values(), [0.1; 3]);
//! assert_eq!(displacement.levels[0].residual.values(), [0.0; 6]);
//! assert_eq!(displacement.decode(1, Residual::Dropped)?, mesh);
//!
//! let figures = figures(&displacement, &mesh)?;
//! assert_eq!((figures.levels[0].residual.rms, figures.without_residual.greatest), (0.0, 0.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod coefficients;
mod decode;
mod displacement;
mod encode;
mod error;
mod figures;
mod frame;
mod level;

pub use coefficients::Coefficients;
pub use displacement::{Displacement, LevelDisplacement, Residual};
pub use encode::{EncodeOptions, encode};
pub use error::DisplacementError;
pub use figures::{Figures, LevelFigures, Size, figures};
pub use frame::Frame;
