//! Patches, their arcs and corners, and everything that is not a complex of disks.

use crate::{crease_network, marked_network, sphere_with_dart, topology};
use glam::DVec3;
use mesh_core::{FaceId, IdVec, Topology, TriMesh};
use region_map::{CellError, Cells, Network, PatchId, Segmentation, Surface};

/// A segmentation by a number for every face.
fn segmentation(mesh: &TriMesh, patch: impl Fn(FaceId) -> u32) -> Segmentation {
    let patch_of_face: IdVec<FaceId, PatchId> = mesh.faces().ids().map(|f| PatchId(patch(f))).collect();
    let n_patches = patch_of_face.iter().map(|p| p.0 as usize + 1).max().unwrap_or(0);
    Segmentation { patch_of_face, n_patches }
}

/// Traces, and checks what holds for all cells. Returns also the numbers of corners, arcs and patches.
fn check(mesh: &TriMesh, network: &Network, segmentation: &Segmentation) -> (Cells, [usize; 3]) {
    let topology = topology(mesh);
    let cells = Cells::trace(&surface(mesh, network), segmentation).unwrap();
    let counts = [cells.corners.len(), cells.arcs.len(), cells.patches.len()];
    assert_eq!(counts[0] as i64 - counts[1] as i64 + counts[2] as i64, topology.euler());
    check_borders(&topology, segmentation, &cells);
    for arc in &cells.arcs {
        for t in (0..=10).map(|i| arc.length() * f64::from(i) / 10.0) {
            let position = arc.position(mesh, t);
            assert!(arc.point(&topology, t).position(mesh).distance(position) < 1e-12 * mesh.diagonal());
            if let Some(on) = arc.on {
                let along = on.from + (on.to - on.from) * t / arc.length();
                assert!(network.arcs[on.arc].position(mesh, along).distance(position) < 1e-9 * mesh.diagonal());
            }
        }
    }
    let covered: f64 = cells.arcs.iter().filter(|a| a.on.is_some()).map(|a| a.length()).sum();
    assert!((covered - network.total_length()).abs() < 1e-9 * mesh.diagonal());
    (cells, counts)
}

/// Every patch is on the left of its border, a closed walk; every arc has its two sides, which differ.
fn check_borders(topology: &Topology, segmentation: &Segmentation, cells: &Cells) {
    let mut uses = IdVec::filled(0, cells.arcs.len());
    for (p, patch) in cells.patches.enumerate() {
        assert!(patch.faces.iter().all(|&f| segmentation.patch_of_face[f] == p));
        let ends: Vec<_> = patch
            .border
            .iter()
            .map(|&(a, forward)| {
                uses[a] += 1;
                let beside = cells.beside(topology, segmentation, a);
                assert_eq!(beside[usize::from(!forward)], Some(p));
                let [from, to] = cells.arcs[a].corners;
                if forward { [from, to] } else { [to, from] }
            })
            .collect();
        for (i, &[_, to]) in ends.iter().enumerate() {
            assert_eq!(to, ends[(i + 1) % ends.len()][0]);
        }
    }
    for a in cells.arcs.ids() {
        let [left, right] = cells.beside(topology, segmentation, a);
        assert_ne!(left, right);
        assert_eq!(uses[a], usize::from(left.is_some()) + usize::from(right.is_some()));
    }
}

fn surface(mesh: &TriMesh, network: &Network) -> Surface {
    Surface::new(mesh.clone(), topology(mesh), network.clone()).unwrap()
}

fn error(mesh: &TriMesh, network: &Network, segmentation: &Segmentation) -> CellError {
    Cells::trace(&surface(mesh, network), segmentation).unwrap_err()
}

/// One patch a sheet.
fn sheets(mesh: &TriMesh, network: &Network) -> Segmentation {
    segmentation(mesh, |f| network.sheet_of_face[f].0)
}

/// The sector of a position round the z axis, of `n`.
fn sector(p: DVec3, n: u32) -> u32 {
    let turn = p.y.atan2(p.x).rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
    (turn * f64::from(n)) as u32
}

