//! Soups to clean, and what holds for every result.

use glam::DVec3;
use mesh_core::{CleanOptions, Cleaned, Soup, TriMesh, clean, exact};

pub(crate) fn soup(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Soup {
    Soup { positions: positions.iter().map(|&p| p.into()).collect(), triangles: triangles.to_vec() }
}

/// Cleans, and checks what holds for every result.
pub(crate) fn cleaned(soup: &Soup) -> Cleaned {
    let cleaned = clean(soup, &CleanOptions::default()).unwrap();
    check(soup, &cleaned);
    cleaned
}

pub(crate) fn check(soup: &Soup, cleaned: &Cleaned) {
    let Cleaned { mesh, source_face, source_vertex, report, .. } = cleaned;
    assert_eq!((source_face.len(), source_vertex.len()), (mesh.n_faces(), mesh.n_vertices()));
    let moved = source_vertex.enumerate().filter(|&(v, &s)| mesh.position(v) != soup.positions[s as usize]);
    assert!(moved.count() <= report.split_edges, "only vertices in the middle of edges are new");
    let mut used = vec![false; mesh.n_vertices()];
    for &v in mesh.faces().iter().flatten() {
        used[v.0 as usize] = true;
    }
    assert!(used.iter().all(|&u| u), "all vertices are used");
    // A face without flip or split has the corners of its source.
    if report.zero_area_flipped + report.split_edges + report.t_vertices == 0 {
        for f in mesh.faces().ids() {
            let mut source = soup.triangles[source_face[f] as usize].map(|v| soup.positions[v as usize].to_array());
            let mut face = mesh.triangle(f).map(|p| p.to_array());
            source.sort_by(|a, b| a.partial_cmp(b).unwrap());
            face.sort_by(|a, b| a.partial_cmp(b).unwrap());
            assert_eq!(source, face);
        }
    }
    check_provenance(soup, cleaned);
    let flat = mesh.faces().ids().filter(|&f| {
        let [a, b, c] = mesh.triangle(f);
        exact::collinear(a, b, c)
    });
    assert_eq!(flat.count(), 0);
}

/// Both ways between soup and mesh agree.
fn check_provenance(soup: &Soup, cleaned: &Cleaned) {
    let Cleaned { mesh, source_face, source_vertex, face_of, vertex_of, report, .. } = cleaned;
    assert_eq!((face_of.len(), vertex_of.len()), (soup.triangles.len(), soup.positions.len()));
    for (f, &source) in source_face.enumerate() {
        let first = face_of[source as usize].expect("a triangle with a face");
        assert!(first <= f && source_face[first] == source);
    }
    assert_eq!(face_of.iter().flatten().count(), face_of.iter().flatten().collect::<std::collections::BTreeSet<_>>().len());
    let tolerance = CleanOptions::default().weld_tolerance * soup_diagonal(soup);
    for (i, vertex) in vertex_of.iter().enumerate() {
        let Some(v) = *vertex else { continue };
        let merged = soup.positions[source_vertex[v] as usize];
        assert!(mesh.position(v) == merged && merged.distance(soup.positions[i]) <= tolerance, "{i}");
    }
    for &s in source_vertex.as_slice() {
        assert!(vertex_of[s as usize].is_some(), "{s}");
    }
    // Where faces keep their corners, so do they by number.
    if report.zero_area_flipped + report.split_edges + report.t_vertices == 0 {
        for (f, &source) in source_face.enumerate() {
            let mut corners = mesh.face(f).map(|v| source_vertex[v]);
            let mut named =
                soup.triangles[source as usize].map(|v| source_vertex[vertex_of[v as usize].expect("a vertex of a face")]);
            corners.sort_unstable();
            named.sort_unstable();
            assert_eq!(corners, named);
        }
    }
}

/// Of what can be computed with.
fn soup_diagonal(soup: &Soup) -> f64 {
    let used = soup.positions.iter().filter(|p| p.is_finite() && p.abs().max_element() <= 1e75).copied();
    mesh_core::Bounds::of(used).map_or(0.0, |bounds| bounds.diagonal())
}

pub(crate) fn volume(mesh: &TriMesh) -> f64 {
    let six = mesh.faces().ids().map(|f| {
        let [a, b, c] = mesh.triangle(f);
        a.dot(b.cross(c))
    });
    six.sum::<f64>() / 6.0
}

pub(crate) fn n_components(cleaned: &Cleaned) -> usize {
    cleaned.topology.components().1
}

pub(crate) fn n_loops(cleaned: &Cleaned) -> usize {
    cleaned.topology.border_loops().len()
}

/// (0, 0, 0), x, y, z, facing outwards.
pub(crate) const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
pub(crate) const CORNERS: [[f64; 3]; 5] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];

/// A wavy square of 2 n^2 triangles.
pub(crate) fn sheet(n: u32) -> Soup {
    let share = |i: u32| f64::from(i) / f64::from(n);
    let positions = (0..=n).flat_map(|i| (0..=n).map(move |j| (share(i), share(j))));
    let positions = positions.map(|(x, y)| DVec3::new(x, y, 0.1 * (5.0 * x).sin() * y)).collect();
    let id = |i: u32, j: u32| i * (n + 1) + j;
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = squares
        .flat_map(|(i, j)| [[id(i, j), id(i + 1, j), id(i + 1, j + 1)], [id(i, j), id(i + 1, j + 1), id(i, j + 1)]])
        .collect();
    Soup { positions, triangles }
}

/// A ring of `n` squares that joins up after `twists` half turns.
pub(crate) fn ring(n: u32, twists: u32) -> Soup {
    let at = |i: u32, side: f64| {
        let turn = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        let tilt = 0.5 * f64::from(twists) * turn;
        let out = DVec3::new(turn.cos(), turn.sin(), 0.0);
        3.0 * out + side * (tilt.cos() * out + tilt.sin() * DVec3::Z)
    };
    let positions = (0..n).flat_map(|i| [at(i, -1.0), at(i, 1.0)]).collect();
    let triangles = (0..n).flat_map(|i| {
        let [a, b] = [2 * i, 2 * i + 1];
        let [c, d] = match (i + 1 == n, twists % 2) {
            (false, _) => [2 * i + 2, 2 * i + 3],
            (true, 0) => [0, 1],
            (true, _) => [1, 0],
        };
        [[a, c, d], [a, d, b]]
    });
    Soup { positions, triangles: triangles.collect() }
}

/// All sides of the given cells of a grid of cubes, facing outwards; `walls` keeps those between two cells (twice).
pub(crate) fn voxels(cells: &[[i32; 3]], walls: bool) -> Soup {
    let mut soup = Soup::default();
    for &cell in cells {
        for axis in 0..3 {
            for side in 0..2 {
                let mut next = cell;
                next[axis] += 2 * side - 1;
                if !walls && cells.contains(&next) {
                    continue;
                }
                let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
                let first = soup.positions.len() as u32;
                for (i, j) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                    let mut p = cell;
                    (p[axis], p[u], p[v]) = (p[axis] + side, p[u] + i, p[v] + j);
                    soup.positions.push(DVec3::from_array(p.map(f64::from)));
                }
                // The diagonal of a wall is the same from both cells.
                let halves = if side == 1 { [[0, 1, 2], [0, 2, 3]] } else { [[0, 2, 1], [0, 3, 2]] };
                soup.triangles.extend(halves.map(|h| h.map(|k| first + k)));
            }
        }
    }
    soup
}
