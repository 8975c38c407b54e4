//! The vertices that one more subdivision brings, placed from the ends of their edges.

use crate::ProjectError;
use crate::project::{ProjectReport, Projected, attached_point};
use crate::ray::{Rays, interpolated_normals};
use glam::DVec3;
use mesh_core::{Id as _, IdVec, SurfacePoint, VertexId, walk_end};
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
    let refined = Refined { surface, coarse, finer, rays: Rays::new(surface), normals: interpolated_normals(finer) };
    let placed: Vec<Placed> = (0..finer.mesh.n_vertices()).into_par_iter().map(|i| refined.place(VertexId::new(i))).collect();
    let of = |how: How| placed.iter().filter(|p| p.how == how).count();
    let report = ProjectReport { by_ray: of(How::Ray), by_nearest: of(How::Nearest), ..ProjectReport::default() };
    let points: IdVec<VertexId, SurfacePoint> = placed.into_iter().map(|p| p.point).collect();
    let domain = finer.placed(surface, RegionMap { points, ..finer.region.clone() })?;
    Ok(Projected { domain, report })
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum How {
    /// By its attachment, by a walk, or not at all.
    Known,
    Ray,
    Nearest,
}

struct Placed {
    point: SurfacePoint,
    how: How,
}

struct Refined<'a> {
    surface: &'a Surface,
    coarse: &'a Domain,
    finer: &'a Domain,
    rays: Rays<'a>,
    normals: IdVec<VertexId, DVec3>,
}

impl Refined<'_> {
    fn place(&self, v: VertexId) -> Placed {
        let Self { surface, coarse, finer, rays, normals } = self;
        let known = |point| Placed { point, how: How::Known };
        let Attachment::Sheet(sheet) = finer.region.attachments[v] else {
            return known(attached_point(surface, &finer.region, v).unwrap_or(finer.region.points[v]));
        };
        if let Some(&point) = coarse.region.points.get(v) {
            return known(point);
        }
        if let Some(point) = self.walked(v, sheet) {
            return known(point);
        }
        match rays.place(sheet, finer.mesh.position(v), normals[v]) {
            Some((point, is_hit)) => Placed { point, how: if is_hit { How::Ray } else { How::Nearest } },
            None => known(finer.region.points[v]),
        }
    }

    /// The nearer of the places that walks from both ends lead to. `None` where no end is inside the sheet.
    fn walked(&self, v: VertexId, sheet: SheetId) -> Option<SurfacePoint> {
        let Self { surface, coarse, finer, .. } = self;
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
}
