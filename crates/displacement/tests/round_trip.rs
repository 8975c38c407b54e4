//! Closed forms, round trips, and what is refused.

use correspondence::Levels;
use displacement::{Coefficients, Displacement, DisplacementError, EncodeOptions, LevelDisplacement, Residual, encode, figures};
use glam::DVec3;
use mesh_core::{Topology, TriMesh, VertexId};
use proptest::prelude::*;
use region_map::{Domain, Surface};
use subdiv::subdivide;

const EXACT: EncodeOptions = EncodeOptions { bits: None };

/// A base mesh, subdivided as the pipeline does, its vertices moved.
fn subdivided(base: TriMesh, levels: u32, moved: impl Fn(DVec3) -> DVec3) -> TriMesh {
    let surface = Surface::with_creases(base, 40.0).unwrap();
    let mesh = subdivide(&Domain::identity(&surface), levels).unwrap().domain.mesh;
    let positions = mesh.positions().iter().map(|&p| moved(p)).collect();
    mesh.with_positions(positions).unwrap()
}

fn greatest_distance(a: &TriMesh, b: &TriMesh) -> f64 {
    assert_eq!(a.faces(), b.faces());
    a.positions().iter().zip(b.positions().iter()).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
}

/// A sphere bulges outwards: the middle of a chord of length c is 1 - sqrt(1 - c^2 / 4) below it, about a quarter of that with half the chord.
#[test]
fn displacements_of_a_sphere_are_outwards_and_a_quarter_from_level_to_level() {
    let levels = 5;
    let sphere = (0..levels).fold(fixtures::icosphere(1), |mesh, _| subdivided(mesh, 1, DVec3::normalize));
    let displacement = encode(&sphere, levels, &EXACT).unwrap();
    let meshes = Levels::new(&sphere, levels).unwrap();
    for (level, LevelDisplacement { scalar, residual }) in (1..).zip(&displacement.levels) {
        let parents = meshes.parents(level).unwrap();
        let chords = parents.iter().filter(|[a, b]| a != b).map(|&[a, b]| sphere.distance(VertexId(a), VertexId(b)));
        for ((chord, scalar), t) in chords.zip(scalar.values()).zip(residual.values().chunks_exact(2)) {
            let height = 1.0 - (1.0 - chord * chord / 4.0).sqrt();
            assert!(scalar > 0.0 && (scalar.hypot(t[0]).hypot(t[1]) - height).abs() < 1e-14, "level {level}");
            // Both faces of an edge of the icosahedron lean equally.
            assert!(level > 1 || t[0].hypot(t[1]) < 1e-15);
        }
    }
    let figures = figures(&displacement, &sphere).unwrap();
    // The first split makes edges of two lengths, so that the ratio gets to 4 a little later.
    for (pair, least) in figures.levels.windows(2).zip([3.4, 3.8, 3.9, 3.95]) {
        let ratio = pair[0].scalar.rms / pair[1].scalar.rms;
        assert!((least..4.0).contains(&ratio), "{ratio}");
    }
    // The surface is smooth: what is across the normal is small beside what is along it.
    assert!(figures.levels[4].residual.rms < 0.1 * figures.levels[4].scalar.rms);
    assert!(figures.without_residual.greatest < 0.01);
}

/// With borders, where an edge has one face.
#[test]
fn a_plane_has_no_displacement() {
    let plane = subdivided(fixtures::plane(), 2, |p| p);
    let displacement = encode(&plane, 2, &EXACT).unwrap();
    for level in &displacement.levels {
        let all = [level.scalar.values(), level.residual.values()].concat();
        assert!(all.iter().all(|x| x.abs() < 1e-15), "{all:?}");
    }
    let bent = subdivided(fixtures::plane(), 3, |p| p + (p.x * p.x - p.y * p.x) * DVec3::Z);
    let displacement = encode(&bent, 3, &EXACT).unwrap();
    assert!(greatest_distance(&displacement.decode(3, Residual::Kept).unwrap(), &bent) < 1e-12 * bent.diagonal());
}

#[test]
fn every_level_comes_back() {
    for base in [fixtures::cube(2), fixtures::torus(2.0, 0.7, 9, 6), fixtures::l_block(1)] {
        let mesh = subdivided(base, 3, |p| p + 0.1 * DVec3::new((3.0 * p.y).sin(), (2.0 * p.z).cos(), (5.0 * p.x * p.y).sin()));
        let displacement = encode(&mesh, 3, &EXACT).unwrap();
        let levels = Levels::new(&mesh, 3).unwrap();
        for level in 0..=3 {
            let decoded = displacement.decode(level, Residual::Kept).unwrap();
            assert!(greatest_distance(&decoded, &levels.mesh(level).unwrap()) < 1e-12 * mesh.diagonal(), "level {level}");
        }
        let figures = figures(&displacement, &mesh).unwrap();
        assert!(figures.with_residual.greatest < 1e-12 && figures.with_residual.rms <= figures.with_residual.greatest);
        assert!(figures.without_residual.greatest > figures.with_residual.greatest);
    }
}

