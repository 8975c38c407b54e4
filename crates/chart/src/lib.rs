//! Parts of a surface laid flat: what the ways to a base mesh have in common.
//!
//! [`lay_flat`] maps a disk of faces, or of pieces of them, onto a convex polygon without a fold. [`chart_patch`] does so for a patch
//! of a segmentation, on a polygon that is like the patch. [`PieceMesh`] cuts faces into pieces where such a chart needs a vertex.
//!
//! ```
//! use chart::{PieceMesh, lay_flat};
//! use glam::{DVec2, DVec3};
//! use mesh_core::TriMesh;
//!
//! // Four faces of a flat pyramid: its base on a square, its apex free.
//! let positions = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 0.5]];
//! let mesh = TriMesh::from_slices(&positions, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])?;
//! let pieces = PieceMesh::of_mesh(&mesh);
//! let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(Some);
//! let fixed = [square.as_slice(), &[None]].concat();
//! let chart = lay_flat(pieces.positions(), pieces.pieces().to_vec(), &fixed).ok_or("it folds")?;
//! assert!(chart.uv()[4].distance(DVec2::splat(0.5)) < 1e-12);
//! assert!(chart.locate(DVec2::splat(0.5)).position(&mesh).distance(DVec3::new(1.0, 1.0, 0.5)) < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod convex_map;
mod patch;
mod pieces;
mod polygon;

pub use convex_map::lay_flat;
pub use patch::{ArcVertex, BorderVertices, PatchChart, PolygonCorner, chart_patch};
pub use pieces::{Cut, Halves, PieceMesh, Thirds};
