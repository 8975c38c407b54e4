//! The paper's own arguments as numbers: what each part of the method does to one mesh.
//!
//! `cargo run --release -p semireg --example ablation -- IN.obj BASE_VERTICES LEVELS` prints a JSON object a row, which
//! `cargo xtask ablation` makes tables of. Results are measured as they come out, folded or not; nothing is certified.

use certify::{MeasureOptions, Reference};
use glam::DVec3;
use mesh_core::{IdVec, TriMesh, VertexId};
use project::{Origins, ProjectOptions, Projected, project};
use region_map::Surface;
use relax::{QuadricOptions, RelaxOptions, ShapeOptions, Weights, relax};
use semireg::{Options, Stages, remesh};
use std::error::Error;
use std::path::Path;
use subdiv::SubdivDomain;

/// Iterations of the paper's relaxation where it is by itself.
const ITERATIONS: usize = 40;

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [file, base_vertices, levels] = args.as_slice() else { return Err("IN.obj BASE_VERTICES LEVELS are needed".into()) };
    let soup = mesh_io::read(Path::new(file))?.soup;
    let options = Options { base_vertices: Some(base_vertices.parse()?), levels: Some(levels.parse()?), ..Options::default() };
    let remeshed = remesh(&soup, &options)?;
    let study = Study::new(&remeshed.stages, remeshed.report.certificate.levels)?;
    let projected = study.placements()?;
    study.quadric_parts(&projected)?;
    study.relaxations(&projected)?;
    let unfitted = remesh(&soup, &Options { fit: None, ..options.clone() })?;
    study.row("fit", "without fit (with snapping)", &unfitted.mesh)?;
    study.row("fit", "with fit: the whole pipeline", &remeshed.mesh)
}

/// A base mesh that the pipeline passed with, subdivided.
struct Study<'a> {
    original: Reference,
    stages: &'a Stages,
    surface: &'a Surface,
    subdivided: SubdivDomain,
}

impl<'a> Study<'a> {
    fn new(stages: &'a Stages, levels: u32) -> Result<Self, Box<dyn Error>> {
        let base = &stages.base;
        let subdivided = subdiv::subdivide(base.base.domain(), levels)?;
        Ok(Self { original: Reference::new(base.cleaned.mesh.clone())?, stages, surface: base.base_surface(), subdivided })
    }

    /// Section 4.2 and Fig. 5. Returns our own placement.
    fn placements(&self) -> Result<Projected, Box<dyn Error>> {
        let base = self.stages.base.base.mapped().ok_or("the base mesh has no map")?;
        let place = |origins, ray_reach| project(self.surface, &self.subdivided.domain, origins, &ProjectOptions { ray_reach });
        let ray_reach = ProjectOptions::default().ray_reach;
        let origins = Some(Origins { base, points: &self.subdivided.origins });
        self.row("placement", "plain normal displacement", &self.plain_displacement()?)?;
        self.row("placement", "regional normal displacement", &place(None, ray_reach)?.domain.mesh)?;
        self.row("placement", "by the base map", &place(origins, 0.0)?.domain.mesh)?;
        let ours = place(origins, ray_reach)?;
        self.row("placement", "by the base map, then regional rays (ours)", &ours.domain.mesh)?;
        Ok(ours)
    }

