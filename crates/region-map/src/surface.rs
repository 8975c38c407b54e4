//! [`Surface`]: what every stage from the features on runs on.

use crate::{ArcKind, Network, NetworkError, SheetId, SheetNormals};
use mesh_core::{IdVec, Interrupt, SurfaceIndex, Topology, TopologyError, TriMesh, VertexId};
use std::sync::{Arc as Shared, OnceLock};

/// The surface that a domain mesh moves on: the working mesh with its topology, cut into sheets by a network.
///
/// It owns all of its parts. A copy shares them, and so do the indices for closest points and rays, which are built when they are first
/// asked for: each is built once, however many stages and copies ask.
#[derive(Clone, Debug)]
pub struct Surface {
    working: Shared<Working>,
    network: Shared<Network>,
    normals: Shared<OnceLock<SheetNormals>>,
    sheet_indices: Shared<OnceLock<IdVec<SheetId, SurfaceIndex>>>,
    interrupt: Interrupt,
}

/// What does not depend on the network.
#[derive(Debug)]
struct Working {
    mesh: Shared<TriMesh>,
    topology: Shared<Topology>,
    index: OnceLock<SurfaceIndex>,
}

/// Why a mesh, its topology and a network are no surface.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// The mesh is not an oriented manifold.
    #[error("the mesh is not an oriented manifold: {0}; clean it first")]
    NotManifold(#[from] TopologyError),
    /// The topology joins other vertices than the faces of the mesh do.
    #[error("the topology is not that of the mesh")]
    OtherTopology,
    /// The network does not fit the mesh.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// A vertex belongs to no face.
    #[error("vertex {0} belongs to no face; clean the mesh first")]
    UnusedVertex(VertexId),
}

impl Surface {
    /// The surface of a mesh without creases: its borders are the only arcs.
    ///
    /// Fails where the mesh is no oriented manifold or has a vertex without faces.
    ///
    /// ```
    /// use mesh_core::TriMesh;
    /// use region_map::Surface;
    ///
    /// let mesh = TriMesh::new(fixtures::icosphere(4).positions().as_slice().to_vec(), fixtures::icosphere(4).to_soup().triangles)?;
    /// let surface = Surface::smooth(mesh)?;
    /// assert_eq!((surface.network().arcs.len(), surface.network().n_sheets), (0, 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn smooth(mesh: TriMesh) -> Result<Self, SurfaceError> {
        Self::with_creases(mesh, f64::INFINITY)
    }

    /// The surface of a mesh with its borders, and the edges between faces whose normals are more than `degrees` apart, as arcs.
    ///
    /// For meshes without noise; the crate `features` weighs what it finds. Fails as [`Surface::smooth`] does.
    pub fn with_creases(mesh: TriMesh, degrees: f64) -> Result<Self, SurfaceError> {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
        let kinds = ArcKind::by_angle(&mesh, &topology, degrees);
        let network = Network::trace(&mesh, &topology, &kinds, |_| false, Vec::new())?;
        Self::new(mesh, topology, network)
    }

    /// The surface of a mesh with its topology and a network on it. All three are shared, not copied, where they come shared.
    ///
    /// Fails where they are of different meshes, where the network names parts that are not there, or where a vertex has no face.
    pub fn new(
        mesh: impl Into<Shared<TriMesh>>,
        topology: impl Into<Shared<Topology>>,
        network: Network,
    ) -> Result<Self, SurfaceError> {
        let (mesh, topology) = (mesh.into(), topology.into());
        network.check(&mesh, &topology)?;
        if topology.faces() != mesh.faces() {
            return Err(SurfaceError::OtherTopology);
        }
        if let Some(v) = mesh.positions().ids().find(|&v| topology.fan(v).next().is_none()) {
            return Err(SurfaceError::UnusedVertex(v));
        }
        let working = Working { mesh, topology, index: OnceLock::new() };
        Ok(Self::of(Shared::new(working), network, Interrupt::default()))
    }

    /// The same mesh with another network. Fails where that is of another mesh.
    pub fn with_network(&self, network: Network) -> Result<Self, SurfaceError> {
        network.check(self.mesh(), self.topology())?;
        Ok(Self::of(self.working.clone(), network, self.interrupt.clone()))
    }

    /// The same surface with a flag that ends the stages that run on it: each then returns soon, with what it has.
    pub fn with_interrupt(self, interrupt: Interrupt) -> Self {
        Self { interrupt, ..self }
    }

    /// The flag that ends the stages that run on this surface. Nobody sets it unless [`Surface::with_interrupt`] gave it.
    pub fn interrupt(&self) -> &Interrupt {
        &self.interrupt
    }

    fn of(working: Shared<Working>, network: Network, interrupt: Interrupt) -> Self {
        let (normals, sheet_indices) = (Shared::default(), Shared::default());
        Self { working, network: Shared::new(network), normals, sheet_indices, interrupt }
    }

    /// The working mesh.
    pub fn mesh(&self) -> &TriMesh {
        &self.working.mesh
    }

    /// Its connectivity.
    pub fn topology(&self) -> &Topology {
        &self.working.topology
    }

    /// Its connectivity, to be shared.
    pub(crate) fn shared_topology(&self) -> Shared<Topology> {
        self.working.topology.clone()
    }

    /// Its corners, arcs and sheets.
    pub fn network(&self) -> &Network {
        &self.network
    }

    /// Its one-sided normals.
    pub fn normals(&self) -> &SheetNormals {
        self.normals.get_or_init(|| SheetNormals::new(self.mesh(), self.topology(), self.network()))
    }

    /// The index of all faces of the working mesh.
    pub fn index(&self) -> &SurfaceIndex {
        self.working.index.get_or_init(|| SurfaceIndex::new(self.mesh()))
    }

    /// The index of the faces of a sheet; `None` for a sheet that is not there.
    pub fn sheet_index(&self, sheet: SheetId) -> Option<&SurfaceIndex> {
        self.sheet_indices.get_or_init(|| self.indices_of_sheets()).get(sheet)
    }

    fn indices_of_sheets(&self) -> IdVec<SheetId, SurfaceIndex> {
        let mut faces = IdVec::filled(Vec::new(), self.network.n_sheets);
        for (f, &s) in self.network.sheet_of_face.enumerate() {
            faces[s].push(f);
        }
        faces.iter().map(|list: &Vec<_>| SurfaceIndex::of_faces(self.mesh(), list.iter().copied())).collect()
    }
}
