//! [`Remeshed`] and [`Based`]: what a run gives.

use crate::attempt::Attempt;
use crate::base::BaseStages;
use crate::report::Report;
use crate::run::StageSeconds;
use correspondence::{CorrespondenceError, FaceOrder, Levels, Map, Source, Start};
use mesh_core::{FaceId, IdVec, Soup, SurfacePoint, TriMesh, VertexId};
use region_map::{RegionMap, Surface};
use std::sync::Arc;

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
    /// For every face of that surface's mesh the face of the cleaned mesh that it lies in (after flips in a plane, one of those).
    pub source_face: Arc<IdVec<FaceId, FaceId>>,
    /// The region map of the result on that network.
    pub region: RegionMap,
    /// How far each vertex of the result is off its point of that map, along the surface's normal there, in the units of the mesh.
    pub offsets: IdVec<VertexId, f64>,
}

impl Remeshed {
    /// The levels of the mesh, each with its vertices where they are in the result. A certified mesh has them.
    pub fn levels(&self) -> Result<Levels<'_>, CorrespondenceError> {
        Levels::new(&self.mesh, self.report.certificate.levels)
    }

    /// The mesh of a level: 0 is the base mesh. Fails where there is no such level.
    pub fn level(&self, level: u32) -> Result<TriMesh, CorrespondenceError> {
        self.levels()?.mesh(level)
    }

    /// Where everything of a level is on the input and the other way round, for faces written in this order.
    ///
    /// `soup` is that which was remeshed. Fails where it is another one, and where there is no such level.
    pub fn map(&self, soup: &Soup, level: u32, order: FaceOrder) -> Result<Map, CorrespondenceError> {
        let mesh = self.level(level)?;
        let (working, region) = (self.stages.surface.mesh(), &self.stages.region);
        let start = |p: &SurfacePoint| Start { face: self.stages.source_face[p.face], position: p.position(working) };
        // The vertices of a level are the first ones of the result.
        let starts = region.points.iter().take(mesh.n_vertices()).map(start).collect();
        let source = Source { soup, cleaned: &self.stages.base.cleaned };
        Map::new(&source, &mesh, level, &starts, order)
    }
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
