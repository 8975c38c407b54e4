//! All measures between an original and a remeshed surface at once.

use crate::creases::{CreaseCover, border_distance, crease_cover};
use crate::distance::{DEFAULT_SAMPLES, Distance, Stats, distance};
use crate::intersections::self_intersecting;
use crate::orientation::flipped;
use crate::quality::{Quality, quality};
use crate::surface::{NoSurface, Surface};
use crate::topology::TopologyCounts;
use mesh_core::{FaceId, TriMesh};

/// How to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeasureOptions {
    /// Points sampled on each surface for the distances, at least 1. More cost time in proportion; the sampling error falls with
    /// the root. Default [`DEFAULT_SAMPLES`].
    pub samples: usize,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self { samples: DEFAULT_SAMPLES }
    }
}

/// One of two meshes cannot be measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum MeasureError {
    /// The original.
    #[error("original: {0}")]
    Original(NoSurface),
    /// The remeshed one.
    #[error("remeshed: {0}")]
    Remeshed(NoSurface),
}

/// Counts of one mesh as its indices say, and as its positions say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Topologies {
    /// As indexed.
    pub indexed: TopologyCounts,
    /// After an exact weld.
    pub welded: TopologyCounts,
}

/// Everything that is measured between two meshes. Lengths are in parts of the original's box diagonal.
#[derive(Clone, Debug, PartialEq)]
pub struct Measures {
    /// Shape of the remeshed triangles.
    pub quality: Quality,
    /// Distance both ways.
    pub distance: Distance,
    /// How the original's creases are kept; `None` when it has none.
    pub creases: Option<CreaseCover>,
    /// From the original's border to the remeshed one's; `None` when one has none.
    pub border: Option<Stats>,
    /// Faces of the remeshed mesh that face the wrong way; `None` when the original does not say which way is right, because it
    /// is not consistently oriented.
    pub flipped: Option<Vec<FaceId>>,
    /// Faces of the original that intersect others.
    pub original_self_intersecting: usize,
    /// Faces of the remeshed mesh that intersect others.
    pub remeshed_self_intersecting: usize,
    /// Counts of the original.
    pub original_topology: Topologies,
    /// Counts of the remeshed mesh.
    pub remeshed_topology: Topologies,
}

/// Measures a remeshed mesh against its original.
pub fn measure(original: &TriMesh, remeshed: &TriMesh, options: &MeasureOptions) -> Result<Measures, MeasureError> {
    let original = Surface::new(original).map_err(MeasureError::Original)?;
    let remeshed = Surface::new(remeshed).map_err(MeasureError::Remeshed)?;
    let original_topology = topologies(&original);
    Ok(Measures {
        quality: quality(remeshed.mesh),
        distance: distance(&original, &remeshed, options.samples.max(1)),
        creases: crease_cover(&original, &remeshed),
        border: border_distance(&original, &remeshed),
        flipped: original_topology.indexed.oriented.then(|| flipped(&original, remeshed.mesh)),
        original_self_intersecting: self_intersecting(&original).len(),
        remeshed_self_intersecting: self_intersecting(&remeshed).len(),
        original_topology,
        remeshed_topology: topologies(&remeshed),
    })
}

fn topologies(surface: &Surface) -> Topologies {
    let of = |mesh: &TriMesh| TopologyCounts::of(mesh.faces());
    Topologies { indexed: of(surface.mesh), welded: of(&surface.welded) }
}
