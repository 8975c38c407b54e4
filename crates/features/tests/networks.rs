//! The network of shapes whose creases are known.

use features::{FeatureError, FeatureOptions, detect};
use mesh_core::{Topology, TriMesh, VertexId};
use region_map::{ArcKind, Network};

fn topology(mesh: &TriMesh) -> Topology {
    Topology::new(mesh.faces(), mesh.n_vertices()).expect("a manifold")
}

/// The network at a base edge length, without marked edges, by the default options.
fn network(mesh: &TriMesh, base_edge_length: f64) -> Network {
    detect(mesh, &topology(mesh), &[], base_edge_length, &FeatureOptions::default()).expect("valid options")
}

/// A square sheet of `n` by `n` quads over the unit square with the heights `z`.
fn sheet(n: u32, z: impl Fn(f64, f64) -> f64) -> TriMesh {
    let at = |i: u32| f64::from(i) / f64::from(n);
    let grid = (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j)));
    let positions = grid.map(|(i, j)| glam::DVec3::new(at(i), at(j), z(at(i), at(j)))).collect();
    let quads = (0..n).flat_map(|j| (0..n).map(move |i| j * (n + 1) + i));
    let faces = quads.flat_map(|a| [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]).collect();
    TriMesh::new(positions, faces).expect("a mesh")
}

#[test]
fn a_cube_has_its_edges_and_corners_at_any_resolution() {
    for n in [1, 2, 6] {
        for base_edge_length in [0.0, 0.05, 0.5, 1.0] {
            let network = network(&fixtures::cube(n), base_edge_length);
            assert_eq!((network.corners.len(), network.arcs.len(), network.n_sheets), (8, 12, 6));
            assert!(network.minor.is_empty());
        }
    }
}

#[test]
fn a_cylinder_has_two_closed_arcs() {
    let network = network(&fixtures::cylinder(1.0, 2.0, 48), 0.4);
    assert_eq!((network.corners.len(), network.arcs.len(), network.n_sheets), (0, 2, 3));
    assert!(network.arcs.iter().all(|arc| arc.is_loop()));
}

#[test]
fn the_tip_of_a_cone_is_a_corner_and_a_pole_is_not() {
    for sides in [12, 24, 80] {
        let cone = fixtures::cone(1.0, 1.5, sides);
        let network = network(&cone, 0.3);
        assert_eq!(network.corners.iter().map(|&v| cone.position(v).z).collect::<Vec<_>>(), [1.5]);
    }
    for smooth in [fixtures::uv_sphere(24), fixtures::icosphere(5), fixtures::torus(2.0, 0.6, 40, 20)] {
        let network = network(&smooth, 0.3);
        assert!(network.corners.is_empty() && network.arcs.is_empty());
    }
}

#[test]
fn the_border_of_a_sheet_turns_at_its_corners() {
    for n in [1, 3, 40] {
        let network = network(&sheet(n, |_, _| 0.0), 0.2);
        assert_eq!((network.corners.len(), network.arcs.len()), (4, 4));
        assert!(network.arcs.iter().all(|arc| arc.kind == ArcKind::Border && (arc.length() - 1.0).abs() < 1e-12));
    }
}

#[test]
fn a_round_border_has_no_corner_at_any_resolution() {
    let shell = fixtures::cylinder(1.0, 2.0, 36);
    let side: Vec<[u32; 3]> =
        shell.faces().ids().filter(|&f| shell.normal(f).z.abs() < 0.5).map(|f| shell.face(f).map(|v| v.0)).collect();
    let tube = TriMesh::new(shell.positions().as_slice().to_vec(), side).expect("a mesh");
    for base_edge_length in [0.0, 0.1, 0.5, 1.0, 4.0] {
        let network = network(&tube, base_edge_length);
        assert_eq!((network.corners.len(), network.arcs.len()), (0, 2), "at {base_edge_length}");
    }
}

#[test]
fn a_crease_that_fades_out_is_kept_to_its_end() {
    // A roof along y = 1/2 whose slope falls to nothing at x = 1.
    let roof = sheet(40, |x, y| -(1.0 - x) * (y - 0.5).abs());
    let network = network(&roof, 0.1);
    let creases: Vec<_> = network.arcs.iter().filter(|arc| arc.kind == ArcKind::Sharp).collect();
    assert_eq!(creases.len(), 1);
    // The weak angle of 25 degrees is reached where the slope is tan 12.5: at x = 0.78.
    assert!((creases[0].length() - 0.78).abs() < 0.06, "{}", creases[0].length());
}

#[test]
fn crumbs_are_minor() {
    // One sharp little pyramid on a plane of base edge length 1/4.
    let pimple = sheet(40, |x, y| if (x - 0.5).hypot(y - 0.5) < 0.01 { 0.05 } else { 0.0 });
    let kept = network(&pimple, 0.25);
    assert!(kept.arcs.iter().all(|arc| arc.kind == ArcKind::Border));
    assert!(!kept.minor.is_empty());
    let all = network(&pimple, 0.0);
    assert!(all.arcs.len() > 4 && all.minor.is_empty());
}

