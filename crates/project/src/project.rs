//! The stage: dispatch by class (Fig. 6).

use crate::Origins;
use crate::ray::{SheetIndices, interpolated_normals};
use glam::DVec3;
use mesh_core::{HalfedgeId, Id, IdVec, SurfacePoint, Topology, TriMesh, VertexId};
use rayon::prelude::*;
use region_map::{Attachment, RegionMap, Surface};

/// How vertices are projected.
#[derive(Clone, Debug, PartialEq)]
pub struct ProjectOptions {
    /// How far from the place that the map gives a ray may hit, in mean edge lengths of the domain. Default 0.5; 0 turns the ray off.
    pub ray_reach: f64,
}

impl Default for ProjectOptions {
    fn default() -> Self {
        Self { ray_reach: 0.5 }
    }
}

/// What the projection did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ProjectReport {
    /// Vertices inside sheets that the map placed.
    pub mapped: usize,
    /// Those that the ray moved to a better place.
    pub improved_by_ray: usize,
    /// Without a map: vertices that the ray placed.
    pub by_ray: usize,
    /// Without a map: vertices that the ray missed and the nearest point of their sheet replaced.
    pub by_nearest: usize,
}

/// A domain on the surface.
#[derive(Clone, Debug)]
pub struct Projected {
    /// The domain mesh with every vertex at its surface point.
    pub mesh: TriMesh,
    /// The region map with these surface points.
    pub region: RegionMap,
    /// What was done.
    pub report: ProjectReport,
}

