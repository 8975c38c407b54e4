//! Where the base vertices shall be: on arcs by arc length, inside patches by centroidal Voronoi relaxation (paper, section 3.2).
//!
//! [`sample`] takes the cells of a segmentation, a sizing field and a number of base vertices, and returns [`region_map::Sites`].
//!
//! ```
//! use mesh_core::Topology;
//! use region_map::{ArcKind, Cells, Network, PatchId, Segmentation, Sizing};
//! use segment_cvt::{CvtOptions, sample};
//!
//! // A rectangle of two triangles: one patch in one border loop.
//! let mesh = fixtures::plane();
//! let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
//! let kinds = topology.edge_ids().map(|e| topology.is_border_edge(e).then_some(ArcKind::Border)).collect();
//! let network = Network::trace(&mesh, &topology, &kinds, |_| true, Vec::new());
//! let segmentation = Segmentation { patch_of_face: mesh.faces().iter().map(|_| PatchId(0)).collect(), n_patches: 1 };
//! let cells = Cells::trace(&mesh, &topology, &network, &segmentation)?;
//!
//! let options = CvtOptions { base_vertices: 50, ..CvtOptions::default() };
//! let sampled = sample(&mesh, &cells, &Sizing::uniform(&mesh), &options)?;
//! let on_arcs: usize = sampled.sites.on_arcs.iter().map(Vec::len).sum();
//! let inside: usize = sampled.sites.in_patches.iter().map(Vec::len).sum();
//! assert_eq!(cells.corners.len() + on_arcs + inside, 50);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arc_measure;
mod budget;
mod candidates;
mod kd_tree;
mod lloyd;
mod options;
mod sample;

pub use budget::Budget;
pub use options::CvtOptions;
pub use sample::{CvtError, Sampled, sample};
