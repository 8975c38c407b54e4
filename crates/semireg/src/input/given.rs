//! A base mesh that the options give, made sound.

use crate::Error;
use mesh_core::{CleanOptions, CleanReport, Cleaned, Soup, Topology, TriMesh};

/// A base mesh of the user's that is a manifold.
pub(crate) struct GivenBase {
    /// Its vertices and faces, in their order.
    pub(crate) mesh: TriMesh,
    /// What was repaired.
    pub(crate) warnings: Vec<String>,
}

impl GivenBase {
    /// Takes a base mesh as it is where that is a manifold in one order of indices, else cleans it.
    ///
    /// Cleaning merges vertices at the same place, which a base mesh of ours has where surfaces touch.
    pub(super) fn new(soup: &Soup) -> Result<Self, Error> {
        let as_it_is = TriMesh::new(soup.positions.clone(), soup.triangles.clone());
        if let Ok(mesh) = as_it_is
            && let Ok(topology) = Topology::new(mesh.faces(), mesh.n_vertices())
            && mesh.positions().ids().all(|v| topology.valence(v) > 0)
            // An stl is a heap of single triangles.
            && mesh.faces().ids().all(|f| topology.neighbours(f).iter().any(Option::is_some))
        {
            return Ok(Self { mesh, warnings: Vec::new() });
        }
        let Cleaned { mesh, report, .. } = mesh_core::clean(soup, &CleanOptions::default()).map_err(Error::CleanBase)?;
        let CleanReport { non_manifold_edges, orientation_cuts, vertex_copies, .. } = report;
        if non_manifold_edges + orientation_cuts + vertex_copies > 0 {
            return Err(Error::BaseNotManifold { edges: non_manifold_edges + orientation_cuts, vertices: vertex_copies });
        }
        let same = CleanReport {
            merged_exactly: report.merged_exactly,
            turned: report.turned,
            open_t_vertices: report.open_t_vertices,
            ..CleanReport::default()
        };
        let warning = "the base mesh was repaired first (unused vertices, needles, repeated triangles)";
        Ok(Self { mesh, warnings: if report == same { Vec::new() } else { vec![warning.into()] } })
    }
}
