//! Fits on shapes whose answers are known. `Bed::fit` checks what always holds.

mod common;

use common::{Bed, bytes, with_noise};
use fit::{FitError, FitOptions, fit, fit_holding};
use fixtures::{cuboid, cylinder, icosphere, plane, torus};
use glam::DVec3;
use mesh_core::{FaceId, Id, SurfacePoint, TriMesh, VertexId};
use region_map::{Attachment, Domain, RegionMap, SheetId, Surface};
use std::f64::consts::PI;

fn only_rising() -> FitOptions {
    FitOptions { slides: 0, rises: 3, ..FitOptions::default() }
}

/// A coarse sphere in a fine one. Between the paraboloid z = (x^2 + y^2) / 2 and an equilateral triangle of edge a with its
/// corners on it, the mean height is (R^2 - a^2 / 12) / 2 with the circumradius R = a / sqrt 3: a^2 / 8. Least squares move all
/// corners by so much.
#[test]
fn on_a_sphere_the_offset_is_an_eighth_of_the_squared_edge() {
    let bed = Bed::new(icosphere(24), &icosphere(6), 0);
    let (fitted, Domain { mesh, topology, .. }) = (bed.fit(&only_rising()), &bed.domain);
    let edges: f64 = topology.edge_ids().map(|e| topology.ends(e)).map(|[a, b]| mesh.distance(a, b).powi(2)).sum();
    let radius = mesh.position(VertexId(0)).length();
    let expected = edges / topology.n_edges() as f64 / 8.0 / radius;
    let mean = fitted.offsets.iter().sum::<f64>() / fitted.offsets.len() as f64;
    assert!((mean / expected - 1.0).abs() < 0.1, "{mean} instead of {expected}");
    assert!(fitted.report.used && fitted.report.end.mean < 0.45 * fitted.report.start.mean, "{:?}", fitted.report);
    assert!((fitted.domain.mesh.area_volume() / (4.0 / 3.0 * PI * radius.powi(3)) - 1.0).abs() < 0.01);
}

trait Volume {
    fn area_volume(&self) -> f64;
}

