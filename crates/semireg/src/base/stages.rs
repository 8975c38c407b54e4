//! What the stages up to the base mesh made.

use super::patches::Patches;
use super::way::Way;
use crate::Error;
use mesh_core::{Cleaned, TriMesh};
use proxy::Proxy;
use region_map::{BaseMesh, CreaseLengths, Domain, Surface};
use std::sync::Arc;
use trace_base::Untraced;

/// What the stages up to the base mesh made.
#[derive(Clone, Debug)]
pub struct BaseStages {
    /// The input with its repairs.
    pub cleaned: Arc<Cleaned>,
    /// The working mesh with its corners, arcs and sheets.
    pub surface: Surface,
    /// What stands for a dense working mesh: patches and the base mesh are over its surface. `None` where they are over the working mesh.
    pub proxy: Option<Arc<Proxy>>,
    /// The paper's way to a base mesh; `None` where it led to none, and with a base mesh from elsewhere.
    pub patches: Option<Arc<Patches>>,
    /// Where the base mesh comes from.
    pub way: Way,
    /// The base mesh.
    pub base: Arc<Base>,
    /// Its vertices: asked, needed and made.
    pub counts: BaseCounts,
    /// What did not go as usual.
    pub warnings: Vec<String>,
}

/// A base mesh over the surface.
#[derive(Clone, Debug)]
pub enum Base {
    /// With a bijection to the working mesh.
    Mapped(BaseMesh),
    /// One from elsewhere, whose edges cannot be traced: rays place what is subdivided from it.
    Unmapped {
        /// Its mesh over the surface.
        domain: Domain,
        /// Why it has no map.
        reason: Untraced,
    },
}

impl Base {
    /// Its mesh over the surface.
    pub fn domain(&self) -> &Domain {
        match self {
            Self::Mapped(base) => &base.domain,
            Self::Unmapped { domain, .. } => domain,
        }
    }

    /// Vertices and faces.
    pub fn mesh(&self) -> &TriMesh {
        &self.domain().mesh
    }

    /// The base mesh with its map, where it has one.
    pub fn mapped(&self) -> Option<&BaseMesh> {
        match self {
            Self::Mapped(base) => Some(base),
            Self::Unmapped { .. } => None,
        }
    }
}

/// How many base vertices there are, and why.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BaseCounts {
    /// What was asked for.
    pub asked: usize,
    /// The least that the topology and the kept network need.
    pub needed: usize,
    /// What there is.
    pub made: usize,
    /// Why more were made than asked for; empty where the request was met.
    pub reason: String,
}

/// How the surface was cut up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CellCounts {
    /// Patches of the paper's way to a base mesh.
    pub patches: usize,
    /// Corners of the network.
    pub corners: usize,
    /// Arcs of the network.
    pub arcs: usize,
}

impl BaseStages {
    /// The surface that patches and the base mesh are over.
    pub fn base_surface(&self) -> &Surface {
        self.proxy.as_ref().map_or(&self.surface, |proxy| &proxy.surface)
    }

    /// The base mesh with its vertices on the working mesh.
    pub fn on_working_mesh(&self) -> Result<Domain, Error> {
        let domain = self.base.domain();
        Ok(match &self.proxy {
            Some(proxy) => proxy.carried(domain, &self.surface)?,
            None => domain.clone(),
        })
    }

    /// How the surface was cut up.
    pub fn cell_counts(&self) -> CellCounts {
        let network = self.surface.network();
        CellCounts {
            patches: self.patches.as_ref().map_or(0, |p| p.segmentation.n_patches),
            corners: network.corners.len(),
            arcs: network.arcs.len(),
        }
    }

    /// Length of the creases that were kept in the network, and of those that were left out as minor, in the units of the mesh.
    pub fn crease_lengths(&self) -> CreaseLengths {
        self.surface.network().crease_lengths(self.surface.mesh())
    }
}
