//! What is carried over is what was there.

use attributes::{Source, corner_normals, corner_values, correspond, face_values, vertex_labels, vertex_values};
use glam::DVec3;
use mesh_core::{CleanOptions, Cleaned, EdgeId, IdVec, Soup, Topology, TriMesh, clean};
use std::f64::consts::TAU;

fn cleaned(soup: &Soup) -> Cleaned {
    clean(soup, &CleanOptions::default()).unwrap()
}

/// The edges of a mesh that bend by more than 45 degrees.
fn bent(mesh: &TriMesh, topology: &Topology) -> IdVec<EdgeId, bool> {
    let is_bent = |e| match topology.edge_faces(e) {
        (f, Some(g)) => mesh.normal(f).dot(mesh.normal(g)) < 0.7,
        (_, None) => false,
    };
    topology.edge_ids().map(is_bent).collect()
}

#[test]
fn normals_are_smooth_but_across_hard_edges() {
    let mesh = fixtures::cube(3);
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let sharp = corner_normals(&mesh, &topology, &bent(&mesh, &topology));
    for (f, corners) in mesh.faces().ids().zip(&sharp) {
        assert!(corners.iter().all(|&n| DVec3::from(n).distance(mesh.normal(f)) < 1e-12));
    }
    let smooth = corner_normals(&mesh, &topology, &IdVec::filled(false, topology.n_edges()));
    let mut of_vertices = vec![None; mesh.n_vertices()];
    for (face, corners) in mesh.faces().iter().zip(&smooth) {
        for (v, normal) in face.iter().zip(corners) {
            assert_eq!(*of_vertices[v.0 as usize].get_or_insert(*normal), *normal, "one normal a vertex, to the last bit");
        }
    }
    // Weights by angles: three sides of a cube count alike at a corner, however they are cut into triangles.
    let centre = mesh.bounds().unwrap().centre();
    let (corner, _) =
        mesh.positions().iter().enumerate().max_by(|a, b| a.1.distance(centre).total_cmp(&b.1.distance(centre))).unwrap();
    let outwards = (mesh.positions().as_slice()[corner] - centre).normalize();
    assert!(DVec3::from(of_vertices[corner].unwrap()).distance(outwards) < 1e-12);
}

/// A tube of `n` by `rows` squares around z with the unit circle unrolled to u in 0 to 1: one island that borders on itself.
fn tube(n: u32, rows: u32) -> (Soup, Vec<[[f64; 2]; 3]>) {
    let mut positions = Vec::new();
    for row in 0..=rows {
        for i in 0..n {
            let turn = TAU * f64::from(i) / f64::from(n);
            positions.push(DVec3::new(turn.cos(), turn.sin(), f64::from(row) / f64::from(rows)));
        }
    }
    let (mut triangles, mut uvs) = (Vec::new(), Vec::new());
    for row in 0..rows {
        for i in 0..n {
            let vertex = |i: u32, row: u32| row * n + i % n;
            let uv = |i: u32, row: u32| [f64::from(i) / f64::from(n), f64::from(row) / f64::from(rows)];
            for corners in [[(i, row), (i + 1, row), (i + 1, row + 1)], [(i, row), (i + 1, row + 1), (i, row + 1)]] {
                triangles.push(corners.map(|(i, row)| vertex(i, row)));
                uvs.push(corners.map(|(i, row)| uv(i, row)));
            }
        }
    }
    (Soup { positions, triangles }, uvs)
}

/// Distance between places on the tube, in turns.
fn turns_apart(u: f64, p: DVec3) -> f64 {
    let turn = p.y.atan2(p.x) / TAU;
    (u - turn - (u - turn).round()).abs()
}

#[test]
fn a_seam_is_found_and_no_face_is_torn_across_it() {
    let (soup, uvs) = tube(24, 8);
    let cleaned = cleaned(&soup);
    let source = Source::new(&soup, &cleaned);
    let seam = source.seams(&uvs, 1e-6);
    let ends = source.ends_of(&seam);
    assert_eq!(ends.len(), 8);
    assert!(ends.iter().flatten().all(|p| p.y == 0.0 && p.x == 1.0));
    // Another number of vertices around, so that its faces reach over the seam.
    let mesh = TriMesh::new(tube(31, 5).0.positions, tube(31, 5).0.triangles).unwrap();
    for shift in [0.0, 0.05] {
        let turned = mesh
            .positions()
            .iter()
            .map(|p| DVec3::new(p.x * f64::cos(shift) - p.y * shift.sin(), p.x * shift.sin() + p.y * shift.cos(), p.z));
        let mesh = mesh.with_positions(turned.collect()).unwrap();
        let carried = corner_values(&mesh, &correspond(&source, &seam, &mesh), &uvs);
        for (face, uvs) in mesh.faces().iter().zip(&carried) {
            for (&v, [u, height]) in face.iter().zip(uvs) {
                let p = mesh.position(v);
                assert!(turns_apart(*u, p) < 0.01 && (height - p.z).abs() < 1e-9, "{u} {height} at {p}");
            }
            let span = uvs.iter().map(|uv| uv[0]).fold(f64::MIN, f64::max) - uvs.iter().map(|uv| uv[0]).fold(f64::MAX, f64::min);
            assert!(span < 1.5 / 31.0, "a face {span} wide");
        }
    }
}

