//! The whole pipeline on small shapes: certified, of the right counts, near the input, and the same on any number of threads.

use glam::DVec3;
use mesh_core::{Soup, Topology, TriMesh};
use semireg::{Error, Method, Options, PaperOptions, Relaxation, Remeshed, Report, Way, Weights, remesh};

fn options(base_vertices: usize, levels: u32) -> Options {
    Options { base_vertices: Some(base_vertices), levels: Some(levels), ..Options::default() }
}

/// Remeshes, and checks what every result promises.
fn check(name: &str, mesh: &TriMesh, base_vertices: usize, levels: u32) -> Remeshed {
    let remeshed = remesh(&mesh.to_soup(), &options(base_vertices, levels)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let certificate = &remeshed.report.certificate;
    assert!(certificate.passed(), "{name}: {:?}", certificate.failures());
    assert_eq!(certificate.levels, levels);
    check_counts(name, &remeshed, levels);
    let input = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let output = Topology::new(remeshed.mesh.faces(), remeshed.mesh.n_vertices()).unwrap();
    assert_eq!(output.euler(), input.euler(), "{name}");
    assert_eq!(output.components().1, input.components().1, "{name}");
    assert_eq!(output.border_loops().len(), input.border_loops().len(), "{name}");
    remeshed.stages.region.check(&output, remeshed.stages.surface.network()).unwrap_or_else(|e| panic!("{name}: {e}"));
    remeshed
}

/// `F = 4^n F0` and `V = 4^n (V0 - X) + X - (4^n - 2^n) B0 / 2`: X Euler number, B0 border edges of the base.
fn check_counts(name: &str, remeshed: &Remeshed, levels: u32) {
    let base = remeshed.stages.base.base.mesh();
    let topology = Topology::new(base.faces(), base.n_vertices()).unwrap();
    let (four, two) = (4i64.pow(levels), 2i64.pow(levels));
    let border = topology.edge_ids().filter(|&e| topology.is_border_edge(e)).count() as i64;
    let vertices = four * (base.n_vertices() as i64 - topology.euler()) + topology.euler() - (four - two) * border / 2;
    assert_eq!(remeshed.mesh.n_faces() as i64, four * base.n_faces() as i64, "{name}");
    assert_eq!(remeshed.mesh.n_vertices() as i64, vertices, "{name}");
    assert_eq!(remeshed.report.base.made, base.n_vertices(), "{name}");
}

/// The greatest distance between input and result, both ways, over the diagonal.
fn greatest_error(remeshed: &Remeshed) -> f64 {
    remeshed.report.certificate.measures.distance.worse().max
}

#[test]
fn shapes_with_flat_sides_come_out_exactly() {
    for (name, mesh, base_vertices) in [
        ("cube", fixtures::cube(4), 60),
        ("box of twelve", fixtures::cube(1), 60),
        ("l block", fixtures::l_block(3), 80),
        ("crossing boxes", fixtures::crossing_boxes(3), 120),
    ] {
        for levels in [1, 2] {
            let remeshed = check(name, &mesh, base_vertices, levels);
            assert!(greatest_error(&remeshed) < 1e-9, "{name}: {:e}", greatest_error(&remeshed));
        }
    }
}

#[test]
fn the_corners_of_a_cube_stay_where_they_are() {
    let remeshed = check("cube", &fixtures::cube(3), 50, 1);
    for corner in (0..8).map(|i| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2 & 1) as f64)) {
        assert!(remeshed.mesh.positions().iter().any(|&p| p == corner), "{corner}");
    }
}

/// The length of the longest edge.
fn longest_edge(mesh: &TriMesh) -> f64 {
    let sides = mesh.faces().iter().flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]]);
    sides.map(|[a, b]| mesh.distance(a, b)).fold(0.0, f64::max)
}

