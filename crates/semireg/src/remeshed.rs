//! [`Remeshed`] and [`Based`]: what a run gives.

use crate::attempt::Attempt;
use crate::base::BaseStages;
use crate::report::Report;
use crate::run::StageSeconds;
use mesh_core::{IdVec, TriMesh, VertexId};
use region_map::{RegionMap, Surface};

/// A finished mesh and how it came about.
#[derive(Clone, Debug)]
pub struct Remeshed {
    /// The certified semi-regular mesh.
    pub mesh: TriMesh,
    /// What was done, in figures.
    pub report: Report,
    /// What every stage made.
    pub stages: Stages,
}

/// What the stages from the base mesh on made.
#[derive(Clone, Debug)]
pub struct Stages {
    /// Up to the base mesh.
    pub base: BaseStages,
    /// The subdivided base before projection.
    pub subdivided: TriMesh,
    /// After the first projection.
    pub projected: TriMesh,
    /// The surface with the network of the result: that of the base, with bends and minor creases that the finest level was snapped to.
    pub surface: Surface,
    /// The region map of the result on that network.
    pub region: RegionMap,
    /// How far each vertex of the result is off its point of that map, along the surface's normal there, in the units of the mesh.
    pub offsets: IdVec<VertexId, f64>,
}

/// A base mesh and how it came about.
#[derive(Clone, Debug)]
pub struct Based {
    /// What every stage made.
    pub stages: BaseStages,
    /// What was tried, in order.
    pub attempts: Vec<Attempt>,
    /// Wall time of the stages.
    pub seconds: StageSeconds,
}
