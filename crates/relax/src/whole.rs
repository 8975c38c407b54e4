//! A domain that parts are taken out of.

use crate::corner_normal::{CornerNormal, reference_normal};
use crate::energy::Measures;
use crate::freedom::{Freedom, OnArc};
use crate::measured::Measured;
use crate::movable_domain::MovableDomain;
use crate::part::{Part, PartFace};
use crate::placed_vertex::PlacedVertex;
use crate::placement::Placement;
use crate::shape::{cost, costs, sheet_means};
use crate::{RelaxError, ShapeOptions};
use glam::DVec3;
use mesh_core::{HalfedgeId, Id as _, IdVec, VertexId};
use region_map::{Domain, SheetId, Surface};

/// A domain with its vertices in their places, of which parts are relaxed. It never changes itself.
pub struct Whole<'a> {
    movable: MovableDomain<'a>,
    placement: Placement,
    sheet_of_face: IdVec<mesh_core::FaceId, SheetId>,
    mean_areas: Vec<f64>,
}

impl<'a> Whole<'a> {
    /// Checks a domain and places its vertices at the points of its region map.
    ///
    /// Fails when the region map does not fit the domain or the surface.
    pub fn new(surface: &'a Surface, domain: &Domain) -> Result<Self, RelaxError> {
        let movable = MovableDomain::new(surface, domain)?;
        let placement = Placement::of_region(&movable, &domain.region);
        let sheet_of_face = domain.region.sheet_of_face.clone();
        let mean_areas = sheet_means(&movable, &sheet_of_face, &placement);
        Ok(Self { movable, placement, sheet_of_face, mean_areas })
    }

    /// The surface that it lies on.
    pub fn surface(&self) -> &'a Surface {
        self.movable.surface
    }

    /// The place of every vertex.
    pub fn placed(&self) -> &IdVec<VertexId, PlacedVertex> {
        &self.placement.0
    }

    /// What every vertex is free to do.
    pub fn freedoms(&self) -> &IdVec<VertexId, Freedom> {
        &self.movable.freedoms
    }

    /// Which normal every face takes at each of its corners.
    pub fn normals(&self) -> &IdVec<HalfedgeId, CornerNormal> {
        &self.movable.normals
    }

    /// The mean area of the faces of a sheet; 0 for a sheet that is not there.
    pub fn mean_area(&self, sheet: SheetId) -> f64 {
        self.mean_areas.get(sheet.index()).copied().unwrap_or(0.0)
    }

    /// By how much the shape energy of every face exceeds the least one, with the mean areas of the sheets as those wanted. That
    /// of an equilateral triangle of this area is 0, that of an inverted one about 100.
    pub fn costs(&self, options: &ShapeOptions) -> Vec<f64> {
        let targets = self.sheet_of_face.iter().map(|&s| self.mean_area(s)).collect();
        costs(&Measured::new(&self.movable, self.placement.clone()), &targets, options)
    }

    /// What one triangle costs, with its corners placed as given.
    pub fn cost(&self, face: &PartFace, placed: impl Fn(VertexId) -> PlacedVertex, options: &ShapeOptions) -> f64 {
        let corners = face.corners.map(placed);
        let normal = reference_normal([0, 1, 2].map(|c| (face.normals[c], corners[c].normals)));
        cost(&Measures::new(corners.map(|v| v.position), normal), face.target_area, options)
    }

    /// The place after a walk over the surface from another place, along `way` as far as no arc is in it. The part of `way` along
    /// the arc is taken then.
    pub fn walked(&self, from: &PlacedVertex, way: DVec3) -> PlacedVertex {
        self.movable.walked(from, way)
    }

    /// The place at an arc length (it wraps around on a loop) of the arc of a vertex. `None` for an arc of another surface.
    pub fn placed_on_arc(&self, on_arc: &OnArc, arc_length: f64) -> Option<PlacedVertex> {
        self.movable.surface.network().arcs.get(on_arc.arc)?;
        Some(self.movable.placed_on_arc(on_arc, arc_length))
    }

    /// The part of some triangles, with a freedom for each of their vertices. A vertex on an arc stays if one of its neighbours
    /// there is not in the part.
    ///
    /// `None` where the triangles are no manifold: they meet in a vertex, say. Or where an arc is of another surface.
    pub fn part(&self, faces: &[PartFace], freedom: impl Fn(VertexId) -> Freedom) -> Option<Part<'a>> {
        let part = Part::new(&self.movable, faces, freedom)?;
        let arcs = &self.movable.surface.network().arcs;
        let is_here = |f: &Freedom| !matches!(f, Freedom::Arc(on_arc) if arcs.get(on_arc.arc).is_none());
        part.domain.freedoms.iter().all(is_here).then_some(part)
    }
}
