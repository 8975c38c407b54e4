//! How long base edges may be at every place.
//!
//! Where the surface or an arc bends, edges are short enough to follow it (a limb thinner than an edge would be lost), and lengths
//! change gradually.
//!
//! ```
//! use mesh_core::Topology;
//! use region_map::{SheetNormals, Surface};
//! use sizing::{SizingOptions, sizing};
//!
//! // Base edges of length 2 are too long for a sphere of radius 1: along one it would turn by 2 radians, more than `turn`.
//! let mesh = fixtures::icosphere(20);
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let network = features::detect(&mesh, &topology, &Default::default())?;
//! let normals = SheetNormals::new(&mesh, &topology, &network);
//! let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
//! let field = sizing(&surface, &SizingOptions::new(2.0));
//! assert!(field.relative.iter().all(|h| (h - 0.8).abs() < 0.05));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cells;
mod curvature;
mod gradation;
mod sizing;

pub use sizing::{SizingOptions, sizing};
