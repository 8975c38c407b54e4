//! The stages from the working mesh to the base mesh, which two ways lead to.

use crate::input::Input;
use crate::ladder::Rung;
use crate::patches::{Patches, patches};
use crate::pipeline::finest_triangles;
use crate::search::searched;
use crate::{Error, Options, StageSeconds};
use basemesh::BaseOptions;
use features::FeatureOptions;
use mesh_core::{Cleaned, equilateral_edge_length};
use refine::Refined;
use region_map::{BaseCounts, BaseMesh, Network, SheetNormals, Surface};
use sizing::SizingOptions;
use std::sync::Arc;

/// What the stages up to the base mesh made.
#[derive(Clone, Debug)]
pub struct BaseStages {
    /// The input with its repairs.
    pub cleaned: Arc<Cleaned>,
    /// The working mesh: the same surface in triangles that are not in the way.
    pub working: Arc<Refined>,
    /// Corners, arcs and sheets.
    pub network: Network,
    /// One-sided normals of the working mesh.
    pub normals: SheetNormals,
    /// The paper's way to a base mesh; `None` where it led to none, and with a base mesh from elsewhere.
    pub patches: Option<Arc<Patches>>,
    /// Where the base mesh comes from.
    pub way: Way,
    /// The base mesh.
    pub base: BaseMesh,
    /// What did not go as usual.
    pub warnings: Vec<String>,
}

/// Where a base mesh comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Sites of patches, triangulated in charts (paper, section 3).
    Patches,
    /// The working mesh, decimated.
    Decimation,
    /// A file.
    Given,
}

/// Runs the stages on an input, both ways. The base meshes come in the order of their rating, the best first. `needed` base vertices
/// are what corners and arcs took on an earlier rung, 0 on the first. With `levels`, base meshes that make too large a result are refused,
/// as early as can be.
pub(crate) fn base_stages(
    input: &Input,
    options: &Options,
    rung: &Rung,
    needed: usize,
    levels: Option<u32>,
    seconds: &mut StageSeconds,
) -> Result<Vec<BaseStages>, Error> {
    let (mesh, topology) = (&input.working.mesh, &input.working.topology);
    let asked = options.wanted_base_vertices(input.cleaned.mesh.n_vertices());
    let at_least = if rung.as_needed { needed.max(asked) } else { asked };
    let wanted = (at_least as f64 * rung.base_vertices).round() as usize;
    let base_edge_length = equilateral_edge_length(mesh.total_area(), wanted);
    let persistence = options.features.persistence * rung.persistence;
    let feature_options = FeatureOptions { base_edge_length, persistence, ..options.features.clone() };
    let network = seconds.time("features", || features::detect(mesh, topology, &feature_options))?;
    let refuse_too_large = |base: (usize, usize)| match levels {
        Some(levels) => finest_triangles(base, asked, levels).map(|_| ()),
        None => Ok(()),
    };
    refuse_too_large(network.least_base(topology))?;
    let normals = SheetNormals::new(mesh, topology, &network);
    let surface = Surface { mesh, topology, network: &network, normals: &normals };
    let sizing_options = SizingOptions { turn: rung.turn, ..SizingOptions::new(base_edge_length) };
    let sizing = seconds.time("sizing", || sizing::sizing(&surface, &sizing_options));

    let base_options = BaseOptions { base_vertices: wanted, ..Default::default() };
    let mut times = [StageSeconds::default(), StageSeconds::default()];
    let [of_patches, of_decimation] = &mut times;
    let finished = |way: Way, base: BaseMesh, seconds: &mut StageSeconds| {
        refuse_too_large((base.mesh.n_vertices(), base.mesh.n_faces()))?;
        // The history of edits distorts the map; where edges cannot be traced it still is one.
        let base = seconds.time("retrace", || trace_base::retrace(&surface, &base)).unwrap_or(base);
        let (rating, base) = seconds.time("search", || searched(&surface, &sizing, base, asked, options));
        Ok((rating, way, base))
    };
    // Neither way waits for the other before it has its rating.
    let (by_patches, decimated) = rayon::join(
        || {
            let patches = patches(&surface, &sizing, wanted, options.seed, of_patches)?;
            let rated = finished(Way::Patches, patches.base.clone(), of_patches)?;
            Ok((Arc::new(patches), rated))
        },
        || {
            let base = of_decimation.time("decimate", || basemesh::decimate(&surface, &sizing, &base_options))?;
            finished(Way::Decimation, base, of_decimation)
        },
    );
    times.iter().for_each(|t| seconds.add(t));
    let (patches, mut rated) = match (by_patches, decimated) {
        (Ok((patches, rated)), decimated) => (Some(patches), decimated.into_iter().chain([rated]).collect()),
        (Err(_), Ok(rated)) => (None, vec![rated]),
        (Err(_), Err(e @ Error::TooLarge { .. })) | (Err(e), Err(_)) => return Err(e),
    };
    rated.sort_by(|a, b| b.0.total_cmp(&a.0));
    let stages = |(_, way, mut base): (f64, Way, BaseMesh)| {
        base.counts = counts(&base, asked, patches.as_deref(), &network, rung);
        let warnings = patches
            .iter()
            .filter(|p| way == Way::Patches && p.n_split > 0)
            .map(|p| format!("{} patches were too long or too winding to lay flat and were split", p.n_split));
        BaseStages {
            cleaned: input.cleaned.clone(),
            working: input.working.clone(),
            network: network.clone(),
            normals: normals.clone(),
            patches: patches.clone(),
            way,
            base,
            warnings: warnings.collect(),
        }
    };
    Ok(rated.into_iter().map(stages).collect())
}

/// Base vertices asked, needed and made, and why there are more than asked.
fn counts(base: &BaseMesh, asked: usize, patches: Option<&Patches>, network: &Network, rung: &Rung) -> BaseCounts {
    let made = base.mesh.n_vertices();
    let needed = patches.map_or(made, |p| p.needed.min(made));
    let reason = if made <= asked {
        String::new()
    } else if rung.base_vertices > 1.0 {
        format!("asked {asked}, took {made}: with fewer the result did not pass the certificate")
    } else {
        let (corners, arcs) = (network.corners.len(), network.arcs.len());
        format!("asked {asked}, took {made}: {corners} corners and {arcs} arcs must be kept, and the shape between them")
    };
    BaseCounts { asked, needed, made, reason }
}