/// On a shape whose least radius is `r`, every point of a triangle of edges up to `h` is within `h / sqrt 3` of a vertex, hence
/// `h^2 / (6 r)` off the shape at most: for the input as for the result.
#[test]
fn smooth_shapes_come_out_as_near_as_their_triangles_are_small() {
    for (name, mesh, base_vertices, radius) in [
        ("torus", fixtures::torus(1.0, 0.4, 40, 20), 120, 0.4),
        ("icosphere", fixtures::icosphere(8), 60, 1.0),
        ("cylinder", fixtures::cylinder(0.5, 1.5, 48), 80, 0.5),
    ] {
        let mut errors = Vec::new();
        for levels in [1, 2] {
            let remeshed = check(name, &mesh, base_vertices, levels);
            let most = (longest_edge(&mesh).powi(2) + longest_edge(&remeshed.mesh).powi(2)) / (6.0 * radius);
            let error = greatest_error(&remeshed) * mesh.diagonal();
            assert!(error < most, "{name} at level {levels}: {error} > {most}");
            errors.push(error);
        }
        assert!(errors[1] < errors[0], "{name}: {errors:?}");
    }
}

#[test]
fn an_open_surface_keeps_its_borders() {
    for levels in [1, 2] {
        let remeshed = check("shell", &fixtures::shell(16), 120, levels);
        let border = remeshed.report.certificate.measures.border;
        assert!(border.is_some_and(|d| d.max < 0.02), "{border:?}");
    }
}

#[test]
fn one_thread_and_two_give_the_same_bits() {
    for (name, mesh) in [("l block", fixtures::l_block(3)), ("torus", fixtures::torus(1.0, 0.4, 24, 12))] {
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| remesh(&mesh.to_soup(), &options(70, 2)).unwrap().mesh)
        };
        let bits = |mesh: &TriMesh| mesh.positions().iter().flat_map(|p| p.to_array().map(f64::to_bits)).collect::<Vec<_>>();
        let (one, two) = (on(1), on(2));
        assert_eq!(one.faces(), two.faces(), "{name}");
        assert!(bits(&one) == bits(&two), "{name}: positions differ");
    }
}

#[test]
fn a_base_mesh_is_as_large_as_its_corners_and_arcs_need_and_says_why() {
    let cube = |base_vertices: usize| check("cube", &fixtures::cube(4), base_vertices, 1).report.base;
    let few = cube(5);
    assert_eq!((few.asked, few.needed), (5, 8));
    assert!(few.made >= 8 && few.reason.contains("8 corners and 12 arcs"), "{few:?}");
    let enough = cube(60);
    assert_eq!((enough.asked, enough.needed, enough.made, enough.reason.as_str()), (60, 8, 60, ""));
}

#[test]
fn a_result_that_would_be_too_large_is_refused() {
    let error = remesh(&fixtures::cube(4).to_soup(), &options(500, 8)).unwrap_err();
    assert!(matches!(error, Error::TooLarge { base_vertices: 500, .. }), "{error}");
    // Nobody who asks for one vertex waits for the 500,000 triangles and more that eight corners make.
    let error = remesh(&fixtures::cube(4).to_soup(), &options(1, 8)).unwrap_err();
    assert!(matches!(error, Error::TooLarge { base_vertices: 8, triangles: 786_432 }), "{error}");
}

#[test]
fn nothing_in_is_an_error_that_says_so() {
    let nothing = [
        Soup::default(),
        Soup { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 7]] },
        Soup { positions: vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], triangles: vec![[0, 1, 2]] },
        Soup { positions: vec![DVec3::ZERO, DVec3::NAN, DVec3::Y], triangles: vec![[0, 1, 2]] },
    ];
    for soup in nothing {
        let error = remesh(&soup, &Options::default()).unwrap_err();
        assert!(matches!(error, Error::Clean(_)), "{error}");
        assert!(error.to_string().starts_with("no face is left"), "{error}");
    }
}

/// A dense sphere: its base mesh is made on a proxy, and its finest level lies on the sphere, with the same bits on any number of threads.
#[test]
fn a_dense_surface_has_a_proxy() {
    let dense = fixtures::icosphere(36);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| remesh(&dense.to_soup(), &options(100, 2)).unwrap())
    };
    let (one, two) = (on(1), on(2));
    let base = &one.stages.base;
    let proxy = base.proxy.as_ref().expect("the sphere is dense");
    assert!(proxy.surface.mesh().n_faces() < dense.n_faces() / 2);
    let base_on_sphere = base.on_working_mesh().unwrap();
    assert!(base_on_sphere.mesh.positions().iter().all(|p| (p.length() - 1.0).abs() < 2e-3));
    one.stages.region.check(&topology_of(&one), one.stages.surface.network()).unwrap();
    assert!(greatest_error(&one) < 3e-3, "{}", greatest_error(&one));
    let bits = |r: &Remeshed| r.mesh.positions().iter().flat_map(|p| p.to_array().map(f64::to_bits)).collect::<Vec<_>>();
    assert!(one.mesh.faces() == two.mesh.faces() && bits(&one) == bits(&two));
}

