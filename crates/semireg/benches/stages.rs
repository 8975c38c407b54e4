//! Every stage by itself, and the whole: `cargo bench -p semireg [-- FILTER]`.

use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
use mesh_core::{Soup, TriMesh};
use semireg::{Method, Options, remesh};
use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

/// A smooth body and a part with creases, 8,000 and 8,738 triangles.
fn inputs() -> [(&'static str, TriMesh); 2] {
    [("blob", fixtures::blob(20)), ("part", fixtures::part(12))]
}

const BASE_VERTICES: usize = 200;
const LEVELS: u32 = 3;

fn all(criterion: &mut Criterion) {
    for (name, mesh) in inputs() {
        if let Err(e) = bench(criterion, name, &mesh.to_soup()) {
            eprintln!("{name}: {e}");
            std::process::exit(1);
        }
    }
}

/// Benches the verbs in the order of the pipeline, each on what the pipeline itself gives it (but relax and fit, before snapping).
fn bench(criterion: &mut Criterion, name: &str, soup: &Soup) -> Result<(), Box<dyn Error>> {
    let options =
        Options { method: Method::Patches, base_vertices: Some(BASE_VERTICES), levels: Some(LEVELS), ..Options::default() };
    let remeshed = remesh(soup, &options)?;
    let stages = &remeshed.stages.base;
    let patches = stages.patches.as_ref().ok_or("no patches")?;
    let base = stages.base.mapped().ok_or("the base mesh has no map")?;
    let (cleaned, surface) = (&stages.cleaned, stages.base_surface());
    let (mesh, topology) = (surface.mesh(), surface.topology());
    let reference = certify::Reference::new(cleaned.mesh.clone())?;
    let base_edge_length = mesh_core::equilateral_edge_length(mesh.total_area(), BASE_VERTICES);

    let refining = refine::RefineOptions::new(0.5 * base_edge_length);
    let segmenting = segment_vsa::VsaOptions { max_patches: BASE_VERTICES / 8, base_edge_length, ..Default::default() };
    let uniform = region_map::Sizing::uniform(mesh);
    let sampling = segment_cvt::CvtOptions { base_vertices: 2 * BASE_VERTICES, ..Default::default() };
    let sizing_options = sizing::SizingOptions::new(base_edge_length);
    let sizing = sizing::sizing(surface, &sizing_options)?;
    let building = basemesh::BaseOptions { base_vertices: BASE_VERTICES, ..Default::default() };
    let subdivided = subdiv::subdivide(&base.domain, LEVELS)?;
    let origins = Some(project::Origins { base, points: &subdivided.origins });
    let projected = project::project(surface, &subdivided.domain, origins, &options.project)?;
    let relaxed = relax::relax(surface, &projected.domain, &options.relax)?;
    let fitting = fit::FitOptions::default();

    let mut group = criterion.benchmark_group(name);
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(1));
    // No result is looked at here: the pipeline has just passed on the same.
    group.bench_function("clean", |b| b.iter(|| mesh_core::clean(black_box(soup), &options.clean)));
    group.bench_function("refine", |b| b.iter(|| refine::refine(&cleaned.mesh, &cleaned.topology, &[], &refining)));
    let detecting = || features::detect(mesh, topology, &[], base_edge_length, &options.features);
    group.bench_function("features", |b| b.iter(detecting));
    group.bench_function("segment", |b| b.iter(|| segment_vsa::segment(surface, &segmenting)));
    group.bench_function("sizing", |b| b.iter(|| sizing::sizing(surface, &sizing_options)));
    group.bench_function("sample", |b| b.iter(|| segment_cvt::sample(surface, &patches.cells, &uniform, &sampling)));
    group.bench_function("base", |b| b.iter(|| basemesh::build(surface, &patches.cells, &patches.sites, &sizing, &building)));
    group.bench_function("decimate", |b| b.iter(|| basemesh::decimate(surface, &sizing, &building)));
    group.bench_function("subdivide", |b| b.iter(|| subdiv::subdivide(&base.domain, LEVELS)));
    group.bench_function("project", |b| b.iter(|| project::project(surface, &subdivided.domain, origins, &options.project)));
    group.bench_function("relax", |b| b.iter(|| relax::relax(surface, &projected.domain, &options.relax)));
    let snapping = || snap::snap(surface, &relaxed.domain, &Default::default(), &Default::default(), &Default::default());
    group.bench_function("snap", |b| b.iter(snapping));
    group.bench_function("fit", |b| b.iter(|| fit::fit(surface, &relaxed.domain, &fitting)));
    group.bench_function("certify", |b| b.iter(|| certify::certify(&reference, &remeshed.mesh, LEVELS, &Default::default())));
    group.bench_function("end to end", |b| b.iter(|| remesh(black_box(soup), &options)));
    group.finish();
    Ok(())
}

criterion_group!(benches, all);
criterion_main!(benches);
