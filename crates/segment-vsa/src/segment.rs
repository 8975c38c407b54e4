//! The segmentation: seeds, Lloyd, insertion and merging, straight borders.

use crate::disk::{PatchOf, n_patches};
use crate::grow::grow;
use crate::inflate::inflate;
use crate::measured::Measured;
use crate::merge::{MergeRule, merge};
use crate::proxy::{Metric, Moments, Proxy, refit, worst_faces};
use crate::seeds::first_proxies;
use crate::straighten::straighten;
use mesh_core::IdVec;
use region_map::{PatchId, Segmentation, Surface};

/// Greatest roundness of a union within the bound on the spread. With the jagged borders of growth, a patch of 4 is about six times as long as
/// it is wide. Less leaves more patches, more makes patches that are hard to lay flat.
const MAX_ROUNDNESS: f64 = 4.0;
/// The last rounds neither merge nor insert, so that what was merged and inserted finds its place. Fewer leave ragged patches.
const SETTLING_ROUNDS: usize = 4;
/// Rounds at most: nobody needs more, and a slip of the keyboard shall not run for ever.
const MOST_ROUNDS: usize = 1000;
/// Beyond this weight of the distance normals count for nothing.
const MOST_COMPACT: f64 = 1e6;
/// To come down to the patch budget, normals may spread up to this angle, in degrees. More than a hemisphere cannot be laid flat.
const BUDGET_SPREAD: f64 = 75.0;

/// How fine the patches are.
#[derive(Clone, Debug, PartialEq)]
pub struct VsaOptions {
    /// Bound on the spread of the normals of a patch: the half angle of the spherical cap with the same mean error, in degrees, above
    /// 0 and below 90. Default 40.
    pub max_angle: f64,
    /// No patch is added beyond this number but for what the disk rule needs. At least 1. Default 32.
    pub max_patches: usize,
    /// Rounds of Lloyd, 1 to 1000. Default 10.
    pub rounds: usize,
    /// Length of an edge of the base mesh, in the units of the mesh: patches smaller or narrower than one are merged where that is
    /// possible. 0 merges none for its size. Default 0.
    pub base_edge_length: f64,
    /// Weight of the distance of a face from the middle of its patch beside the difference of normals, 0 to 1e6. Default 0.3: a face at the
    /// rim of a round patch of mean area costs as much as one whose normal is 18 degrees off, and flat and cylindrical parts get fat patches,
    /// not strips. 0 is eq. 1 of the paper.
    pub compactness: f64,
}

impl Default for VsaOptions {
    fn default() -> Self {
        Self { max_angle: 40.0, max_patches: 32, rounds: 10, base_edge_length: 0.0, compactness: 0.3 }
    }
}

/// Why a mesh cannot be segmented with some options.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VsaError {
    /// There is nothing to segment.
    #[error("the mesh has no face with an area, or so large ones that their areas are no numbers")]
    NoSurface,
    /// The bound on the spread is out of range.
    #[error("patch angle {0} must be above 0 and below 90 (degrees)")]
    MaxAngle(f64),
    /// The number of patches is zero.
    #[error("the number of patches must be at least 1")]
    ZeroCount,
    /// The number of rounds is out of range.
    #[error("the number of rounds {0} must be 1 to 1000")]
    Rounds(usize),
    /// The base edge length is negative or not a number.
    #[error("base edge length {0} must be finite and not negative")]
    BaseEdgeLength(f64),
    /// The weight of the distance is out of range.
    #[error("compactness {0} must be 0 to 1e6")]
    Compactness(f64),
}

/// What the segmentation did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VsaReport {
    /// Seeds from the sides of the box.
    pub first_seeds: usize,
    /// Rounds of Lloyd that were run.
    pub rounds: usize,
    /// Patches that were merged after the last round.
    pub merged: usize,
    /// Faces that changed sides to straighten borders.
    pub swaps: usize,
    /// Mean of `|N(t) - N(P)|^2` (eq. 1) over the area, 0 to 4.
    pub error: f64,
    /// Greatest spread of the normals in one patch, in degrees.
    pub max_spread: f64,
}

/// Cuts the surface into disks that are as flat and as few as the options ask.
///
/// Every patch is a disk whose border is one simple cycle of distinct vertices; no arc of the network has the same patch on both
/// sides and no corner of the network lies inside a patch.
pub fn segment(surface: &Surface, options: &VsaOptions) -> Result<(Segmentation, VsaReport), VsaError> {
    let surface = Measured::new(surface);
    check(&surface, options)?;
    let metric = Metric::new(&surface, options.max_patches, options.compactness);
    let proxies = first_proxies(&surface, options.max_patches);
    let mut report = VsaReport { first_seeds: proxies.len(), ..VsaReport::default() };
    let mut patch_of = lloyd(&surface, &metric, proxies, options, &mut report);
    report.merged = merge_to_budget(&surface, &mut patch_of, options);
    report.swaps = straighten(&surface, &mut patch_of);
    report.merged += merge(&surface, &mut patch_of, &within_bound(options));
    report.swaps += straighten(&surface, &mut patch_of);
    inflate(&surface, &mut patch_of, options.base_edge_length);
    judge(&surface, &patch_of, &mut report);
    let n_patches = n_patches(&patch_of);
    Ok((Segmentation { patch_of_face: patch_of.iter().flatten().copied().collect(), n_patches }, report))
}

