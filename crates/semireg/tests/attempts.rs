//! What is tried on the way to a result, what is told of it, and how a caller follows and ends a run.

use glam::DVec3;
use mesh_core::{Soup, TriMesh, VertexId};
use semireg::{Error, Options, Progress, Remedy, Remeshed, Verdict, Way, remesh, remesh_with};
use std::ops::ControlFlow;

fn options(base_vertices: usize, levels: u32) -> Options {
    Options { base_vertices: Some(base_vertices), levels: Some(levels), ..Options::default() }
}

/// Far too few base vertices for a noisy scan: with some numbers a few triangles stay folded, and come free where they are.
fn rescued() -> Remeshed {
    let scan = fixtures::scan(10).to_soup();
    let results = (20..60).filter_map(|n| remesh(&scan, &options(n, 3)).ok());
    let is_mended = |r: &Remeshed| {
        let bases = r.report.attempts.iter().filter(|a| a.remedy.makes_a_base()).count();
        bases == 1 && r.report.attempts.iter().any(|a| matches!(a.remedy, Remedy::RelaxPlaces(_)))
    };
    results.into_iter().find(is_mended).expect("none of these numbers leaves a fold: give others")
}

fn bits(mesh: &TriMesh) -> Vec<u64> {
    mesh.positions().iter().flat_map(|p| p.to_array().map(f64::to_bits)).collect()
}

#[test]
fn the_last_folds_are_mended_in_their_places() {
    let Remeshed { report, .. } = rescued();
    let in_places = report.attempts.iter().filter(|a| matches!(a.remedy, Remedy::RelaxPlaces(_) | Remedy::BisectBase(_)));
    let verdicts: Vec<_> = in_places.map(|a| a.verdict.clone()).collect();
    // Without one fold this test would say nothing.
    assert!(verdicts.contains(&Verdict::Faulty { faults: 0, triangles: 1 }), "{verdicts:?}");
    // The same base mesh went through to the end.
    let bases: Vec<_> = report.attempts.iter().filter(|a| a.remedy.makes_a_base()).collect();
    assert!(matches!(bases[..], [only] if only.remedy == Remedy::AsAsked && only.verdict.is_certified()), "{bases:?}");
}

/// A hollow ball whose wall is thin on one side. The chords there are farther from their own sheet than the other one is.
fn hollow_ball(wall: f64, hollow: f64) -> Soup {
    let ball = fixtures::icosphere(16);
    let outer = ball.positions().iter().copied();
    let inner = ball.positions().iter().map(|p| hollow * *p + DVec3::X * (1.0 - hollow - wall));
    let n = ball.n_vertices() as u32;
    let faces = ball.faces().iter().map(|f| f.map(|v| v.0));
    let turned = faces.clone().map(|[a, b, c]| [a + n, c + n, b + n]);
    Soup { positions: outer.chain(inner).collect(), triangles: faces.chain(turned).collect() }
}

/// Where two sheets nearly touch many triangles count as folded, which are none: the base mesh gets vertices there, and nowhere else.
#[test]
fn triangles_get_smaller_where_sheets_nearly_touch() {
    let asked = 100;
    let Remeshed { report, mesh, .. } = remesh(&hollow_ball(0.001, 0.95), &options(asked, 2)).unwrap();
    let bisected = report.attempts.iter().filter(|a| matches!(a.remedy, Remedy::BisectBase(_))).count();
    assert!(bisected > 0, "{:?}", report.attempts);
    assert!((asked + 1..asked * 5 / 4).contains(&report.base.made), "{:?}", report.base);
    let mean_length = |near: bool| {
        let is_there = |f: &&[VertexId; 3]| (f.iter().map(|&v| mesh.position(v).x).sum::<f64>() > 2.9) == near;
        let edges: Vec<f64> = mesh.faces().iter().filter(is_there).map(|f| mesh.distance(f[0], f[1])).collect();
        edges.iter().sum::<f64>() / edges.len() as f64
    };
    assert!(mean_length(true) < 0.75 * mean_length(false), "{} {}", mean_length(true), mean_length(false));
}

