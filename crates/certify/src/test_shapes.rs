//! Small meshes for the tests of this crate.

use glam::DVec3;
use mesh_core::{TriMesh, VertexId};
use std::collections::BTreeMap;

pub(crate) fn mesh(positions: &[[f64; 3]], faces: &[[u32; 3]]) -> TriMesh {
    TriMesh::new(positions.iter().map(|&p| p.into()).collect(), faces.to_vec()).unwrap()
}

/// The mesh with every position changed.
pub(crate) fn moved(m: &TriMesh, change: impl Fn(DVec3) -> DVec3) -> TriMesh {
    m.with_positions(m.positions().iter().map(|&p| change(p)).collect()).unwrap()
}

/// Both meshes as one.
pub(crate) fn joined(a: &TriMesh, b: &TriMesh) -> TriMesh {
    let positions = a.positions().iter().chain(b.positions()).copied().collect();
    let second = b.faces().iter().map(|f| f.map(|v| v.0 + a.n_vertices() as u32));
    TriMesh::new(positions, a.faces().iter().map(|f| f.map(|v| v.0)).chain(second).collect()).unwrap()
}

/// The mesh with one face turned round.
pub(crate) fn with_face_turned(m: &TriMesh, face: usize) -> TriMesh {
    let mut soup = m.to_soup();
    soup.triangles[face].swap(1, 2);
    TriMesh::new(soup.positions, soup.triangles).unwrap()
}

/// The unit square in the plane z = 0, two triangles.
pub(crate) fn square() -> TriMesh {
    mesh(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2], [0, 2, 3]])
}

/// The unit cube, two triangles a side.
pub(crate) fn cube() -> TriMesh {
    let positions: Vec<_> = (0..8u32).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces: Vec<_> = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    mesh(&positions, &faces)
}

/// Two cubes, one of them shifted by about a half along all axes.
pub(crate) fn crossing_cubes() -> TriMesh {
    joined(&cube(), &moved(&cube(), |p| p + DVec3::new(0.5, 0.6, 0.7)))
}

/// The icosahedron of radius 1.
pub(crate) fn icosahedron() -> TriMesh {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    #[rustfmt::skip]
    let positions = [
        [-1.0, g, 0.0], [1.0, g, 0.0], [-1.0, -g, 0.0], [1.0, -g, 0.0],
        [0.0, -1.0, g], [0.0, 1.0, g], [0.0, -1.0, -g], [0.0, 1.0, -g],
        [g, 0.0, -1.0], [g, 0.0, 1.0], [-g, 0.0, -1.0], [-g, 0.0, 1.0],
    ];
    #[rustfmt::skip]
    let faces = [
        [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
        [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
    ];
    moved(&mesh(&positions, &faces), DVec3::normalize)
}

/// One 1-to-4 split in the order of `connectivity.rs`, positions linear.
pub(crate) fn subdivide(m: &TriMesh) -> TriMesh {
    let mut positions = m.positions().as_slice().to_vec();
    let mut midpoints = BTreeMap::new();
    let mut faces = Vec::new();
    for &[a, b, c] in m.faces() {
        let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[p, q]: [VertexId; 2]| {
            *midpoints.entry([p.min(q), p.max(q)]).or_insert_with(|| {
                positions.push(0.5 * (m.position(p) + m.position(q)));
                positions.len() as u32 - 1
            })
        });
        faces.extend([[a.0, ab, ca], [b.0, bc, ab], [c.0, ca, bc], [bc, ca, ab]]);
    }
    TriMesh::new(positions, faces).unwrap()
}

/// A sphere of radius 1: the icosahedron subdivided, every vertex on the sphere.
pub(crate) fn sphere(levels: u32) -> TriMesh {
    (0..levels).fold(icosahedron(), |m, _| moved(&subdivide(&m), DVec3::normalize))
}
