//! The base mesh: every patch charted onto a convex polygon, its sites joined by a constrained Delaunay triangulation there, all
//! patches joined to one simplicial mesh with a bijective map to the input (paper, section 3.2), and its connectivity improved.
//!
//! ```
//! use basemesh::{BaseOptions, build};
//! use glam::DVec3;
//! use mesh_core::{FaceId, Topology};
//! use region_map::{Cells, SheetNormals, Sizing, Surface};
//! use segment_cvt::{CvtOptions, sample};
//!
//! let mesh = fixtures::cube(6);
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let network = features::detect(&mesh, &topology, &Default::default())?;
//! let (segmentation, _) = segment_vsa::segment(&mesh, &topology, &network, &Default::default())?;
//! let cells = Cells::trace(&mesh, &topology, &network, &segmentation)?;
//! let wanted = CvtOptions { base_vertices: 50, ..Default::default() };
//! let sites = sample(&mesh, &cells, &Sizing::uniform(&mesh), &wanted)?.sites;
//!
//! let normals = SheetNormals::new(&mesh, &topology, &network);
//! let surface = Surface { mesh: &mesh, topology: &topology, network: &network, normals: &normals };
//! let options = BaseOptions { base_vertices: 50, ..Default::default() };
//! let base = build(&surface, &cells, &sites, &Sizing::uniform(&mesh), &options)?;
//! assert_eq!(base.mesh.n_vertices(), 50);
//!
//! // The map: from a point of a base face to the cube, and back.
//! let weights = DVec3::new(0.2, 0.3, 0.5);
//! let point = base.locate(FaceId(0), weights);
//! let (face, back) = base.map.find(point).unwrap();
//! assert_eq!(face, base.map_faces[FaceId(0)]);
//! assert!(back.distance(weights) < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assemble;
mod bisect;
mod build;
mod chart;
mod decimate;
mod editor;
mod error;
mod flips;
mod improve;
mod layout;
mod mend;
mod patch_cdt;
mod piece_mesh;
mod polygon;
mod replay;
mod shape;
#[cfg(test)]
mod shapes;
mod star;
#[cfg(test)]
mod tests;
mod tutte;

pub use bisect::bisect;
pub use build::{BaseOptions, build};
pub use decimate::decimate;
pub use error::BaseError;
pub use mend::{Mended, mend};
pub use replay::Replay;
pub use tutte::lay_flat;
