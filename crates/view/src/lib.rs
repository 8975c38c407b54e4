//! Pictures of meshes and stages, on the CPU alone: shaded PNG by a z-buffer of our own, and flat charts as SVG.
//!
//! ```
//! use glam::DVec3;
//! use mesh_core::TriMesh;
//! use view::{Scene, ViewOptions, render};
//!
//! let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
//! let mesh = TriMesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).unwrap();
//! let image = render(&Scene::new(&mesh), &ViewOptions::default());
//! assert!(image.to_png_bytes().is_ok());
//! ```

mod camera;
mod color;
mod image;
mod raster;
mod scene;
mod svg;

pub use camera::{View, close_up};
pub use color::{Rgb, distance_color, palette, quality_color, valence_color};
pub use image::{Image, ImageError};
pub use scene::{Line, Point, Scene, ViewOptions, render};
pub use svg::Chart;
