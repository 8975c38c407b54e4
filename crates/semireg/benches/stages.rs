//! Every stage by itself, and the whole: `cargo bench -p semireg [-- FILTER]`.

use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
use mesh_core::{Soup, Topology, TriMesh};
use region_map::Surface;
use semireg::{Options, Stages, remesh};
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
    let options = Options { base_vertices: Some(BASE_VERTICES), levels: LEVELS, ..Options::default() };
    let remeshed = remesh(soup, &options)?;
    let Stages { base: stages, .. } = &remeshed.stages;
    let patches = stages.patches.as_ref().ok_or("no patches")?;
    let (cleaned, mesh, topology) = (&stages.cleaned, &stages.working.mesh, &stages.working.topology);
    let surface = Surface { mesh, topology, network: &stages.network, normals: &stages.normals };
    let base_edge_length = mesh_core::equilateral_edge_length(mesh.total_area(), BASE_VERTICES);

    let refining = refine::RefineOptions::new(0.5 * base_edge_length);
    let detecting = features::FeatureOptions { base_edge_length, ..options.features.clone() };
    let segmenting = segment_vsa::VsaOptions { max_patches: BASE_VERTICES / 8, base_edge_length, ..Default::default() };
    let uniform = region_map::Sizing::uniform(mesh);
    let sampling = segment_cvt::CvtOptions { base_vertices: 2 * BASE_VERTICES, ..Default::default() };
    let sizing_options = sizing::SizingOptions::new(base_edge_length);
    let sizing = sizing::sizing(&surface, &sizing_options);
    let building = basemesh::BaseOptions { base_vertices: BASE_VERTICES, ..Default::default() };
    let domain = subdiv::subdivide(&stages.base.mesh, &stages.base.region, LEVELS)?;
    let origins = Some(project::Origins { base: &stages.base, points: &domain.origins });
    let projected = project::project(&surface, &domain.mesh, &domain.region, origins, &options.project)?;
    let fine = Topology::new(domain.mesh.faces(), domain.mesh.n_vertices())?;
    let relaxed = relax::relax(&surface, &projected.mesh, &fine, &projected.region, &options.relax)?;
    let fitting = fit::FitOptions::default();

    let mut group = criterion.benchmark_group(name);
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(1));
    // No result is looked at here: the pipeline has just passed on the same.
    group.bench_function("clean", |b| b.iter(|| mesh_core::clean(black_box(soup), &options.clean)));
    group.bench_function("refine", |b| b.iter(|| refine::refine(&cleaned.mesh, &cleaned.topology, &[], &refining)));
    group.bench_function("features", |b| b.iter(|| features::detect(mesh, topology, &detecting)));
    group.bench_function("segment", |b| b.iter(|| segment_vsa::segment(mesh, topology, &stages.network, &segmenting)));
    group.bench_function("sizing", |b| b.iter(|| sizing::sizing(&surface, &sizing_options)));
    group.bench_function("sample", |b| b.iter(|| segment_cvt::sample(mesh, &patches.cells, &uniform, &sampling)));
    group.bench_function("base", |b| b.iter(|| basemesh::build(&surface, &patches.cells, &patches.sites, &sizing, &building)));
    group.bench_function("decimate", |b| b.iter(|| basemesh::decimate(&surface, &sizing, &building)));
    group.bench_function("subdivide", |b| b.iter(|| subdiv::subdivide(&stages.base.mesh, &stages.base.region, LEVELS)));
    let projecting = || project::project(&surface, &domain.mesh, &domain.region, origins, &options.project);
    group.bench_function("project", |b| b.iter(projecting));
    let relaxing = || relax::relax(&surface, &projected.mesh, &fine, &projected.region, &options.relax);
    group.bench_function("relax", |b| b.iter(relaxing));
    let snapping = || snap::snap(&surface, &relaxed.mesh, &fine, &relaxed.map, &Default::default(), &Default::default());
    group.bench_function("snap", |b| b.iter(snapping));
    group.bench_function("fit", |b| b.iter(|| fit::fit(&surface, &relaxed.mesh, &fine, &relaxed.map, &fitting)));
    let certifying = || certify::certify(&cleaned.mesh, &remeshed.mesh, LEVELS, &Default::default());
    group.bench_function("certify", |b| b.iter(certifying));
    group.bench_function("end to end", |b| b.iter(|| remesh(black_box(soup), &options)));
    group.finish();
    Ok(())
}

criterion_group!(benches, all);
criterion_main!(benches);