#[test]
fn a_zigzag_strip_becomes_one_path() {
    // A step of one row of quads, so steep that both of its rims and the diagonals between them are sharp.
    let step = sheet(60, |x, y| if y > 0.505 + 0.01 * (60.0 * x).sin() { 0.03 } else { 0.0 });
    let raw = network(&step, 0.0);
    let simple = network(&step, 0.45);
    let creases = |n: &Network| n.arcs.iter().filter(|arc| arc.kind == ArcKind::Sharp).count();
    assert!(creases(&raw) > 20 && creases(&simple) <= 3, "{} and {}", creases(&raw), creases(&simple));
}

/// Between -1 and 1, with no pattern.
fn noise(x: f64, y: f64) -> f64 {
    2.0 * ((12.9898 * x + 78.233 * y).sin() * 43758.5453).rem_euclid(1.0) - 1.0
}

#[test]
fn a_crease_is_told_from_the_noise_of_a_scan() {
    // A roof of 90 degrees along y = 1/2, its vertices shaken by a third of an edge.
    let roof = sheet(60, |x, y| 0.006 * noise(x, y) - (y - 0.5).abs());
    let raw = network(&roof, 0.0);
    let kept = network(&roof, 0.2);
    let sharp = |n: &Network| n.arcs.iter().filter(|arc| arc.kind == ArcKind::Sharp).cloned().collect::<Vec<_>>();
    assert!(sharp(&raw).len() > 20, "{} creases in the noise", sharp(&raw).len());
    let kept = sharp(&kept);
    let length: f64 = kept.iter().map(|arc| arc.length()).sum();
    assert!((0.9..1.5).contains(&length), "{length} of a ridge of 1 in {} arcs", kept.len());
    assert!(kept.iter().flat_map(|arc| &arc.vertices).all(|&v| (roof.position(v).y - 0.5).abs() < 0.05));
}

#[test]
fn rims_of_small_pins_are_kept_as_long_as_there_are_few() {
    // Pins with a girth of five quarters of a base edge over a sheet that takes 29 base vertices: a third of them is enough for three rims.
    let pin = fixtures::cylinder(0.04, 0.05, 12);
    let ground = sheet(20, |_, _| 0.0);
    for (pins, kept) in [(1, 2), (4, 3)] {
        let mut positions = ground.positions().as_slice().to_vec();
        let mut faces: Vec<[u32; 3]> = ground.faces().iter().map(|f| f.map(|v| v.0)).collect();
        for i in 0..pins {
            let first = positions.len() as u32;
            positions.extend(pin.positions().iter().map(|&p| p + glam::DVec3::new(0.1 * f64::from(i), 0.0, 1.0)));
            faces.extend(pin.faces().iter().map(|f| f.map(|v| v.0 + first)));
        }
        let network = network(&TriMesh::new(positions, faces).expect("a mesh"), 0.2);
        assert_eq!(network.arcs.iter().filter(|arc| arc.kind == ArcKind::Sharp).count(), kept, "of {pins} pins");
    }
}

#[test]
fn noise_without_a_crease_has_none() {
    let rough = sheet(60, |x, y| 0.005 * noise(x, y));
    assert!(network(&rough, 0.0).arcs.len() > 20);
    let kept = network(&rough, 0.2);
    let length: f64 = kept.arcs.iter().filter(|arc| arc.kind == ArcKind::Sharp).map(|arc| arc.length()).sum();
    assert_eq!(length, 0.0, "of {}", network(&rough, 0.0).crease_lengths(&rough).kept);
}

#[test]
fn marked_edges_stay_and_must_exist() {
    let flat = sheet(8, |_, _| 0.0);
    let marked = |edges: &[[u32; 2]]| {
        let edges: Vec<_> = edges.iter().map(|e| e.map(VertexId)).collect();
        detect(&flat, &topology(&flat), &edges, 10.0, &FeatureOptions::default())
    };
    let network = marked(&[[30, 31], [32, 31]]).expect("edges");
    let arc = network.arcs.iter().find(|arc| arc.kind == ArcKind::Marked).expect("the marked chain");
    assert_eq!(arc.vertices.len(), 3);
    for [a, b] in [[0, 80], [0, 999], [999, 0], [3, 3]] {
        assert_eq!(marked(&[[a, b]]).expect_err("no edge"), FeatureError::NotAnEdge(VertexId(a), VertexId(b)));
    }
}

#[test]
fn options_out_of_range_are_named() {
    let flat = sheet(2, |_, _| 0.0);
    let refused = |base_edge_length: f64, options: &FeatureOptions| {
        detect(&flat, &topology(&flat), &[], base_edge_length, options).expect_err("refused").to_string()
    };
    let defaults = FeatureOptions::default();
    assert_eq!(refused(-1.0, &defaults), "base edge length -1 must be finite and not negative");
    for (strong_angle, weak_angle) in [(40.0, 50.0), (180.1, 25.0), (40.0, 0.0), (f64::NAN, 25.0), (40.0, f64::NAN)] {
        let message = refused(0.0, &FeatureOptions { strong_angle, weak_angle, ..defaults.clone() });
        assert!(message.contains("0 < weak <= strong <= 180"), "{message}");
    }
    let message = refused(0.0, &FeatureOptions { persistence: -0.5, ..defaults.clone() });
    assert_eq!(message, "the factor -0.5 on the persistence of creases must not be negative");
}

