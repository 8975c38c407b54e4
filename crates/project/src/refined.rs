//! The vertices that one more subdivision brings, placed from the ends of their edges.

use crate::ProjectError;
use crate::project::{ProjectReport, Projected, attached_point};
use crate::ray::{Rays, interpolated_normals};
use mesh_core::{Id as _, SurfacePoint, VertexId, walk_end};
use rayon::prelude::*;
use region_map::{Attachment, Domain, RegionMap, SheetId, Surface};

/// Puts the new vertices of a domain on the surface that was subdivided once more: a new vertex inside a sheet goes to the middle of its edge by a
/// walk from an end inside the same sheet, or as [`project`](crate::project) does without a map where both ends are on arcs. All others stay where they
/// were.
///
/// `coarse` is the domain on the surface, `finer` what `subdiv::subdivide` makes of it at one level: the vertices of `coarse` come first. A walk stays
/// on the part of the surface that the edge lies on, however near others are. Fails where one of both does not fit the surface ([`Domain::check`]).
pub fn project_refined(surface: &Surface, coarse: &Domain, finer: &Domain) -> Result<Projected, ProjectError> {
    coarse.check(surface.network())?;
    finer.check(surface.network())?;
    let n_vertices = finer.mesh.n_vertices();
    let known = |i| known_point(surface, coarse, finer, VertexId::new(i));
    let mut points: Vec<Option<SurfacePoint>> = (0..n_vertices).into_par_iter().map(known).collect();
    let report = place_others(surface, finer, &mut points);
    let points = points.into_iter().zip(&finer.region.points).map(|(p, &before)| p.unwrap_or(before)).collect();
    let domain = finer.placed(surface, RegionMap { points, ..finer.region.clone() })?;
    Ok(Projected { domain, report })
}

/// Where a vertex goes by its attachment, because it was there before, or by a walk. `None` where both ends of its edge are on arcs.
fn known_point(surface: &Surface, coarse: &Domain, finer: &Domain, v: VertexId) -> Option<SurfacePoint> {
    let Attachment::Sheet(sheet) = finer.region.attachments[v] else { return attached_point(surface, &finer.region, v) };
    coarse.region.points.get(v).copied().or_else(|| walked(surface, coarse, finer, v, sheet))
}

/// The nearer of the places that walks from both ends lead to. `None` where no end is inside the sheet.
fn walked(surface: &Surface, coarse: &Domain, finer: &Domain, v: VertexId, sheet: SheetId) -> Option<SurfacePoint> {
    let (mesh, middle) = (surface.mesh(), finer.mesh.position(v));
    let ends = finer.topology.one_ring(v).filter_map(|end| Some((end, *coarse.region.points.get(end)?)));
    let inside = ends.filter(|(end, point)| {
        coarse.region.attachments[*end] == Attachment::Sheet(sheet) && mesh.faces().get(point.face).is_some()
    });
    let walk = |(_, start): (VertexId, SurfacePoint)| {
        let way = middle - start.position(mesh);
        walk_end(mesh, surface.topology(), start, way, |e| !surface.network().is_barrier(e))
    };
    let distance = |p: &SurfacePoint| p.position(mesh).distance(middle);
    inside.map(walk).min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// Places what has no point yet by rays, or at the nearest point. Most levels have none such, and then need neither indices nor normals.
fn place_others(surface: &Surface, finer: &Domain, points: &mut [Option<SurfacePoint>]) -> ProjectReport {
    let mut report = ProjectReport::default();
    if points.iter().all(Option::is_some) {
        return report;
    }
    let (rays, normals) = (Rays::new(surface), interpolated_normals(finer));
    for (v, point) in finer.region.vertices().zip(points).filter(|(_, point)| point.is_none()) {
        let Attachment::Sheet(sheet) = finer.region.attachments[v] else { continue };
        let Some((found, is_hit)) = rays.place(sheet, finer.mesh.position(v), normals[v]) else { continue };
        report.by_ray += usize::from(is_hit);
        report.by_nearest += usize::from(!is_hit);
        *point = Some(found);
    }
    report
}