#[test]
fn corners_that_no_cut_parts_have_the_same_value() {
    let (soup, uvs) = tube(24, 8);
    let cleaned = cleaned(&soup);
    let source = Source::new(&soup, &cleaned);
    let other = tube(31, 5).0;
    let mesh = TriMesh::new(other.positions, other.triangles).unwrap();
    let carried = corner_values(&mesh, &correspond(&source, &source.seams(&uvs, 1e-6), &mesh), &uvs);
    let mut values = vec![Vec::new(); mesh.n_vertices()];
    for (v, uv) in mesh.faces().iter().flatten().zip(carried.iter().flatten()) {
        let known = &mut values[v.0 as usize];
        if !known.contains(uv) {
            known.push(*uv);
        }
    }
    // The vertices at angle 0 are on the seam, and have both sides' values; all others have one.
    assert!(values.iter().enumerate().all(|(v, values)| values.len() == if v % 31 == 0 { 2 } else { 1 }));
}

/// A square with a narrow strip of another label across it: a triangle whose middle lies in the strip has the label of what is around.
#[test]
fn a_face_has_the_label_of_the_most_of_its_area() {
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let corners = [0.0, 0.6, 0.7, 1.0].map(|x| [p(x, 0.0), p(x, 1.0)]).concat();
    let quads = [[0, 2, 3, 1], [2, 4, 5, 3], [4, 6, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let soup = Soup { positions: corners, triangles };
    let cleaned = cleaned(&soup);
    let source = Source::new(&soup, &cleaned);
    let mesh = TriMesh::from_slices(&[[0.0, 0.5, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], &[[0, 1, 2]]).unwrap();
    let labels = [1, 1, 2, 2, 1, 1];
    let at = correspond(&source, &source.label_borders(&[0; 6]), &mesh);
    assert_eq!(labels[at.parts[0][0] as usize], 2);
    assert_eq!(face_values(&at, &labels), [1]);
}

#[test]
fn labels_are_taken_over_and_never_mixed() {
    let soup = fixtures::cube(4).to_soup();
    let cleaned = cleaned(&soup);
    let source = Source::new(&soup, &cleaned);
    let side = |n: DVec3| (0..6).find(|i| n[i / 2] * if i % 2 == 0 { 1.0 } else { -1.0 } > 0.5).unwrap() as u32;
    let normal = |t: &[u32; 3]| mesh_core::normal(t.map(|v| soup.positions[v as usize]));
    let labels: Vec<u32> = soup.triangles.iter().map(|t| side(normal(t))).collect();
    assert_eq!(source.ends_of(&source.label_borders(&labels)).len(), 12 * 4);
    assert_eq!(source.ends_of(&source.group_borders(&labels)).len(), 12 * 4 + 40, "a face without a group has no soft edge");
    let mesh = fixtures::cube(7);
    let at = correspond(&source, &source.label_borders(&labels), &mesh);
    let carried = face_values(&at, &labels);
    assert!(mesh.faces().ids().zip(&carried).all(|(f, &label)| label == side(mesh.normal(f))));
    // A label of vertices is one of those that are there, and a value is the mean: here that of the height.
    let numbers: Vec<f64> = (0..soup.positions.len()).map(|v| if v % 2 == 0 { 3.0 } else { 8.0 }).collect();
    assert!(vertex_labels(&mesh, &at, &soup.triangles, &numbers).iter().all(|x| [3.0, 8.0].contains(x)));
    let heights: Vec<[f64; 1]> = soup.positions.iter().map(|p| [p.z]).collect();
    let carried = vertex_values(&mesh, &at, &soup.triangles, &heights);
    assert!(mesh.positions().iter().zip(&carried).all(|(p, [height])| (p.z - height).abs() < 1e-9));
}