#[test]
fn a_rescue_gives_the_same_bits_on_any_number_of_threads() {
    let on = |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(rescued);
    let (one, two) = (on(1), on(2));
    assert_eq!(one.mesh.faces(), two.mesh.faces());
    assert!(bits(&one.mesh) == bits(&two.mesh));
    let told = |r: &Remeshed| r.report.attempts.iter().map(|a| format!("{} {}", a.remedy, a.verdict)).collect::<Vec<_>>();
    assert_eq!(told(&one), told(&two));
}

#[test]
fn a_base_mesh_from_elsewhere_keeps_its_order() {
    let soup = fixtures::l_block(3).to_soup();
    let first = remesh(&soup, &options(80, 1)).unwrap();
    let base = first.stages.base.base.mesh();
    let on_it = Options { base_mesh: Some(base.to_soup()), levels: Some(2), ..Options::default() };
    let Remeshed { report, stages, .. } = remesh(&soup, &on_it).unwrap();
    assert_eq!((report.way, report.base.made), (Way::Given, base.n_vertices()));
    assert_eq!(stages.base.base.mesh().faces(), base.faces());
    assert_eq!(report.attempts.iter().filter(|a| a.remedy.makes_a_base()).count(), 1);
    assert_eq!(first.report.attempts.last().and_then(|a| a.way), Some(first.report.way));
}

#[test]
fn stages_add_up_to_the_whole_run() {
    let start = std::time::Instant::now();
    let seconds = remesh(&fixtures::cube(4).to_soup(), &options(60, 2)).unwrap().report.seconds;
    let (whole, sum) = (start.elapsed().as_secs_f64(), seconds.total());
    assert!(sum > 0.0 && sum <= whole, "{sum} of {whole}");
    let stages: Vec<_> = seconds.0.iter().map(|s| s.stage).collect();
    for stage in ["clean", "features", "decimate", "search", "relax", "certify", "other"] {
        assert!(stages.contains(&stage), "{stages:?}");
    }
}

#[test]
fn a_caller_hears_of_the_stages_and_gets_the_same_result() {
    let soup = fixtures::cube(4).to_soup();
    let mut heard: Vec<Progress> = Vec::new();
    let listen = &mut |progress| {
        heard.push(progress);
        ControlFlow::Continue(())
    };
    let followed = remesh_with(&soup, &options(60, 1), listen).unwrap();
    let alone = remesh(&soup, &options(60, 1)).unwrap();
    assert!(bits(&followed.mesh) == bits(&alone.mesh));
    assert!(heard.windows(2).all(|pair| pair[0].share <= pair[1].share), "{heard:?}");
    for stage in ["clean", "search", "certify"] {
        assert!(heard.iter().any(|p| p.stage == stage), "{stage} in {heard:?}");
    }
}

#[test]
fn a_run_is_ended_in_any_stage() {
    let soup = fixtures::part(5).to_soup();
    for stage in ["clean", "sizing", "segment", "base", "search", "project", "relax", "fit", "certify"] {
        let at = &mut |p: Progress| if p.stage == stage { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let error = remesh_with(&soup, &options(150, 2), at).unwrap_err();
        assert!(matches!(error, Error::Cancelled), "{stage}: {error}");
    }
}

/// Minor creases and bends of a noisy scan: those beside triangles that come out poor are let go, others are followed to the end.
#[test]
fn creases_are_let_go_beside_poor_triangles() {
    let Remeshed { report, .. } = remesh(&fixtures::scan(20).to_soup(), &options(40, 2)).unwrap();
    let of_snapping = report.attempts.iter().filter(|a| matches!(a.remedy, Remedy::Snap | Remedy::LetGoCreases));
    let tried: Vec<(Remedy, Verdict)> = of_snapping.map(|a| (a.remedy, a.verdict.clone())).collect();
    assert_eq!(tried.first().map(|t| t.0), Some(Remedy::Snap));
    // Without letting go this test would say nothing.
    assert!(matches!(tried.last(), Some((Remedy::LetGoCreases, Verdict::Faulty { faults: 0, .. }))), "{tried:?}");
    assert!(report.snapped.bends > 0, "{:?}", report.snapped);
    assert!(!report.warnings.iter().any(|w| w.contains("as they came out")), "{:?}", report.warnings);
}