fn topology_of(remeshed: &Remeshed) -> mesh_core::Topology {
    mesh_core::Topology::new(remeshed.mesh.faces(), remeshed.mesh.n_vertices()).unwrap()
}

/// The paper's pipeline with so many base vertices and two levels.
fn as_printed(paper: PaperOptions, base_vertices: usize) -> Options {
    Options { method: Method::Paper, relaxation: Relaxation::Paper(paper), ..options(base_vertices, 2) }
}

/// The paper's pipeline, from the patches to the second projection: as many vertices as asked, on the surface, and the relaxation as asked for.
#[test]
fn the_paper_s_pipeline_as_it_is_printed() {
    for (name, mesh) in
        [("cube", fixtures::cube(6)), ("torus", fixtures::torus(1.0, 0.4, 40, 20)), ("icosphere", fixtures::icosphere(10))]
    {
        for weights in [Weights::Uniform, Weights::Adaptive] {
            let paper = PaperOptions { weights, iterations: 20, ..PaperOptions::default() };
            let remeshed = remesh(&mesh.to_soup(), &as_printed(paper, 100));
            let remeshed = remeshed.unwrap_or_else(|e| panic!("{name}: {e}"));
            check_counts(name, &remeshed, 2);
            let report = &remeshed.report;
            assert!(report.certificate.passed() && report.fit.is_none() && report.way == Way::Paper, "{name}");
            assert!(report.base.made >= 100 && report.base.made <= 103, "{name}: {:?}", report.base);
            assert!(report.relax.quadric_iterations <= 20 && report.relax.after_quadric.ar_mean >= report.relax.start.ar_mean);
            assert!(remeshed.stages.offsets.iter().all(|&offset| offset == 0.0), "{name}");
        }
    }
}

/// It stops at the target quality, and at no iterations at all where none are wanted.
#[test]
fn the_paper_s_relaxation_stops_at_its_target() {
    let mesh = fixtures::icosphere(10);
    let iterations = |paper| {
        let remeshed = remesh(&mesh.to_soup(), &as_printed(paper, 60)).unwrap();
        remeshed.report.relax.quadric_iterations
    };
    assert_eq!(iterations(PaperOptions { iterations: 0, ..PaperOptions::default() }), 0);
    assert_eq!(iterations(PaperOptions { target_quality: 0.1, ..PaperOptions::default() }), 0);
    assert_eq!(iterations(PaperOptions { iterations: 3, ..PaperOptions::default() }), 3);
}

/// Base meshes and relaxations go with each other: the paper's relaxation on a decimated base mesh, also of a dense input with a proxy, and ours on
/// the paper's base mesh.
#[test]
fn each_relaxation_goes_with_each_base_mesh() {
    for (mesh, is_dense) in [(fixtures::cube(6), false), (fixtures::dense_blob(12_000), true)] {
        let paper = Options { relaxation: Relaxation::Paper(PaperOptions::default()), ..options(60, 2) };
        let remeshed = remesh(&mesh.to_soup(), &paper).unwrap();
        let Report { way, relax, fit, .. } = &remeshed.report;
        assert!(*way != Way::Paper && relax.quadric_iterations > 0 && relax.shape_steps == 0 && fit.is_none());
        assert_eq!(remeshed.stages.base.proxy.is_some(), is_dense);
        assert!(remeshed.stages.offsets.iter().all(|&offset| offset == 0.0) && greatest_error(&remeshed) < 0.02);
        let ours = remesh(&mesh.to_soup(), &Options { method: Method::Paper, ..options(60, 2) }).unwrap();
        assert!(ours.report.way == Way::Paper && ours.report.relax.shape_steps > 0 && ours.report.fit.is_some());
    }
}