/// Why a domain could not be projected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProjectError {
    /// The domain is not an oriented manifold.
    #[error("the domain mesh is not an oriented manifold: {0}")]
    NotManifold(#[from] mesh_core::TopologyError),
    /// The domain and its map don't agree.
    #[error(transparent)]
    Region(#[from] region_map::RegionMapError),
    /// A position is not finite.
    #[error(transparent)]
    NotFinite(#[from] mesh_core::MeshError),
}

/// Puts every vertex of the domain on the surface, by its attachment: no vertex leaves its corner, arc or sheet.
pub fn project(
    surface: &Surface<'_>,
    domain: &TriMesh,
    region: &RegionMap,
    origins: Option<Origins<'_>>,
    options: &ProjectOptions,
) -> Result<Projected, ProjectError> {
    let topology = Topology::new(domain.faces(), domain.n_vertices())?;
    region.check(&topology, surface.network)?;
    let mut report = ProjectReport::default();
    let points: IdVec<VertexId, SurfacePoint> = match origins {
        Some(origins) => place_by_map(surface, domain, &topology, region, origins, options, &mut report)?,
        None => place_by_rays(surface, domain, &topology, region, &mut report),
    };
    let positions = points.iter().map(|p| p.position(surface.mesh)).collect();
    let region = RegionMap { points, ..region.clone() };
    Ok(Projected { mesh: domain.with_positions(positions)?, region, report })
}

/// Classes one and three: the corner, or the point at the arc length.
fn attached_point(surface: &Surface<'_>, region: &RegionMap, v: VertexId) -> Option<SurfacePoint> {
    match region.attachments[v] {
        Attachment::Corner(c) => {
            let h = surface.topology.fan(surface.network.corners[c]).next()?;
            Some(SurfacePoint::at_corner(h.face(), h.corner()))
        }
        Attachment::Arc { arc, t } => Some(surface.network.arcs[arc].point(surface.topology, t)),
        Attachment::Sheet(_) => None,
    }
}

/// All vertices, those of class two by the map, and from there by the ray where that is better.
fn place_by_map(
    surface: &Surface<'_>,
    domain: &TriMesh,
    topology: &Topology,
    region: &RegionMap,
    origins: Origins<'_>,
    options: &ProjectOptions,
    report: &mut ProjectReport,
) -> Result<IdVec<VertexId, SurfacePoint>, ProjectError> {
    origins.check(domain.n_vertices())?;
    let place = |v| attached_point(surface, region, v).unwrap_or_else(|| origins.place(v));
    let placed: Vec<_> = (0..domain.n_vertices()).into_par_iter().map(|i| place(VertexId::new(i))).collect();
    let mut points = IdVec::from_vec(placed);
    report.mapped = region.class_counts()[2];
    if options.ray_reach > 0.0 {
        report.improved_by_ray = improve_by_rays(surface, domain, topology, region, options, &mut points);
    }
    Ok(points)
}

/// All vertices, those of class two without a map: by the ray, or where it misses the nearest point of the sheet.
fn place_by_rays(
    surface: &Surface<'_>,
    domain: &TriMesh,
    topology: &Topology,
    region: &RegionMap,
    report: &mut ProjectReport,
) -> IdVec<VertexId, SurfacePoint> {
    let normals = interpolated_normals(domain, topology, region);
    let indices = SheetIndices::new(surface);
    let place = |v: VertexId| match region.attachments[v] {
        Attachment::Sheet(sheet) => indices.place(surface, sheet, domain.position(v), normals[v]),
        _ => Some((attached_point(surface, region, v)?, false)),
    };
    let placed: Vec<_> = (0..domain.n_vertices()).into_par_iter().map(|i| place(VertexId::new(i))).collect();
    report.by_ray = placed.iter().flatten().filter(|p| p.1).count();
    report.by_nearest = region.class_counts()[2] - report.by_ray;
    placed.iter().zip(&region.points).map(|(p, &before)| p.map_or(before, |p| p.0)).collect()
}

/// Moves vertices to where their rays hit, one after the other, where that makes the worst of their triangles better.
fn improve_by_rays(
    surface: &Surface<'_>,
    domain: &TriMesh,
    topology: &Topology,
    region: &RegionMap,
    options: &ProjectOptions,
    points: &mut IdVec<VertexId, SurfacePoint>,
) -> usize {
    let normals = interpolated_normals(domain, topology, region);
    let indices = SheetIndices::new(surface);
    let hit = |v: VertexId| match region.attachments[v] {
        Attachment::Sheet(s) => indices.displaced(surface, s, domain.position(v), normals[v]),
        _ => None,
    };
    let hits: Vec<Option<SurfacePoint>> = (0..domain.n_vertices()).into_par_iter().map(|i| hit(VertexId::new(i))).collect();
    let mut positions: IdVec<VertexId, DVec3> = points.iter().map(|p| p.position(surface.mesh)).collect();
    let reach = options.ray_reach * mean_edge(topology, &positions);
    let mut improved = 0;
    for (i, hit) in hits.into_iter().enumerate() {
        let v = VertexId::new(i);
        let Some(hit) = hit else { continue };
        let to = hit.position(surface.mesh);
        if to.distance(positions[v]) > reach {
            continue;
        }
        let before = worst(topology, &positions, v, positions[v], surface.normals.at(points[v]));
        if worst(topology, &positions, v, to, surface.normals.at(hit)) > before {
            (positions[v], points[v]) = (to, hit);
            improved += 1;
        }
    }
    improved
}

fn mean_edge(topology: &Topology, positions: &IdVec<VertexId, DVec3>) -> f64 {
    let lengths = topology.edge_ids().map(|e| topology.ends(e)).map(|[a, b]| positions[a].distance(positions[b]));
    lengths.sum::<f64>() / topology.n_edges().max(1) as f64
}

/// The least quality among the triangles round `v` with `v` at `at`, negative for one that faces against the normal.
fn worst(topology: &Topology, positions: &IdVec<VertexId, DVec3>, v: VertexId, at: DVec3, normal: DVec3) -> f64 {
    let signed = |h: HalfedgeId| {
        let t = [at, positions[topology.to(h)], positions[topology.opposite(h)]];
        mesh_core::aspect_ratio(t) * mesh_core::normal(t).dot(normal)
    };
    topology.fan(v).map(signed).fold(f64::INFINITY, f64::min)
}
