//! The finest level before and after bisections of base edges, told apart by nothing but positions.

use glam::DVec3;
use mesh_core::{Id as _, IdVec, TriMesh, VertexId};
use region_map::{Domain, Surface};
use subdiv::{Faces, bisected, subdivide};

fn subdivided(mesh: &TriMesh, levels: u32) -> TriMesh {
    let surface = Surface::with_creases(mesh.clone(), 40.0).unwrap();
    subdivide(&Domain::identity(&surface), levels).unwrap().domain.mesh
}

/// The mesh with a vertex in the middle of an edge.
fn cut(mesh: &TriMesh, [a, b]: [VertexId; 2]) -> TriMesh {
    let m = mesh.n_vertices() as u32;
    let positions = mesh.positions().iter().copied().chain([mesh.position(a).midpoint(mesh.position(b))]).collect();
    let halves = |f: &[VertexId; 3]| {
        let with = |old: VertexId| f.map(|v| if v == old { m } else { v.0 });
        if f.contains(&a) && f.contains(&b) { vec![with(b), with(a)] } else { vec![f.map(|v| v.0)] }
    };
    TriMesh::new(positions, mesh.faces().iter().flat_map(halves).collect()).unwrap()
}

#[test]
fn old_vertices_stay_and_new_ones_are_middles() {
    let meshes = [
        fixtures::plane(),
        fixtures::cube(1),
        fixtures::icosphere(2),
        fixtures::torus(1.0, 0.4, 12, 10),
        fixtures::cylinder(1.0, 1.0, 8),
        fixtures::brick(8),
    ];
    for (base, levels) in meshes.iter().flat_map(|mesh| (0..4).map(move |levels| (mesh, levels))) {
        let before = subdivided(base, levels);
        let (mut after_base, mut bisections) = (base.clone(), Vec::new());
        for i in 0..5usize {
            // The last ones cut what the first ones have made.
            let faces = after_base.faces();
            let face = faces[mesh_core::FaceId::new(if i < 2 { 3 * i % faces.len() } else { faces.len() - 1 - i % 2 })];
            let [a, b] = [face[i % 3], face[(i + 1) % 3]];
            bisections.push([a, b, VertexId::new(after_base.n_vertices())]);
            after_base = cut(&after_base, [a, b]);
        }
        let after = subdivided(&after_base, levels);
        let [old, new] =
            [(base, &before), (&after_base, &after)].map(|(base, domain)| Faces { base: base.faces(), finest: domain.faces() });
        let found = bisected(old, &bisections, new, levels).unwrap();

        let mut positions: IdVec<VertexId, DVec3> = before.positions().clone();
        for middle in &found.middles {
            let [a, b] = middle.ends.map(|v| positions[VertexId(v)]);
            positions.push(a.midpoint(b));
        }
        let mut numbers: Vec<u32> = found.numbers.iter().copied().collect();
        for (v, &number) in found.numbers.enumerate() {
            assert!(after.position(v).distance(positions[VertexId(number)]) < 1e-12, "vertex {v} at level {levels}");
        }
        numbers.sort_unstable();
        assert!(numbers.into_iter().eq(0..positions.len() as u32), "each vertex comes once");
        assert_eq!(bisected(old, &bisections[1..], new, levels), None, "one bisection is not told");
    }
}
