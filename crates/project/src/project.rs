//! The stage: dispatch by class (Fig. 6).

use crate::ray::{Rays, interpolated_normals};
use crate::{Origins, ProjectError};
use glam::DVec3;
use mesh_core::{HalfedgeId, Id, IdVec, SurfacePoint, Topology, VertexId};
use rayon::prelude::*;
use region_map::{Attachment, Domain, RegionMap, Surface};

/// How vertices are projected.
#[derive(Clone, Debug, PartialEq)]
pub struct ProjectOptions {
    /// How far from the place that the map gives a ray may hit, in mean edge lengths of the domain. Default 0.5. What is not
    /// above 0 turns the ray off.
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
    /// The domain with every vertex at its surface point.
    pub domain: Domain,
    /// What was done.
    pub report: ProjectReport,
}

/// Puts every vertex of the domain on the surface, by its attachment: no vertex leaves its corner, arc or sheet.
///
/// With `origins` vertices inside sheets go where the map of the base mesh has them. Fails where the domain does not fit the
/// surface ([`Domain::check`]), or the origins don't fit the domain.
pub fn project(
    surface: &Surface,
    domain: &Domain,
    origins: Option<Origins<'_>>,
    options: &ProjectOptions,
) -> Result<Projected, ProjectError> {
    domain.check(surface.network())?;
    let mut report = ProjectReport::default();
    let points: IdVec<VertexId, SurfacePoint> = match origins {
        Some(origins) => place_by_map(surface, domain, origins, options, &mut report)?,
        None => place_by_rays(surface, domain, &mut report),
    };
    let domain = domain.placed(surface, RegionMap { points, ..domain.region.clone() })?;
    Ok(Projected { domain, report })
}

/// Classes one and three: the corner, or the point at the arc length.
pub(crate) fn attached_point(surface: &Surface, region: &RegionMap, v: VertexId) -> Option<SurfacePoint> {
    match region.attachments[v] {
        Attachment::Corner(c) => {
            let h = surface.topology().fan(surface.network().corners[c]).next()?;
            Some(SurfacePoint::at_corner(h.face(), h.corner()))
        }
        Attachment::Arc { arc, t } => Some(surface.network().arcs[arc].point(surface.topology(), t)),
        Attachment::Sheet(_) => None,
    }
}

/// All vertices, those of class two by the map, and from there by the ray where that is better.
fn place_by_map(
    surface: &Surface,
    domain: &Domain,
    origins: Origins<'_>,
    options: &ProjectOptions,
    report: &mut ProjectReport,
) -> Result<IdVec<VertexId, SurfacePoint>, ProjectError> {
    let n_vertices = domain.mesh.n_vertices();
    origins.check(surface.mesh(), n_vertices)?;
    let place = |v| attached_point(surface, &domain.region, v).unwrap_or_else(|| origins.place(v));
    let placed: Vec<_> = (0..n_vertices).into_par_iter().map(|i| place(VertexId::new(i))).collect();
    let mut points = IdVec::from_vec(placed);
    report.mapped = domain.region.class_counts().in_sheets;
    if options.ray_reach > 0.0 {
        report.improved_by_ray = improve_by_rays(surface, domain, options, &mut points);
    }
    Ok(points)
}

/// All vertices, those of class two without a map: by the ray, or where it misses the nearest point of the sheet.
fn place_by_rays(surface: &Surface, domain: &Domain, report: &mut ProjectReport) -> IdVec<VertexId, SurfacePoint> {
    let Domain { mesh, region, .. } = domain;
    let (rays, normals) = (Rays::new(surface), interpolated_normals(domain));
    let place = |v: VertexId| match region.attachments[v] {
        Attachment::Sheet(sheet) => rays.place(sheet, mesh.position(v), normals[v]),
        _ => Some((attached_point(surface, region, v)?, false)),
    };
    let placed: Vec<_> = (0..mesh.n_vertices()).into_par_iter().map(|i| place(VertexId::new(i))).collect();
    report.by_ray = placed.iter().flatten().filter(|p| p.1).count();
    report.by_nearest = region.class_counts().in_sheets - report.by_ray;
    placed.iter().zip(&region.points).map(|(p, &before)| p.map_or(before, |p| p.0)).collect()
}

/// Moves vertices to where their rays hit, one after the other, where that makes the worst of their triangles better.
fn improve_by_rays(
    surface: &Surface,
    domain: &Domain,
    options: &ProjectOptions,
    points: &mut IdVec<VertexId, SurfacePoint>,
) -> usize {
    let Domain { mesh, topology, region } = domain;
    let (rays, normals) = (Rays::new(surface), interpolated_normals(domain));
    let hit = |v: VertexId| match region.attachments[v] {
        Attachment::Sheet(s) => rays.displaced(s, mesh.position(v), normals[v]),
        _ => None,
    };
    let hits: Vec<Option<SurfacePoint>> = (0..mesh.n_vertices()).into_par_iter().map(|i| hit(VertexId::new(i))).collect();
    let mut positions: IdVec<VertexId, DVec3> = points.iter().map(|p| p.position(surface.mesh())).collect();
    let reach = options.ray_reach * mean_edge(topology, &positions);
    let mut improved = 0;
    for (i, hit) in hits.into_iter().enumerate() {
        let v = VertexId::new(i);
        let Some(hit) = hit else { continue };
        let to = hit.position(surface.mesh());
        if to.distance(positions[v]) > reach {
            continue;
        }
        let before = worst(topology, &positions, v, positions[v], surface.normals().at(points[v]));
        if worst(topology, &positions, v, to, surface.normals().at(hit)) > before {
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
