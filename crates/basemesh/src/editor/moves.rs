//! Moves of a vertex: inside its sheet, and along its arc.

use super::layout::{are_unfolded, deepest, full_star, half_star};
use super::mesh::Editor;
use super::replace::Edit;
use super::star::{Face, Ring, side_between, signed_quality};
use glam::{DVec2, DVec3};
use mesh_core::{SurfacePoint, VertexId, inverse_mean_ratio};
use region_map::{ArcId, ArcSpan, Attachment};

/// Moves shorter than this share of the mean edge of the star are not worth an edit.
const LEAST_MOVE: f64 = 0.03;
/// A move may make triangles worse as long as they stay better than this (AR).
const GOOD_ENOUGH: f64 = 0.6;
/// Where a vertex may slide to between its neighbours on the arc.
const SLIDES: [f64; 11] = [0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75];
/// The cost of the triangles must fall by this share for a slide to be worth an edit.
const LEAST_SLIDE_GAIN: f64 = 0.01;

/// The place of a vertex on its arc: its arc length, and both neighbours on the arc with the signed arc lengths to them.
struct PlaceOnArc {
    arc: ArcId,
    t: f64,
    ends: [(VertexId, f64); 2],
}

impl Editor<'_> {
    /// Moves an inner vertex of a sheet to the middle of its one-ring in a flat layout, unless that makes the worst of its triangles
    /// worse. False when it stays.
    pub(crate) fn relax_vertex(&mut self, v: VertexId) -> bool {
        let Some(ring) = self.ring(v).filter(|r| r.closed) else { return false };
        if !matches!(self.attachment(v), Attachment::Sheet(_)) {
            return false;
        }
        let n = ring.vertices.len();
        let positions: Vec<DVec3> = ring.vertices.iter().map(|&w| self.positions[w]).collect();
        let star = |p: &[DVec2], at: DVec2| -> Vec<[DVec2; 3]> { (0..n).map(|i| [at, p[i], p[(i + 1) % n]]).collect() };
        let [lengths, circle] = full_star(self.positions[v], &positions);
        let flat = if are_unfolded(&star(&lengths, DVec2::ZERO)) { lengths } else { circle };
        let centroid = flat.iter().sum::<DVec2>() / n as f64;
        let (old_star, new_star) = (star(&flat, DVec2::ZERO), star(&flat, centroid));
        if !are_unfolded(&new_star) || centroid.length() < LEAST_MOVE {
            return false;
        }
        let Some(point) = self.point_in_star(&ring, &old_star, centroid, v) else { return false };
        let to = point.position(self.surface.mesh());
        let worst = |at: DVec3| {
            let quality = |f: Face| signed_quality(f.vertices.map(|w| if w == v { at } else { self.positions[w] }), f.normal);
            self.faces_at(v).map(quality).fold(f64::INFINITY, f64::min)
        };
        if worst(to) < worst(self.positions[v]).min(GOOD_ENOUGH) {
            return false;
        }
        let corners = |i: usize| [v, ring.vertices[i], ring.vertices[(i + 1) % n]];
        let old: Vec<_> = (0..n).map(|i| (ring.faces[i], corners(i), old_star[i])).collect();
        let new: Vec<_> = (0..n).map(|i| (corners(i), new_star[i])).collect();
        let moved = self.replace(&[Edit { old, new }], Some((v, to)));
        if moved {
            (self.region.points[v], self.positions[v]) = (point, to);
        }
        moved
    }

    /// Slides a vertex along its arc to where the triangles round it have the best shape. False when it stays.
    pub(crate) fn slide_vertex(&mut self, v: VertexId) -> bool {
        let Some(ring) = self.ring(v) else { return false };
        let Some(place) = self.place_on_arc(v, &ring) else { return false };
        let Some(slide) = self.best_slide(v, &place) else { return false };
        let [(u, gap_u), (w, gap_w)] = place.ends;
        let sides = [(u, w, [gap_u, gap_w]), (w, u, [gap_w, gap_u])];
        let sides = sides.into_iter().filter_map(|(first, last, gaps)| Some((side_between(&ring, first, last)?, gaps)));
        let edits: Option<Vec<_>> = sides.map(|(side, gaps)| self.slide_edit(v, &side, gaps, slide)).collect();
        let Some(edits) = edits else { return false };
        let arc = &self.surface.network().arcs[place.arc];
        let t = arc.normalise(place.t + slide);
        let point = arc.point(self.surface.topology(), t);
        let to = point.position(self.surface.mesh());
        if !self.replace(&edits, Some((v, to))) {
            return false;
        }
        for (end, gap) in place.ends {
            self.region.insert_span(v, end, ArcSpan { arc: place.arc, from: t, to: t + gap - slide });
        }
        self.region.attachments[v] = Attachment::Arc { arc: place.arc, t };
        (self.region.points[v], self.positions[v]) = (point, to);
        true
    }

    /// Where a vertex sits on its arc, between two neighbours; `None` off the arcs, and at a corner.
    fn place_on_arc(&self, v: VertexId, ring: &Ring) -> Option<PlaceOnArc> {
        let Attachment::Arc { arc, .. } = self.attachment(v) else { return None };
        let spans: Vec<_> = ring.vertices.iter().filter_map(|&w| Some((w, self.span(v, w)?))).collect();
        let [(u, to_u), (w, to_w)] = spans[..] else { return None };
        Some(PlaceOnArc { arc, t: to_u.from, ends: [(u, to_u.to - to_u.from), (w, to_w.to - to_w.from)] })
    }

    /// How far along its arc a vertex should slide; `None` where that gains too little.
    fn best_slide(&self, v: VertexId, on_arc: &PlaceOnArc) -> Option<f64> {
        let arc = &self.surface.network().arcs[on_arc.arc];
        let cost = |place: DVec3| -> f64 {
            let shape =
                |f: Face| inverse_mean_ratio(f.vertices.map(|x| if x == v { place } else { self.positions[x] }), f.normal);
            self.faces_at(v).map(shape).sum()
        };
        let [(_, gap_u), (_, gap_w)] = on_arc.ends;
        let slides = SLIDES.iter().map(|share| gap_w + share * (gap_u - gap_w));
        let costs = slides.map(|slide| (cost(arc.position(self.surface.mesh(), arc.normalise(on_arc.t + slide))), slide));
        let (least, slide) = costs.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (least < (1.0 - LEAST_SLIDE_GAIN) * cost(self.positions[v])).then_some(slide)
    }

    /// The edit of one side of an arc when `v` slides along it. `gaps` are the signed arc lengths to the first and the last of the
    /// side, `slide` is in the same direction. `None` when no layout is unfolded before and after.
    fn slide_edit(&self, v: VertexId, side: &Ring, [ahead, behind]: [f64; 2], slide: f64) -> Option<Edit> {
        let positions: Vec<DVec3> = side.vertices.iter().map(|&w| self.positions[w]).collect();
        let to = DVec2::X * slide * ahead.signum() / (ahead.abs() + behind.abs());
        let spokes = |p: &[DVec2], at: DVec2| -> Vec<[DVec2; 3]> { p.windows(2).map(|w| [at, w[0], w[1]]).collect() };
        let valid = |p: &[DVec2]| are_unfolded(&spokes(p, DVec2::ZERO)) && are_unfolded(&spokes(p, to));
        let flat = half_star(self.positions[v], &positions, ahead.abs(), behind.abs()).into_iter().find(|p| valid(p))?;
        let corners = side.vertices.windows(2).map(|w| [v, w[0], w[1]]);
        let old = side.faces.iter().zip(corners.clone()).zip(spokes(&flat, DVec2::ZERO)).map(|((&f, c), p)| (f, c, p));
        Some(Edit { old: old.collect(), new: corners.zip(spokes(&flat, to)).collect() })
    }

    /// The surface point at a place in the layout of the star of `v`.
    fn point_in_star(&self, ring: &Ring, star: &[[DVec2; 3]], at: DVec2, v: VertexId) -> Option<SurfacePoint> {
        let (i, w) = deepest(star, at)?;
        let face = self.face(ring.faces[i])?;
        let c = face.corner(v)?;
        // `w` begins at v, the face's own corners elsewhere.
        Some(self.map.locate(face.map, DVec3::from_array([0, 1, 2].map(|k| w[(k + 3 - c) % 3]))))
    }
}
