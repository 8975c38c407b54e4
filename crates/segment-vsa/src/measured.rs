//! What the stage knows of the working mesh, measured once.

use glam::DVec3;
use mesh_core::{FaceId, IdVec, Interrupt, Topology, TriMesh};
use region_map::{Network, Surface};

/// The working mesh with normals, areas and centroids of its faces.
pub(crate) struct Measured<'a> {
    pub(crate) mesh: &'a TriMesh,
    pub(crate) topology: &'a Topology,
    pub(crate) network: &'a Network,
    pub(crate) normals: IdVec<FaceId, DVec3>,
    pub(crate) areas: IdVec<FaceId, f64>,
    pub(crate) centroids: IdVec<FaceId, DVec3>,
    pub(crate) total_area: f64,
    pub(crate) interrupt: &'a Interrupt,
}

impl<'a> Measured<'a> {
    pub(crate) fn new(surface: &'a Surface) -> Self {
        let (mesh, topology, network) = (surface.mesh(), surface.topology(), surface.network());
        let areas = mesh.areas();
        let total_area = areas.iter().sum();
        let centroids = mesh.faces().ids().map(|f| mesh.centroid(f)).collect();
        let (normals, interrupt) = (mesh.normals(), surface.interrupt());
        Self { mesh, topology, network, normals, areas, centroids, total_area, interrupt }
    }
}
