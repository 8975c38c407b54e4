//! Projects a domain mesh from elsewhere, an octahedron split in four a few times, onto a dented ball:
//! `cargo run -p project --example foreign_domain -- [LEVELS] [OUT.obj]`

use glam::DVec3;
use mesh_core::{FaceId, IdVec, SurfacePoint, TriMesh};
use project::{ProjectOptions, project};
use region_map::{Attachment, Domain, RegionMap, SheetId, Surface};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let levels = arguments.first().map_or(Ok(4), |a| a.parse())?;

    // The surface: a closed mesh without arcs, hence with one sheet.
    let ball = fixtures::icosphere(24);
    let mesh = ball.with_positions(ball.positions().iter().map(|&p| dented(p)).collect())?;
    let surface = Surface::smooth(mesh)?;

    // The domain: all its vertices and faces belong to that sheet. Their points are found by the projection.
    let bounds = surface.mesh().bounds().ok_or("the surface is empty")?;
    let octahedron = octahedron(bounds.centre(), 0.5 * (bounds.max - bounds.min))?;
    let region = RegionMap {
        attachments: IdVec::filled(Attachment::Sheet(SheetId(0)), octahedron.n_vertices()),
        points: IdVec::filled(SurfacePoint::at_corner(FaceId(0), 0), octahedron.n_vertices()),
        sheet_of_face: IdVec::filled(SheetId(0), octahedron.n_faces()),
        spans: Default::default(),
    };
    let finest = subdiv::subdivide(&Domain::new(octahedron, region)?, levels)?.domain;

    let projected = project(&surface, &finest, None, &ProjectOptions::default())?;
    let (mesh, report) = (&projected.domain.mesh, projected.report);
    println!("{} vertices, {} faces on {} faces", mesh.n_vertices(), mesh.n_faces(), surface.mesh().n_faces());
    println!("{} by their rays, {} by the nearest point", report.by_ray, report.by_nearest);
    let quality: f64 = mesh.faces().ids().map(|f| mesh_core::aspect_ratio(mesh.triangle(f))).sum();
    println!("mean quality {:.3}", quality / mesh.n_faces() as f64);
    if let Some(path) = arguments.get(1) {
        mesh_io::write(std::path::Path::new(path), mesh)?;
    }
    Ok(())
}

fn dented(p: DVec3) -> DVec3 {
    let wave = (4.0 * p.x).sin() * (4.0 * p.y).sin() * (4.0 * p.z).sin();
    DVec3::new(1.4, 1.0, 0.8) * p * (1.0 + 0.15 * wave)
}

fn octahedron(centre: DVec3, radii: DVec3) -> Result<TriMesh, mesh_core::MeshError> {
    let axes = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y, DVec3::Z, -DVec3::Z];
    let faces = (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]);
    TriMesh::new(axes.map(|a| centre + radii * a).to_vec(), faces.collect())
}
