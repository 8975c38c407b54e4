//! A base mesh from elsewhere in the place of our own.

use super::stages::{Base, BaseCounts, BaseStages};
use super::way::Way;
use crate::input::{GivenBase, Input};
use crate::run::Run;
use crate::{Error, Options};
use basemesh::Mended;
use mesh_core::equilateral_edge_length;
use region_map::{BaseMesh, Surface};
use std::sync::Arc;
use trace_base::{Traced, TracedBase};

/// The stages up to a base mesh that is given: it is traced onto the working mesh, and its vertices and faces keep their order.
pub(crate) fn given(input: &Input, given: &GivenBase, options: &Options, run: &mut Run) -> Result<BaseStages, Error> {
    let (given, mut warnings) = (&given.mesh, given.warnings.clone());
    let (mesh, topology) = (input.working.mesh(), input.working.topology());
    let base_edge_length = equilateral_edge_length(mesh.total_area(), given.n_vertices());
    let network =
        run.stage("features", || features::detect(mesh, topology, &input.marked, base_edge_length, &options.features))?;
    let before = network.total_length();
    let detected = input.working.with_network(network)?;
    let Traced { surface, base } = run.stage("trace", || trace_base::trace(&detected, given))?;
    let after = surface.network().total_length();
    if after < before {
        let share = 100.0 * (before - after) / before;
        warnings.push(format!("{share:.1} % of the creases are given up: no edges of the base mesh follow them"));
    }
    let base = match base {
        TracedBase::Mapped(base) => Base::Mapped(mended(&surface, base, &mut warnings)?),
        TracedBase::Unmapped { domain, reason } => {
            warnings.push(format!("{reason}: the base mesh has no map, its vertices are placed by rays"));
            Base::Unmapped { domain, reason }
        }
    };
    let (asked, made) = (given.n_vertices(), base.mesh().n_vertices());
    Ok(BaseStages {
        cleaned: input.cleaned.clone(),
        surface,
        proxy: None,
        patches: None,
        way: Way::Given,
        base: Arc::new(base),
        counts: BaseCounts { asked, needed: asked, made, reason: String::new() },
        warnings,
    })
}

/// The base mesh in a form that can be subdivided.
pub(super) fn mended(surface: &Surface, base: BaseMesh, warnings: &mut Vec<String>) -> Result<BaseMesh, Error> {
    let Mended { base, straight_corners, moved } = basemesh::mend(surface, base)?;
    if straight_corners > 0 {
        let why = "with two edges on one crease they cannot be subdivided";
        warnings.push(format!("{straight_corners} base triangles were flipped or split: {why}"));
    }
    if moved > 0 {
        warnings.push(format!("{moved} base vertices were moved, for triangles that are too thin to be subdivided"));
    }
    Ok(base)
}