#[test]
fn the_sides_of_polyhedra_are_cells() {
    for (mesh, expected) in [
        (fixtures::cube(1), [8, 12, 6]),
        (fixtures::cube(3), [8, 12, 6]),
        (fixtures::l_block(2), [12, 18, 8]),
        (fixtures::crossing_boxes(2), [16, 24, 12]),
    ] {
        let network = crease_network(&mesh, &topology(&mesh));
        let (cells, counts) = check(&mesh, &network, &sheets(&mesh, &network));
        assert_eq!(counts, expected);
        assert!(cells.arcs.iter().all(|a| a.on.is_some()));
        assert!(cells.least_segments().iter().all(|&k| k == 1));
    }
}

#[test]
fn single_triangles_are_patches() {
    let mesh = fixtures::icosphere(1);
    let network = crease_network(&mesh, &topology(&mesh));
    let (_, counts) = check(&mesh, &network, &segmentation(&mesh, |f| f.0));
    assert_eq!(counts, [12, 30, 20]);
}

#[test]
fn a_cylinder_in_quarters() {
    let mesh = fixtures::cylinder(1.0, 2.0, 16);
    let network = crease_network(&mesh, &topology(&mesh));
    // Quarters that begin at each of the 16 sides: the rims' loops begin inside, at the start and at the end of an arc.
    for start in 0..16 {
        let turn = glam::DQuat::from_rotation_z(-std::f64::consts::TAU * f64::from(start) / 16.0);
        let by_place = |f| match mesh.normal(f).z {
            z if z > 0.5 => 4,
            z if z < -0.5 => 5,
            _ => sector(turn * mesh.centroid(f), 4),
        };
        let (cells, counts) = check(&mesh, &network, &segmentation(&mesh, by_place));
        assert_eq!(counts, [8, 12, 6]);
        assert_eq!(cells.arcs.iter().filter(|a| a.on.is_some()).count(), 8);
        assert!(cells.least_segments().iter().all(|&k| k == 1));
    }
}

#[test]
fn a_sphere_in_octants_halves_and_lunes() {
    let mesh = fixtures::uv_sphere(24);
    let network = crease_network(&mesh, &topology(&mesh));
    let centroid = |f| mesh.centroid(f);
    let upper = |f| u32::from(centroid(f).z > 0.0);
    let (cells, counts) = check(&mesh, &network, &segmentation(&mesh, |f| 2 * sector(centroid(f), 4) + upper(f)));
    assert_eq!(counts, [6, 12, 8]);
    assert!(cells.arcs.iter().all(|a| a.on.is_none()));

    // A closed arc gets a corner, and needs three segments.
    let (cells, counts) = check(&mesh, &network, &segmentation(&mesh, upper));
    assert_eq!(counts, [1, 1, 2]);
    assert_eq!(cells.least_segments().as_slice(), [3]);

    // Arcs that share both ends need two.
    let (cells, counts) = check(&mesh, &network, &segmentation(&mesh, |f| sector(centroid(f), 3)));
    assert_eq!(counts, [2, 3, 3]);
    assert_eq!(cells.least_segments().as_slice(), [2, 2, 2]);
}

#[test]
fn an_open_patch_has_the_outside_beside_it() {
    let mesh = fixtures::plane();
    let network = crease_network(&mesh, &topology(&mesh));
    let (cells, counts) = check(&mesh, &network, &sheets(&mesh, &network));
    assert_eq!(counts, [1, 1, 1]);
    assert!((cells.arcs.iter().next().unwrap().length() - 320.0).abs() < 1e-12);
}

#[test]
fn an_arc_of_the_network_may_not_run_inside_a_patch() {
    let cube = fixtures::cube(2);
    let network = crease_network(&cube, &topology(&cube));
    let halves = segmentation(&cube, |f| u32::from(cube.centroid(f).z > 0.5));
    assert_eq!(error(&cube, &network, &halves), CellError::ArcInside(PatchId(0)));
    let (sphere, _, dart) = sphere_with_dart();
    let halves = segmentation(&sphere, |f| u32::from(sphere.centroid(f).x > 0.0));
    assert_eq!(error(&sphere, &dart, &halves), CellError::ArcInside(PatchId(1)));
}