impl Volume for TriMesh {
    fn area_volume(&self) -> f64 {
        self.faces().ids().map(|f| self.triangle(f)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }
}

/// Rims stay, lids stay flat, only the side swells.
#[test]
fn rims_of_a_cylinder_are_exact() {
    let bed = Bed::new(cylinder(0.5, 1.5, 96), &cylinder(0.5, 1.5, 12), 2);
    let fitted = bed.fit(&only_rising());
    assert!(fitted.report.used && fitted.report.end.mean < 0.8 * fitted.report.start.mean, "{:?}", fitted.report);
    let (mut rim, mut side) = (0, 0);
    for (v, p) in fitted.domain.mesh.positions().enumerate() {
        match bed.domain.region.attachments[v] {
            Attachment::Sheet(_) if p.z > 1e-9 && p.z < 1.5 - 1e-9 => side += usize::from(fitted.offsets[v] > 0.0),
            Attachment::Sheet(_) => assert!(fitted.offsets[v].abs() < 1e-12, "lid {p}"),
            _ => rim += usize::from(*p == bed.domain.mesh.position(v)),
        }
    }
    assert_eq!(rim, 96, "vertices on rims");
    assert!(side > 0);
}

#[test]
fn what_is_flat_stays() {
    for (name, fine, coarse) in [("plane", plane(), plane()), ("cube", cuboid(DVec3::ONE, 7), cuboid(DVec3::ONE, 2))] {
        let bed = Bed::new(fine, &coarse, 2);
        let fitted = bed.fit(&FitOptions::default());
        assert!(!fitted.report.used && fitted.report.start.max < 1e-12, "{name}: {:?}", fitted.report);
        assert_eq!(fitted.domain.mesh.positions().as_slice(), bed.domain.mesh.positions().as_slice(), "{name}");
    }
}

/// A lens that is thinner than an edge is long, all of it one sheet: it swells on both sides, and no vertex leaves its side.
#[test]
fn sides_of_a_thin_lens_do_not_mix() {
    let flat = |mesh: TriMesh| {
        let positions = mesh.positions().iter().map(|&p| p * DVec3::new(1.0, 1.0, 0.05)).collect();
        mesh.with_positions(positions).unwrap()
    };
    let bed = Bed::smooth(flat(icosphere(32)), &flat(icosphere(8)), 0);
    let fitted = bed.fit(&only_rising());
    assert!(fitted.report.used && fitted.report.end.mean < 0.8 * fitted.report.start.mean, "{:?}", fitted.report);
    let is_off_the_rim = |p: &DVec3| p.x.hypot(p.y) < 0.8;
    for (v, p) in bed.domain.mesh.positions().enumerate().filter(|(_, p)| is_off_the_rim(p)) {
        let q = fitted.domain.mesh.position(v);
        assert!(p.z * q.z > 0.0 && (p.z - q.z).abs() < 0.2 * p.z.abs(), "{v}: {p} {q}");
    }
}

/// Two spheres in one mesh that pass through each other: each is fitted as it would be alone.
#[test]
fn components_that_pass_through_each_other_do_not_mix() {
    let twice = |mesh: &TriMesh| {
        let shift = DVec3::new(0.7, 0.3, 0.1);
        let n = mesh.n_vertices() as u32;
        let positions = mesh.positions().iter().copied().chain(mesh.positions().iter().map(|&p| p + shift)).collect();
        let faces = [0, n].into_iter().flat_map(|k| mesh.faces().iter().map(move |f| f.map(|v| v.0 + k))).collect();
        TriMesh::new(positions, faces).unwrap()
    };
    let alone = Bed::new(icosphere(16), &icosphere(5), 0).fit(&only_rising());
    let both = Bed::new(twice(&icosphere(16)), &twice(&icosphere(5)), 0).fit(&only_rising());
    assert!(alone.report.used && both.report.used, "{:?} {:?}", alone.report, both.report);
    let n = alone.offsets.len();
    for (i, offset) in both.offsets.iter().enumerate() {
        let expected = alone.offsets[VertexId::new(i % n)];
        // Weights and greatest distance are those of the whole mesh, so they agree roughly; a mixture would be off by the depth.
        assert!((offset - expected).abs() <= 0.2 * expected.abs(), "{i}: {offset} {expected}");
    }
}

/// Vertices that sit on the peaks and pits of a noisy plane go back to its middle.
#[test]
fn a_coarse_mesh_on_a_noisy_plane_finds_its_middle() {
    let fine = with_noise(&common::grid(60), 0.002);
    let bed = Bed::new(fine, &common::grid(12), 0);
    let fitted = bed.fit(&FitOptions::default());
    let height = |mesh: &TriMesh| mesh.positions().iter().map(|p| p.z.abs()).sum::<f64>() / mesh.n_vertices() as f64;
    assert!(fitted.report.used && height(&fitted.domain.mesh) < 0.7 * height(&bed.domain.mesh), "{:?}", fitted.report);
}

/// A fold that the domain cannot follow: offsets stay within their bounds.
#[test]
fn offsets_are_bounded() {
    let options = FitOptions { reach: 0.02, ..FitOptions::default() };
    let fitted = Bed::new(icosphere(16), &icosphere(4), 0).fit(&options);
    assert!(fitted.report.max_offset > 0.0);
    let longest = fitted
        .domain
        .mesh
        .faces()
        .iter()
        .flat_map(|f| [[f[0], f[1]], [f[1], f[2]]])
        .map(|[a, b]| fitted.domain.mesh.distance(a, b));
    assert!(fitted.report.max_offset <= 0.02 * longest.fold(0.0, f64::max));
}

#[test]
fn faces_that_are_to_stay_still_do() {
    let bed = Bed::new(icosphere(24), &icosphere(3), 2);
    let still: Vec<FaceId> = (0..40).map(FaceId).collect();
    let fitted = bed.fit_holding(&still, &FitOptions::default());
    assert!(fitted.report.used);
    for v in still.iter().flat_map(|&f| fitted.domain.mesh.face(f)) {
        assert_eq!((fitted.domain.mesh.position(v), fitted.offsets[v]), (bed.domain.mesh.position(v), 0.0));
    }
    let refused = fit_holding(&bed.surface, &bed.domain, &[FaceId(999_999)], &FitOptions::default()).unwrap_err();
    assert_eq!(refused, FitError::NoFace(FaceId(999_999)));
}

#[test]
fn the_same_bytes_on_one_thread_and_on_two() {
    let bed = Bed::new(torus(2.0, 0.7, 60, 36), &torus(2.0, 0.7, 20, 12), 1);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bytes(&bed.fit(&FitOptions::default())))
    };
    assert_eq!(on(1), on(2));
}