#[test]
fn at_180_degrees_there_are_no_creases() {
    // Two triangles on each other, joined along one edge: a fold of exactly 180 degrees.
    let positions = [[0.0, 0.0], [1.0, 0.0], [0.5, 2.0], [0.5, 1.0]].map(|[x, y]| glam::DVec3::new(x, y, 0.0)).to_vec();
    let flap = TriMesh::new(positions, vec![[0, 1, 2], [1, 0, 3]]).expect("a mesh");
    for mesh in [flap, fixtures::cube(2), sheet(4, |x, y| 3.0 * x * y)] {
        let creases = |strong_angle: f64| {
            let options = FeatureOptions { strong_angle, ..FeatureOptions::default() };
            let network = detect(&mesh, &topology(&mesh), &[], 0.0, &options).expect("in range");
            network.arcs.iter().filter(|arc| arc.kind == ArcKind::Sharp).count()
        };
        assert_eq!(creases(180.0), 0);
    }
}

/// A floor with a step across it whose height falls from `height` at x = 0 to nothing at x = 1, with the square of the way to there, and then an even floor: `n` columns to the end of the
/// step, and the wall of the step in `rows` rows.
fn fading_step(n: u32, rows: u32, height: f64) -> TriMesh {
    let last = 2 * n + rows;
    let id = |i: u32, row: u32| if i >= n && (n..=n + rows).contains(&row) { i * (last + 1) + n } else { i * (last + 1) + row };
    let step = 1.0 / f64::from(n);
    let at = |i: u32, row: u32| {
        let x = f64::from(i) * step;
        let wall = f64::from(row.clamp(n, n + rows) - n) / f64::from(rows);
        let y = f64::from(row.min(n) + row.max(n + rows)) - f64::from(2 * n + rows);
        glam::DVec3::new(x, y * step, wall * height * (1.0 - x).max(0.0).powi(2))
    };
    let positions = (0..=2 * n).flat_map(|i| (0..=last).map(move |row| at(i, row))).collect();
    let quads =
        (0..2 * n).flat_map(|i| (0..last).map(move |row| [id(i, row), id(i + 1, row), id(i + 1, row + 1), id(i, row + 1)]));
    let triangles = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    TriMesh::new(positions, triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect()).expect("a mesh")
}

#[test]
fn the_thin_tip_of_a_step_that_fades_out_is_blunt() {
    let end_of_step = |step: &TriMesh, base_edge_length: f64| {
        let network = network(step, base_edge_length);
        let creases = network.arcs.iter().filter(|arc| arc.kind == ArcKind::Sharp);
        let end = creases.flat_map(|arc| &arc.vertices).map(|&v| step.position(v).x).fold(0.0, f64::max);
        (end, network.n_sheets)
    };
    for rows in [1, 2, 5] {
        // Half a degree, and 0.0025 high, 1/80 of a base edge, at x = 0.9.
        let (end, n_sheets) = end_of_step(&fading_step(80, rows, 0.25), 0.2);
        assert!((0.85..=0.92).contains(&end) && n_sheets == 2, "{rows} rows: {end}, {n_sheets} sheets");
        // Four times as high.
        let (end, n_sheets) = end_of_step(&fading_step(80, rows, 1.0), 0.2);
        assert!(end > 0.999 && n_sheets == 2, "{rows} rows: {end}, {n_sheets} sheets");
    }
}

/// A fold along the x axis, and the tip of a roof that ends so far from it: its two eaves and its ridge meet there.
fn fold_beside_roof(gap: f64) -> TriMesh {
    let at = |x: f64, y: f64, z: f64| [x, y, z];
    let positions = [
        at(-1.0, 0.0, 0.0),
        at(1.0, 0.0, 0.0),
        at(0.0, gap, 0.0),
        at(-1.0, 1.0 + gap, 0.0),
        at(1.0, 1.0 + gap, 0.0),
        at(0.0, 1.0 + gap, 2.0),
        at(-1.0, -1.0, 2.0),
        at(1.0, -1.0, 2.0),
    ];
    let faces = [[0, 1, 2], [0, 2, 3], [1, 4, 2], [2, 4, 5], [2, 5, 3], [6, 7, 1], [6, 1, 0]];
    TriMesh::from_slices(&positions, &faces).expect("a mesh")
}

#[test]
fn creases_that_nearly_touch_do_touch() {
    let sheets = |gap: f64| network(&fold_beside_roof(gap), 0.5).n_sheets;
    // Both sides of the roof, what is before the fold and what is behind it, around the roof.
    assert_eq!(sheets(0.01), 4);
    // A thousandth of a base edge: the fold runs through the tip, and parts what is left of the roof from what is right of it.
    assert_eq!(sheets(0.0005), 5);
}
