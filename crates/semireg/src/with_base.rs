//! The pipeline with a base mesh from elsewhere in the place of our own.

use crate::base_stages::{BaseStages, Way};
use crate::input::Input;
use crate::pipeline::{finest_triangles, run};
use crate::{Error, Options, Remeshed, StageSeconds};
use basemesh::Mended;
use features::FeatureOptions;
use mesh_core::{CleanOptions, CleanReport, Cleaned, Soup, Topology, TriMesh, equilateral_edge_length};
use region_map::{SheetNormals, Surface};
use trace_base::Traced;

/// Remeshes a soup of triangles with a given base mesh, whose vertices and faces keep their order: it is traced onto the input, then
/// subdivided, projected, relaxed and certified as our own would be. `options.base_vertices` is not asked.
///
/// The base mesh must be an oriented manifold of the topology of the cleaned input. Creases that its edges don't follow are given up
/// as minor. If its edges cannot be traced, vertices are placed by rays. The warnings say so. There is no ladder: the base mesh is as
/// it is.
pub fn remesh_with_base(soup: &Soup, base: &Soup, options: &Options) -> Result<Remeshed, Error> {
    let mut seconds = StageSeconds::default();
    let (base, mut warnings) = sound_base(base)?;
    let mut options = Options { base_vertices: Some(base.n_vertices()), ..options.clone() };
    let input = Input::new(soup, &mut options, &mut seconds)?;
    let (stages, untraced) = stages(&input, &base, &options, &mut warnings, &mut seconds)?;
    let base_vertices = stages.base.mesh.n_vertices();
    finest_triangles((base_vertices, stages.base.mesh.n_faces()), base_vertices, options.levels)?;
    let mut remeshed = run(&stages, &options, &mut seconds).map_err(|e| match e {
        Error::NotCertified(failure) => {
            Error::BaseNotCertified { failure, untraced: untraced.map(|u| format!(" (placed by rays: {u})")).unwrap_or_default() }
        }
        e => e,
    })?;
    remeshed.report.seconds = seconds;
    Ok(remeshed)
}

/// A base mesh as it is where that is a manifold in one order of indices, else cleaned; and warnings.
///
/// Cleaning merges vertices at the same place, which a base mesh of ours has where surfaces touch.
fn sound_base(soup: &Soup) -> Result<(TriMesh, Vec<String>), Error> {
    let as_it_is = TriMesh::new(soup.positions.clone(), soup.triangles.clone());
    if let Ok(mesh) = as_it_is
        && let Ok(topology) = Topology::new(mesh.faces(), mesh.n_vertices())
        && mesh.positions().ids().all(|v| topology.valence(v) > 0)
        // An stl is a heap of single triangles.
        && mesh.faces().ids().all(|f| topology.neighbours(f).iter().any(Option::is_some))
    {
        return Ok((mesh, Vec::new()));
    }
    let Cleaned { mesh, report, .. } = mesh_core::clean(soup, &CleanOptions::default()).map_err(Error::CleanBase)?;
    let CleanReport { non_manifold_edges, orientation_cuts, vertex_copies, .. } = report;
    if non_manifold_edges + orientation_cuts + vertex_copies > 0 {
        return Err(Error::BaseNotManifold { edges: non_manifold_edges + orientation_cuts, vertices: vertex_copies });
    }
    let same = CleanReport { merged_exactly: report.merged_exactly, turned: report.turned, ..CleanReport::default() };
    let warning = "the base mesh was repaired first (unused vertices, needles, repeated triangles): `semireg inspect` tells what";
    Ok((mesh, if report == same { Vec::new() } else { vec![warning.into()] }))
}

/// The stages up to the base mesh; those that make one of our own are left out. And why the base has no map, if it has none.
fn stages(
    input: &Input,
    base: &TriMesh,
    options: &Options,
    warnings: &mut Vec<String>,
    seconds: &mut StageSeconds,
) -> Result<(BaseStages, Option<trace_base::Untraced>), Error> {
    let (mesh, topology) = (&input.working.mesh, &input.working.topology);
    let base_edge_length = equilateral_edge_length(mesh.total_area(), base.n_vertices());
    let feature_options = FeatureOptions { base_edge_length, ..options.features.clone() };
    let network = seconds.time("features", || features::detect(mesh, topology, &feature_options))?;
    let Traced { network: followed, base, untraced } =
        seconds.time("trace", || trace_base::trace(mesh, topology, &network, base))?;
    let (before, after) = (network.total_length(), followed.total_length());
    if after < before {
        let share = 100.0 * (before - after) / before;
        warnings.push(format!("{share:.1} % of the creases are given up: no edges of the base mesh follow them"));
    }
    if let Some(reason) = untraced {
        warnings.push(format!("{reason}: the base mesh has no map, its vertices are placed by rays"));
    }
    let normals = SheetNormals::new(mesh, topology, &followed);
    let base = match untraced {
        None => {
            let surface = Surface { mesh, topology, network: &followed, normals: &normals };
            let (base, Mended { ears, moved }) = basemesh::mend(&surface, base)?;
            if ears > 0 {
                warnings.push(format!(
                    "{ears} base triangles were flipped or split: with two edges on one crease they cannot be subdivided"
                ));
            }
            if moved > 0 {
                warnings.push(format!("{moved} base vertices were moved, for triangles that are too thin to be subdivided"));
            }
            base
        }
        Some(_) => base,
    };
    let stages = BaseStages {
        cleaned: input.cleaned.clone(),
        working: input.working.clone(),
        normals,
        network: followed,
        patches: None,
        way: Way::Given,
        base,
        warnings: std::mem::take(warnings),
    };
    Ok((stages, untraced))
}
