//! All measures between an original and a remeshed surface at once.

use crate::creases::{CreaseCover, border_distance, crease_cover};
use crate::distance::{DEFAULT_SAMPLES, Distance, Stats, one_way};
use crate::error::{MeasureError, NoSurface};
use crate::faults::flipped;
use crate::intersections;
use crate::new_cuts::away_from_own;
use crate::quality::{self, Quality};
use crate::reference::Reference;
use crate::sampling;
use crate::topology::Topologies;
use crate::weld::Welded;
use mesh_core::{FaceId, SurfaceIndex, TriMesh};

/// The most points that are sampled on a surface.
const MOST_SAMPLES: usize = 10_000_000;

/// How to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeasureOptions {
    /// Points sampled on each surface for the distances, from 1 to 10 million (less and more count as these). More cost time in
    /// proportion; the sampling error falls with the root. Default [`DEFAULT_SAMPLES`].
    pub samples: usize,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self { samples: DEFAULT_SAMPLES }
    }
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
    /// Those of them that are away from where the original cuts itself ([`crate::new_cuts`]).
    pub new_self_intersecting: usize,
    /// Counts of the original.
    pub original_topology: Topologies,
    /// Counts of the remeshed mesh.
    pub remeshed_topology: Topologies,
}

/// Measures a remeshed mesh against its original. Fails with [`MeasureError::Remeshed`] where it has no area, or one that
/// overflows, and with [`MeasureError::Interrupted`] between two measures.
pub fn measure(original: &Reference, remeshed: &TriMesh, options: &MeasureOptions) -> Result<Measures, MeasureError> {
    NoSurface::check(remeshed).map_err(MeasureError::Remeshed)?;
    let (welded, unit) = (Welded::of(remeshed), original.diagonal());
    original.go_on()?;
    let index = SurfaceIndex::new(remeshed);
    original.go_on()?;
    let samples = options.samples.clamp(1, MOST_SAMPLES);
    let on_remeshed = sampling::on_faces(remeshed, samples);
    let forward = one_way(&on_remeshed, welded.mesh().positions().as_slice(), original.index(), unit);
    original.go_on()?;
    let backward = one_way(&original.samples(samples), original.vertices(), &index, unit);
    original.go_on()?;
    let (creases, border) =
        (crease_cover(original.on_creases(), &welded, unit), border_distance(original.on_border(), &welded, unit));
    original.go_on()?;
    let flipped = original.topologies().indexed.oriented.then(|| flipped(original, remeshed));
    original.go_on()?;
    let original_self_intersecting = original.self_intersecting().len();
    original.go_on()?;
    let remeshed_self_intersecting = intersections::among(remeshed, &welded, &index);
    original.go_on()?;
    let new_self_intersecting = away_from_own(original, remeshed, &remeshed_self_intersecting).len();
    original.go_on()?;
    Ok(Measures {
        quality: quality::with_welded(remeshed, &welded),
        distance: Distance { forward, backward },
        creases,
        border,
        flipped,
        original_self_intersecting,
        remeshed_self_intersecting: remeshed_self_intersecting.len(),
        new_self_intersecting,
        original_topology: original.topologies(),
        remeshed_topology: Topologies::of(remeshed, &welded),
    })
}