fn check(surface: &Measured, options: &VsaOptions) -> Result<(), VsaError> {
    if !(surface.total_area.is_finite() && surface.total_area > 0.0) {
        return Err(VsaError::NoSurface);
    }
    if !(options.max_angle > 0.0 && options.max_angle < 90.0) {
        return Err(VsaError::MaxAngle(options.max_angle));
    }
    if options.max_patches == 0 {
        return Err(VsaError::ZeroCount);
    }
    if !(1..=MOST_ROUNDS).contains(&options.rounds) {
        return Err(VsaError::Rounds(options.rounds));
    }
    if !(options.base_edge_length.is_finite() && options.base_edge_length >= 0.0) {
        return Err(VsaError::BaseEdgeLength(options.base_edge_length));
    }
    if !(0.0..=MOST_COMPACT).contains(&options.compactness) {
        return Err(VsaError::Compactness(options.compactness));
    }
    Ok(())
}

/// Grows patches and refits the proxies. Every other round merges what the bound allows, and adds seeds where normals spread too far.
///
/// Faces that no patch could take become thin patches of their own. The rounds between give them the time to grow before they are judged.
fn lloyd(
    surface: &Measured,
    metric: &Metric,
    mut proxies: IdVec<PatchId, Proxy>,
    options: &VsaOptions,
    report: &mut VsaReport,
) -> PatchOf {
    for round in 1..options.rounds {
        if surface.interrupt.is_set() {
            break;
        }
        let mut patch_of = grow(surface, metric, &mut proxies);
        let may_change = round % 2 == 0 && round + SETTLING_ROUNDS <= options.rounds;
        if may_change {
            merge(surface, &mut patch_of, &within_bound(options));
        }
        proxies = refit(surface, metric, &patch_of, n_patches(&patch_of));
        if may_change {
            insert_seeds(surface, metric, &patch_of, &mut proxies, options);
        }
    }
    report.rounds = options.rounds;
    grow(surface, metric, &mut proxies)
}

/// Adds a seed at the worst face of every patch whose normals spread too far, the worst patches first, as far as the budget goes, and
/// beyond it where not even the budget allows such a spread.
fn insert_seeds(
    surface: &Measured,
    metric: &Metric,
    patch_of: &PatchOf,
    proxies: &mut IdVec<PatchId, Proxy>,
    options: &VsaOptions,
) {
    let moments = Moments::of_patches(surface, patch_of, proxies.len());
    let worst = worst_faces(surface, metric, patch_of, proxies);
    let mut wide: Vec<PatchId> = proxies.ids().filter(|&p| moments[p].spread() > options.max_angle).collect();
    wide.sort_by(|&p, &q| moments[q].error().total_cmp(&moments[p].error()).then(p.cmp(&q)));
    for p in wide {
        let may_insert = proxies.len() < options.max_patches || moments[p].spread() > BUDGET_SPREAD;
        if may_insert && worst[p] != proxies[p].seed {
            proxies.push(Proxy::at(surface, worst[p]));
        }
    }
}

fn within_bound(options: &VsaOptions) -> MergeRule {
    MergeRule {
        max_spread: options.max_angle,
        max_roundness: MAX_ROUNDNESS,
        base_edge_length: options.base_edge_length,
        enough: 0,
    }
}

/// Merges within the bound, then beyond it until the budget is met or the disk rule allows no more.
fn merge_to_budget(surface: &Measured, patch_of: &mut PatchOf, options: &VsaOptions) -> usize {
    let bound = within_bound(options);
    let beyond = MergeRule {
        max_spread: BUDGET_SPREAD.max(options.max_angle),
        max_roundness: f64::INFINITY,
        enough: options.max_patches,
        ..bound
    };
    merge(surface, patch_of, &bound) + merge(surface, patch_of, &beyond)
}

fn judge(surface: &Measured, patch_of: &PatchOf, report: &mut VsaReport) {
    let moments = Moments::of_patches(surface, patch_of, n_patches(patch_of));
    report.error = moments.iter().map(Moments::error).sum::<f64>() / surface.total_area;
    report.max_spread = moments.iter().map(Moments::spread).fold(0.0, f64::max);
}
