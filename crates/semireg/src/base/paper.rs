//! The paper's base mesh as it is printed (section 3): patches, sites, and their triangulation, which stays as it is.

use super::given::mended;
use super::patches::{Patches, Style, patches};
use super::stages::{Base, BaseCounts, BaseStages};
use super::way::Way;
use crate::input::Input;
use crate::run::Run;
use crate::{Error, Options};
use region_map::{Sizing, Surface};
use std::sync::Arc;

/// As many sites as vertices are asked for, and no improvement.
const AS_PRINTED: Style = Style { sites: 1.0, rounds: 0, compactness: TIE_BREAK };
/// The weight of the distance beside the normals of eq. 1, which leaves open where a face of a plane goes: all patches of its normal cost 0. With
/// less a patch grows a tail along a crease to its end, and the base triangles round that end fold (fandisk: 57 of 26,368 triangles folded at 0,
/// 8 from .03 to .15); with more patches follow their normals less.
const TIE_BREAK: f64 = 0.1;

/// The stages up to the paper's base mesh.
///
/// On the working mesh, without a proxy and with the density 1 of eq. 5. Only triangles that would end without area are changed: those with two
/// edges on one arc, and needles.
pub(crate) fn paper(input: &Input, options: &Options, run: &mut Run) -> Result<BaseStages, Error> {
    let (mesh, topology) = (input.working.mesh(), input.working.topology());
    let detect = || features::detect(mesh, topology, &input.marked, input.base_edge_length(), &options.features);
    let surface = input.working.with_network(run.stage("features", detect)?)?;
    let sizing = Sizing::uniform(surface.mesh());
    let patches = patches(&surface, &sizing, input.asked, &AS_PRINTED, options.seed, run)?;
    let mut warnings: Vec<String> = patches.split_warning().into_iter().collect();
    let base = mended(&surface, patches.base.clone(), &mut warnings)?;
    Ok(BaseStages {
        cleaned: input.cleaned.clone(),
        counts: counts(input.asked, base.mesh().n_vertices(), &patches, &surface),
        surface,
        proxy: None,
        patches: Some(Arc::new(patches)),
        way: Way::Paper,
        base: Arc::new(Base::Mapped(base)),
        warnings,
    })
}

/// So many vertices were made.
fn counts(asked: usize, made: usize, patches: &Patches, surface: &Surface) -> BaseCounts {
    let (corners, arcs) = (surface.network().corners.len(), surface.network().arcs.len());
    let n_patches = patches.cells.patches.len();
    let why = || format!("{corners} corners, {arcs} arcs and the borders of {n_patches} patches take them");
    let reason = if made > asked { why() } else { String::new() };
    BaseCounts { asked, needed: patches.needed.min(made), made, reason }
}