#[test]
fn what_does_not_fit_together_is_an_error() {
    let Bed { surface, domain } = Bed::new(cylinder(0.5, 1.5, 24), &cylinder(0.5, 1.5, 12), 1);
    let mut region = domain.region.clone();
    let inside = region.vertices().find(|&v| matches!(region.attachments[v], Attachment::Sheet(_))).unwrap();
    let own = region.sheet_of_face[domain.topology.fan(inside).next().unwrap().face()];
    let foreign = surface.network().sheet_of_face.enumerate().find(|(_, s)| **s != own).unwrap().0;
    region.points[inside] = SurfacePoint::at_corner(foreign, 0);
    let refused = |region: &RegionMap| {
        let domain = Domain { region: region.clone(), ..domain.clone() };
        fit(&surface, &domain, &FitOptions::default()).unwrap_err()
    };
    assert_eq!(refused(&region), FitError::OtherSheet(inside));
    region.points.push(SurfacePoint::at_corner(FaceId(0), 0));
    assert!(matches!(refused(&region), FitError::Region(_)));
}

/// Two spheres, and a domain on one of them.
#[test]
fn a_sheet_without_domain_is_an_error() {
    let one = icosphere(3);
    let n = one.n_vertices() as u32;
    let positions = one.positions().iter().copied().chain(one.positions().iter().map(|&p| p + 3.0 * DVec3::X)).collect();
    let faces = [0, n].into_iter().flat_map(|k| one.faces().iter().map(move |f| f.map(|v| v.0 + k))).collect();
    let both = Surface::smooth(TriMesh::new(positions, faces).unwrap()).unwrap();
    let domain = Domain::identity(&Surface::smooth(one).unwrap());
    assert_eq!(fit(&both, &domain, &FitOptions::default()).unwrap_err(), FitError::EmptySheet(SheetId(1)));
}

#[test]
fn options_out_of_their_range_are_errors() {
    let surface = Surface::smooth(icosphere(2)).unwrap();
    let fits = |options: FitOptions| fit(&surface, &Domain::identity(&surface), &options);
    for value in [f64::NAN, -0.1, f64::INFINITY] {
        let default = FitOptions::default();
        for (name, options) in [
            ("reach", FitOptions { reach: value, ..default.clone() }),
            ("quality_loss", FitOptions { quality_loss: value, ..default.clone() }),
            ("mean_quality_loss", FitOptions { mean_quality_loss: value, ..default.clone() }),
            ("least_gain", FitOptions { least_gain: value, ..default.clone() }),
        ] {
            assert!(matches!(fits(options), Err(FitError::Option { name: found, .. }) if found == name), "{name} {value}");
        }
    }
    let rounds = FitOptions { slides: usize::MAX, ..FitOptions::default() };
    assert!(matches!(fits(rounds), Err(FitError::Option { name: "slides", .. })));
}
