//! [`Reference`]: the mesh that results are measured against.

use crate::creases;
use crate::distance::DEFAULT_SAMPLES;
use crate::error::{MeasureError, NoSurface};
use crate::intersections;
use crate::own_cuts;
use crate::sampling;
use crate::topology::Topologies;
use crate::weld::Welded;
use glam::DVec3;
use mesh_core::{FaceId, Interrupt, SurfaceIndex, TriMesh};
use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

/// The mesh that results are measured against (the cleaned input of a remeshing), with all that the measures need of it.
///
/// Make it once and share it for all results: it owns what it holds. What only some measures need is computed when it is first
/// asked for, and kept.
#[derive(Debug)]
pub struct Reference {
    mesh: Arc<TriMesh>,
    welded: Welded,
    index: SurfaceIndex,
    diagonal: f64,
    interrupt: Interrupt,
    topologies: OnceLock<Topologies>,
    self_intersecting: OnceLock<Vec<FaceId>>,
    own_cuts: OnceLock<SurfaceIndex>,
    samples: OnceLock<Vec<DVec3>>,
    on_creases: OnceLock<Vec<DVec3>>,
    on_border: OnceLock<Vec<DVec3>>,
}

impl Reference {
    /// Prepares a mesh. Fails with [`MeasureError::Original`] on one without area, or with one that overflows.
    pub fn new(mesh: impl Into<Arc<TriMesh>>) -> Result<Self, MeasureError> {
        let mesh = mesh.into();
        NoSurface::check(&mesh).map_err(MeasureError::Original)?;
        Ok(Self {
            welded: Welded::of(&mesh),
            index: SurfaceIndex::new(&mesh),
            diagonal: mesh.diagonal(),
            mesh,
            interrupt: Interrupt::default(),
            topologies: OnceLock::new(),
            self_intersecting: OnceLock::new(),
            own_cuts: OnceLock::new(),
            samples: OnceLock::new(),
            on_creases: OnceLock::new(),
            on_border: OnceLock::new(),
        })
    }

    /// The same with a flag that ends what is measured against it, with [`MeasureError::Interrupted`].
    pub fn with_interrupt(self, interrupt: Interrupt) -> Self {
        Self { interrupt, ..self }
    }

    /// Fails when the caller has ended it.
    pub(crate) fn go_on(&self) -> Result<(), MeasureError> {
        if self.interrupt.is_set() { Err(MeasureError::Interrupted) } else { Ok(()) }
    }

    /// The mesh as it is.
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// Closest points on the mesh as it is.
    pub fn index(&self) -> &SurfaceIndex {
        &self.index
    }

    /// Diagonal of the box of the mesh, the unit of all lengths that are measured; above 0.
    pub fn diagonal(&self) -> f64 {
        self.diagonal
    }

    /// Counts of the mesh as its indices say, and as its positions say.
    pub fn topologies(&self) -> Topologies {
        *self.topologies.get_or_init(|| Topologies::of(&self.mesh, &self.welded))
    }

    /// The faces of the mesh that intersect others, in rising order (see [`crate::self_intersecting`]).
    pub fn self_intersecting(&self) -> &[FaceId] {
        self.self_intersecting.get_or_init(|| intersections::among(&self.mesh, &self.welded, &self.index))
    }

    /// Closest points on small pieces of the mesh where it cuts itself.
    pub(crate) fn own_cuts(&self) -> &SurfaceIndex {
        let pieces = || own_cuts::pieces(&self.mesh, self.self_intersecting(), self.diagonal);
        self.own_cuts.get_or_init(|| SurfaceIndex::new(&pieces()))
    }

    /// Every position of the mesh once.
    pub(crate) fn vertices(&self) -> &[DVec3] {
        self.welded.mesh().positions().as_slice()
    }

    /// `n` points of the surface, spread by area.
    pub(crate) fn samples(&self, n: usize) -> Cow<'_, [DVec3]> {
        let sample = || sampling::on_faces(&self.mesh, n);
        // Another number is that of a single comparison.
        if n == DEFAULT_SAMPLES { Cow::Borrowed(self.samples.get_or_init(sample)) } else { Cow::Owned(sample()) }
    }

    /// Points of the creases, spread by length.
    pub(crate) fn on_creases(&self) -> &[DVec3] {
        self.on_creases.get_or_init(|| creases::on_creases(&self.welded))
    }

    /// Points of the border, spread by length.
    pub(crate) fn on_border(&self) -> &[DVec3] {
        self.on_border.get_or_init(|| creases::on_border(&self.welded))
    }
}