/// Every vertex is off by at most half a step along each axis of its own level: errors don't add up.
#[test]
fn quantisation_costs_half_a_step() {
    let mesh = subdivided(fixtures::cube(2), 4, |p| p + 0.2 * DVec3::new(p.y.sin(), (4.0 * p.z).cos(), (3.0 * p.x).sin()));
    let mut last = f64::INFINITY;
    for bits in [2, 4, 8, 12, 16, 24] {
        let displacement = encode(&mesh, 4, &EncodeOptions { bits: Some(bits) }).unwrap();
        let step = |numbers: &Coefficients| match numbers {
            Coefficients::Quantised { multiples, step } => {
                assert!(multiples.iter().all(|m| m.abs() < 1 << (bits - 1)));
                *step
            }
            Coefficients::Exact(_) => panic!("{bits} bits: not quantised"),
        };
        let bound = displacement.levels.iter().map(|level| {
            let [scalar, residual] = [&level.scalar, &level.residual].map(step);
            0.5 * (scalar * scalar + 2.0 * residual * residual).sqrt()
        });
        let bound = bound.fold(0.0, f64::max);
        let off = greatest_distance(&displacement.decode(4, Residual::Kept).unwrap(), &mesh);
        assert!(off <= bound * (1.0 + 1e-9), "{bits} bits: {off} is more than {bound}");
        assert!(off < last, "{bits} bits");
        last = off;
        let said = figures(&displacement, &mesh).unwrap().with_residual.greatest;
        assert!((said - off / mesh.diagonal()).abs() < 1e-15);
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let mesh = subdivided(fixtures::cube(2), 2, |p| p);
    assert!(matches!(encode(&mesh, 3, &EXACT), Err(DisplacementError::Levels(_))));
    for bits in [0, 1, 25, 255] {
        assert_eq!(encode(&mesh, 2, &EncodeOptions { bits: Some(bits) }), Err(DisplacementError::Bits(bits)));
    }
    let good = encode(&mesh, 2, &EXACT).unwrap();
    assert_eq!(good.decode(3, Residual::Kept), Err(DisplacementError::NoLevel { level: 3, finest: 2 }));
    assert_eq!(figures(&good, &subdivided(fixtures::cube(3), 2, |p| p)), Err(DisplacementError::OtherMesh));

    let mut short = good.clone();
    short.levels[1].scalar = Coefficients::Exact(vec![0.0; 3]);
    assert!(short.decode(1, Residual::Kept).is_ok());
    let told = short.decode(2, Residual::Kept).unwrap_err().to_string();
    assert!(told.starts_with("level 2 has 3 scalar displacements"), "{told}");
    let mut short = good.clone();
    short.levels[0].residual = Coefficients::Quantised { multiples: vec![0; 5], step: 0.1 };
    assert!(matches!(short.decode(2, Residual::Dropped), Err(DisplacementError::Count { level: 1, found: 5, .. })));

    for number in [f64::NAN, f64::INFINITY, f64::MAX] {
        let mut broken = good.clone();
        broken.levels[0].scalar = Coefficients::Exact(vec![number; good.levels[0].scalar.len()]);
        broken.levels[0].residual = Coefficients::Exact(vec![number; good.levels[0].residual.len()]);
        assert!(matches!(broken.decode(2, Residual::Kept), Err(DisplacementError::NoMesh { level: 1, .. })), "{number}");
    }
    let three = TriMesh::from_slices(&[[0.0; 3]; 5], &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]).unwrap();
    let broken = Displacement { base: three, levels: good.levels };
    assert!(matches!(broken.decode(1, Residual::Kept), Err(DisplacementError::NotManifold { level: 0, .. })));
}

/// New vertices in another order are a table of their own: the base mesh does not tell it.
#[test]
fn another_numbering_is_refused() {
    let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    let mesh = TriMesh::from_slices(&corners, &[[0, 4, 3], [1, 5, 4], [2, 3, 5], [5, 3, 4]]).unwrap();
    assert_eq!(encode(&mesh, 1, &EXACT), Err(DisplacementError::OtherNumbering { level: 1 }));
}

/// Random numbers on levels of a base mesh.
fn random_displacement() -> impl Strategy<Value = Displacement> {
    let bases = || vec![fixtures::cube(1), fixtures::icosphere(1), fixtures::plane(), fixtures::cylinder(1.0, 2.0, 5)];
    let numbers = prop::collection::vec(-1.0..1.0f64, 64);
    (0..bases().len(), 0..3u32, -3..3i32, numbers).prop_map(move |(base, levels, exponent, numbers)| {
        let base = bases().swap_remove(base);
        let positions: Vec<DVec3> = base.positions().iter().enumerate().map(|(v, &p)| p + 0.1 * numbers[v % 64]).collect();
        let mut displacement = Displacement { base: base.with_positions(positions).unwrap(), levels: Vec::new() };
        for level in 0..levels {
            let mesh = displacement.decode(level, Residual::Kept).unwrap();
            let n = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap().n_edges();
            let many = |n: usize, shift: usize| {
                Coefficients::Exact((0..n).map(|i| numbers[(i * 7 + shift) % 64] * 10f64.powi(exponent)).collect())
            };
            displacement.levels.push(LevelDisplacement { scalar: many(n, 3), residual: many(2 * n, 5) });
        }
        displacement
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn random_displacements_come_back(displacement in random_displacement()) {
        let levels = displacement.finest();
        let mesh = displacement.decode(levels, Residual::Kept).unwrap();
        let again = encode(&mesh, levels, &EXACT).unwrap();
        prop_assert_eq!(&again.base, &displacement.base);
        let decoded = again.decode(levels, Residual::Kept).unwrap();
        prop_assert!(greatest_distance(&decoded, &mesh) <= 1e-12 * mesh.diagonal());
        let numbers = |d: &Displacement| -> Vec<f64> {
            d.levels.iter().flat_map(|level| [level.scalar.values(), level.residual.values()].concat()).collect()
        };
        for (a, b) in numbers(&again).iter().zip(numbers(&displacement)) {
            prop_assert!((a - b).abs() <= 1e-9 * mesh.diagonal());
        }
    }
}