#[test]
fn a_corner_of_the_network_may_not_lie_inside_a_patch() {
    let mesh = fixtures::uv_sphere(16);
    let pole = mesh.positions().ids().find(|&v| mesh.position(v).z > 0.999).unwrap();
    let network = marked_network(&mesh, &topology(&mesh), |_| false, |v| v == pole);
    let halves = segmentation(&mesh, |f| u32::from(mesh.centroid(f).z > 0.0));
    assert_eq!(error(&mesh, &network, &halves), CellError::CornerInside(PatchId(1), pole));
    let lunes = segmentation(&mesh, |f| sector(mesh.centroid(f), 4));
    assert_eq!(check(&mesh, &network, &lunes).1, [2, 4, 4]);
}

#[test]
fn what_is_not_a_disk_is_named() {
    let smooth = |mesh: &TriMesh| crease_network(mesh, &topology(mesh));
    let sphere = fixtures::uv_sphere(16);
    let z = |f| sphere.centroid(f).z;
    let all = segmentation(&sphere, |_| 0);
    assert_eq!(error(&sphere, &smooth(&sphere), &all), CellError::NotADisk(PatchId(0)), "closed");
    let belt = segmentation(&sphere, |f| if z(f).abs() < 0.5 { 2 } else { u32::from(z(f) > 0.0) });
    assert_eq!(error(&sphere, &smooth(&sphere), &belt), CellError::NotADisk(PatchId(2)), "a ring");
    let caps = segmentation(&sphere, |f| u32::from(z(f).abs() < 0.5));
    assert_eq!(error(&sphere, &smooth(&sphere), &caps), CellError::NotADisk(PatchId(0)), "in two parts");
    let empty = Segmentation { n_patches: 3, ..segmentation(&sphere, |f| u32::from(z(f) > 0.0)) };
    assert_eq!(error(&sphere, &smooth(&sphere), &empty), CellError::NotADisk(PatchId(2)), "without faces");
    let torus = fixtures::torus(1.0, 0.4, 24, 16);
    let handle = segmentation(&torus, |f| u32::from(f.0 == 7));
    assert_eq!(error(&torus, &smooth(&torus), &handle), CellError::NotADisk(PatchId(0)), "with a handle");
    // Opposite quarters of a disk touch in its middle.
    let pinched = segmentation(&sphere, |f| match sector(sphere.centroid(f), 4) {
        _ if z(f) < 0.0 => 3,
        0 | 2 => 0,
        other => other.div_ceil(2),
    });
    assert_eq!(error(&sphere, &smooth(&sphere), &pinched), CellError::NotADisk(PatchId(0)), "pinched");
}

#[test]
fn a_closed_torus_does_not_hide_in_a_disk() {
    // The Euler number of a disk and a torus together is 1, and their border is one cycle.
    let (torus, sphere) = (fixtures::torus(1.0, 0.4, 24, 16), fixtures::uv_sphere(16));
    let first = torus.n_vertices() as u32;
    let positions = torus.positions().iter().chain(sphere.positions()).copied().collect();
    let shifted = sphere.faces().iter().map(|f| f.map(|v| v.0 + first));
    let mesh = TriMesh::new(positions, torus.faces().iter().map(|f| f.map(|v| v.0)).chain(shifted).collect()).unwrap();
    let halves = segmentation(&mesh, |f| u32::from(f.0 as usize >= torus.n_faces() && mesh.centroid(f).z > 0.0));
    assert_eq!(error(&mesh, &crease_network(&mesh, &topology(&mesh)), &halves), CellError::NotADisk(PatchId(0)));
}

#[test]
fn a_segmentation_of_another_mesh_is_refused() {
    let cube = fixtures::cube(1);
    let network = crease_network(&cube, &topology(&cube));
    let right = sheets(&cube, &network);
    assert_eq!(check(&cube, &network, &right).1, [8, 12, 6]);
    let too_many_faces = segmentation(&fixtures::cube(2), |_| 0);
    let too_few_patches = Segmentation { n_patches: 5, ..right };
    for other in [too_many_faces, too_few_patches] {
        assert_eq!(error(&cube, &network, &other), CellError::OtherMesh);
    }
}