    /// Every vertex to the nearer hit of the whole surface along its normal, where there is one: creases, sheets and components are
    /// not known. Normals are averaged four times over the one-ring, as those of the regional rays are.
    fn plain_displacement(&self) -> Result<TriMesh, Box<dyn Error>> {
        let (mesh, topology) = (&self.subdivided.domain.mesh, &self.subdivided.domain.topology);
        let around = |v| topology.fan(v).map(|h| mesh_core::vector_area(mesh.triangle(h.face()))).sum::<DVec3>();
        let mut normals: IdVec<VertexId, DVec3> = mesh.positions().ids().map(|v| around(v).normalize_or_zero()).collect();
        for _ in 0..4 {
            let smooth = |v| (normals[v] + topology.one_ring(v).map(|w| normals[w]).sum::<DVec3>()).normalize_or_zero();
            normals = mesh.positions().ids().map(smooth).collect();
        }
        let displaced = |(v, &from): (VertexId, &DVec3)| {
            let hits = self.surface.index().first_hits_both_ways(from, normals[v]).into_iter().flatten();
            hits.min_by(|a, b| a.t.total_cmp(&b.t)).map_or(from, |hit| hit.position)
        };
        Ok(mesh.with_positions(mesh.positions().enumerate().map(displaced).collect())?)
    }

    /// Section 4.3, Figs. 7 and 8: the paper's relaxation by itself.
    fn quadric_parts(&self, start: &Projected) -> Result<(), Box<dyn Error>> {
        let iterated = QuadricOptions { iterations: ITERATIONS, ..QuadricOptions::default() };
        for (name, quadric) in [
            ("uniform weights, with the plane term", iterated.clone()),
            ("uniform weights, without the plane term", QuadricOptions { plane_weight: 0.0, ..iterated.clone() }),
            ("adaptive weights, with the plane term", QuadricOptions { weights: Weights::Adaptive, ..iterated }),
        ] {
            self.relaxed_row("quadric relaxation", name, start, &RelaxOptions { quadric, shape: no_shape() })?;
        }
        Ok(())
    }

    /// What each part of our relaxation adds.
    fn relaxations(&self, start: &Projected) -> Result<(), Box<dyn Error>> {
        let no_quadric = QuadricOptions { iterations: 0, ..QuadricOptions::default() };
        for (name, options) in [
            ("none, but folds mended", RelaxOptions { quadric: no_quadric.clone(), shape: no_shape() }),
            ("quadric part alone", RelaxOptions { shape: no_shape(), ..RelaxOptions::default() }),
            ("shape optimisation alone", RelaxOptions { quadric: no_quadric, ..RelaxOptions::default() }),
            ("both (ours)", RelaxOptions::default()),
        ] {
            self.relaxed_row("relaxation", name, start, &options)?;
        }
        Ok(())
    }

    fn relaxed_row(&self, group: &str, name: &str, start: &Projected, options: &RelaxOptions) -> Result<(), Box<dyn Error>> {
        let relaxed = relax(self.surface, &start.domain, options)?;
        self.row(group, name, &relaxed.domain.mesh)
    }

    /// Measures a result and prints its row, under the names of `semireg remesh --json`.
    fn row(&self, group: &str, name: &str, mesh: &TriMesh) -> Result<(), Box<dyn Error>> {
        let measures = certify::measure(&self.original, mesh, &MeasureOptions::default())?;
        let (quality, error) = (&measures.quality, measures.distance.worse());
        let or_null = |x: Option<String>| x.unwrap_or("null".to_owned());
        let figures = [
            ("ar_mean", quality.ar_mean.to_string()),
            ("ar_p01", quality.ar_p01.to_string()),
            ("agl", quality.agl.to_string()),
            ("area_cv", quality.area_cv.to_string()),
            ("err_mean", error.mean.to_string()),
            ("err_max", error.max.to_string()),
            ("crease_cover", or_null(measures.creases.map(|c| c.share.to_string()))),
            ("flipped", or_null(measures.flipped.map(|faces| faces.len().to_string()))),
        ];
        let figures: Vec<String> = figures.iter().map(|(key, value)| format!("\"{key}\":{value}")).collect();
        println!("{{\"group\":\"{group}\",\"row\":\"{name}\",{}}}", figures.join(","));
        Ok(())
    }
}

/// Neither untangling nor shape optimisation.
fn no_shape() -> ShapeOptions {
    ShapeOptions { steps: 0, untangling_steps: 0, ..ShapeOptions::default() }
}
