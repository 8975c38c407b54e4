//! Small meshes.

use mesh_core::TriMesh;

/// A small mesh, one of six by `which`, of one `unit` from corner to corner of its box. Panics where that unit leaves no finite coordinates.
pub fn shape(which: usize, unit: f64) -> TriMesh {
    let mesh = match which {
        0 => fixtures::plane(),
        1 => fixtures::cube(2),
        2 => fixtures::cylinder(0.5, 1.0, 8),
        3 => fixtures::torus(1.0, 0.4, 8, 6),
        4 => fixtures::cone(1.0, 1.0, 8),
        _ => fixtures::shell(8),
    };
    let scaled = mesh.positions().iter().map(|&p| unit * (p / mesh.diagonal())).collect();
    mesh.with_positions(scaled).expect("a unit of a finite mesh")
}
