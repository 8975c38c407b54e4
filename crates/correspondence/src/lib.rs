//! Where everything of a semi-regular result is on the input and the other way round, and how its levels hang together.
//!
//! [`Levels`] reads the levels from the order of the faces; [`FaceOrder`] writes them in another one. [`Map`] has, in plain arrays, a
//! triangle of the input for every vertex of the result, a face of the result for every vertex of the input, parents, and prolongations.
//!
//! ```
//! use correspondence::{FaceOrder, Levels, Map, Source, Start};
//! use mesh_core::{CleanOptions, FaceId, IdVec, Soup, TriMesh, clean};
//!
//! // A triangle, and its one subdivision with the middles lifted by .1.
//! let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
//! let soup = Soup::from_slices(&corners, &[[0, 1, 2]]);
//! let cleaned = clean(&soup, &CleanOptions::default())?;
//! let middles = [[1.0, 0.0, 0.1], [1.0, 1.0, 0.1], [0.0, 1.0, 0.1]];
//! let faces = [[0, 3, 5], [1, 4, 3], [2, 5, 4], [4, 5, 3]];
//! let result = TriMesh::from_slices(&[corners, middles].concat(), &faces)?;
//! assert_eq!(Levels::new(&result, 1)?.mesh(0)?.face_arrays(), [[0, 1, 2]]);
//!
//! let starts: IdVec<_, _> = result.positions().iter().map(|&position| Start { face: FaceId(0), position }).collect();
//! let map = Map::new(&Source { soup: &soup, cleaned: &cleaned }, &result, 1, &starts, FaceOrder::Children)?;
//! assert_eq!((map.source_face[3], map.source_barycentric[3], map.offset[3]), (0, [0.5, 0.5, 0.0], 0.1));
//! assert_eq!((map.result_face[2], map.result_barycentric[2]), (2, [1.0, 0.0, 0.0]));
//! assert_eq!((map.parents[0][4], map.base_face[3]), ([1, 2], 0));
//! assert_eq!(map.prolongations[0].shape, [6, 3]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod levels;
mod map;
mod order;
mod prolongation;
mod result;
mod source;

pub use error::CorrespondenceError;
pub use levels::Levels;
pub use map::Map;
pub use order::FaceOrder;
pub use prolongation::Prolongation;
pub use source::{Source, Start};
