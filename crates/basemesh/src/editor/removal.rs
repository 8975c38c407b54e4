//! Taking a vertex away: its star is filled with the best triangles over the same neighbours.

use super::layout::{are_unfolded, full_star, half_star};
use super::mesh::Editor;
use super::replace::Edit;
use super::star::{Face, Ring, side_between, signed_quality};
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, VertexId, cheapest_filling, exact, inverse_mean_ratio};
use region_map::{ArcSpan, Attachment};

/// A polygon of more corners is not filled in the cheapest way, which takes the cube of their number. Along a long crease, such as the
/// helix of a screw, stars of hundreds come up.
const MOST_CORNERS: usize = 40;

/// How the star of a vertex is filled.
#[derive(Clone, Copy)]
pub(crate) enum Filling<'t> {
    /// With a fan round one of the neighbours: the vertex is collapsed into it. On an arc it must be a neighbour there.
    Fan(VertexId),
    /// With the triangles of the best shape, for up to [`MOST_CORNERS`] corners.
    Cheapest,
    /// With those of these triangles that have all corners on the polygon.
    Given(&'t [[VertexId; 3]]),
}

/// The one or two polygons that are left to be filled when a vertex is taken away.
pub(crate) struct Hole {
    vertex: VertexId,
    /// One for a vertex in a sheet, on an arc one on each side of it.
    sides: Vec<Side>,
    /// For a vertex on an arc: its neighbours on the arc, and the span of the edge that will join them.
    joined: Option<([VertexId; 2], ArcSpan)>,
    /// Least quality (AR) of the triangles there are now, negative with one that faces against the surface.
    pub(crate) quality: f64,
    /// Longest edge of the rim.
    pub(crate) longest: f64,
}

/// A polygon to be filled.
struct Side {
    ring: Ring,
    positions: Vec<DVec3>,
    /// Where the vertex is.
    centre: DVec3,
    /// On an arc the arc lengths from the vertex to the first and the last of the ring.
    along: Option<[f64; 2]>,
    /// The mean normal of its triangles now.
    normal: DVec3,
}

/// A way to take a vertex away.
pub(crate) struct Removal<'h> {
    /// What it fills.
    pub(crate) hole: &'h Hole,
    /// One for each side.
    fillings: Vec<Filled>,
    /// Least quality (AR) of the new triangles, negative with one that faces against the surface.
    pub(crate) quality: f64,
    /// Longest of the new edges.
    pub(crate) longest: f64,
}

/// How one polygon is filled.
struct Filled {
    /// By places in the ring.
    triangles: Vec<[usize; 3]>,
    /// The layout of the ring that the triangles were chosen in, if they were chosen in one.
    flat: Option<Vec<DVec2>>,
}

impl Editor<'_> {
    /// What taking `v` away would leave. `None` for a corner, and where no filling makes a simplicial mesh.
    pub(crate) fn hole(&self, v: VertexId) -> Option<Hole> {
        let ring = self.ring(v)?;
        let (sides, joined) = match self.attachment(v) {
            Attachment::Sheet(_) if ring.closed && !self.is_pillow(&ring.vertices) => (vec![self.side(v, ring, None)], None),
            Attachment::Corner(_) | Attachment::Sheet(_) => return None,
            Attachment::Arc { .. } => {
                let (sides, ends, span) = self.sides_of_arc(v, &ring)?;
                (sides, Some((ends, span)))
            }
        };
        let quality = |face: Face| signed_quality(self.triangle(&face), face.normal);
        let quality = self.faces_at(v).map(quality).fold(1.0, f64::min);
        let longest = sides.iter().map(Side::longest).fold(0.0, f64::max);
        Some(Hole { vertex: v, sides, joined, quality, longest })
    }

    /// How to take a vertex away with this filling. `None` where that makes no simplicial mesh. Layouts wait until they are needed.
    pub(crate) fn removal<'h>(&self, hole: &'h Hole, filling: Filling<'_>) -> Option<Removal<'h>> {
        let end = |(ends, _): ([VertexId; 2], ArcSpan)| matches!(filling, Filling::Fan(apex) if !ends.contains(&apex));
        if hole.joined.is_some_and(end) {
            return None;
        }
        let fillings = hole.sides.iter().map(|side| self.filling(side, filling)).collect::<Option<Vec<_>>>()?;
        let (mut quality, mut longest) = (1.0f64, 0.0f64);
        for (side, filled) in hole.sides.iter().zip(&fillings) {
            for triangle in &filled.triangles {
                let t = triangle.map(|i| side.positions[i]);
                quality = quality.min(signed_quality(t, side.normal));
                longest = (0..3).fold(longest, |l, i| l.max(t[i].distance(t[(i + 1) % 3])));
            }
        }
        Some(Removal { hole, fillings, quality, longest })
    }

    /// Takes a vertex away. False, changing nothing, where every layout is folded before or after, and where a new triangle would face
    /// against the surface.
    pub(crate) fn take_away(&mut self, removal: &Removal<'_>) -> bool {
        let v = removal.hole.vertex;
        let edit = |(side, Filled { triangles, flat }): (&Side, &Filled)| {
            let sound = || side.laid_out(|p| is_sound(triangles, p).then_some(())).map(|found| found.0);
            Some(side.edit(v, triangles, &flat.clone().or_else(sound)?))
        };
        let Some(edits) = removal.hole.sides.iter().zip(&removal.fillings).map(edit).collect::<Option<Vec<_>>>() else {
            return false;
        };
        if !self.replace(&edits, None) {
            return false;
        }
        if let Some(([u, w], span)) = removal.hole.joined {
            self.region.spans.remove(&[v.min(u), v.max(u)]);
            self.region.spans.remove(&[v.min(w), v.max(w)]);
            self.region.insert_span(u, w, span);
        }
        self.n_vertices -= 1;
        true
    }

    /// Would filling a ring leave two triangles over the same three vertices?
    fn is_pillow(&self, ring: &[VertexId]) -> bool {
        match *ring {
            [a, b, c] => self.is_face([a, b, c]) || self.is_face([a, c, b]),
            _ => ring.len() < 3,
        }
    }

    /// Both sides of the arc that `v` is on, its neighbours there and the span between them.
    fn sides_of_arc(&self, v: VertexId, ring: &Ring) -> Option<(Vec<Side>, [VertexId; 2], ArcSpan)> {
        let along: Vec<VertexId> = ring.vertices.iter().copied().filter(|&w| self.span(v, w).is_some()).collect();
        let [u, w] = along[..] else { return None };
        let (to_u, to_w) = (self.span(v, u)?, self.span(v, w)?);
        if self.is_edge(u, w) {
            return None;
        }
        let lengths = [(to_u.to - to_u.from).abs(), (to_w.to - to_w.from).abs()];
        let sides = [(side_between(ring, u, w), lengths), (side_between(ring, w, u), [lengths[1], lengths[0]])];
        let sides: Vec<Side> = sides.into_iter().filter_map(|(ring, lengths)| Some(self.side(v, ring?, Some(lengths)))).collect();
        if let [a, b] = &sides[..]
            && inner(&a.ring).iter().any(|x| inner(&b.ring).contains(x))
        {
            return None;
        }
        let span = ArcSpan { arc: to_u.arc, from: to_u.to, to: to_u.from + to_w.to - to_w.from };
        Some((sides, [u, w], span))
    }

    fn side(&self, v: VertexId, ring: Ring, along: Option<[f64; 2]>) -> Side {
        let positions = ring.vertices.iter().map(|&w| self.position(w)).collect();
        Side { positions, centre: self.position(v), along, normal: self.star_normal(&ring.faces), ring }
    }

    /// Triangles that fill a polygon, by places in its ring.
    fn filling(&self, side: &Side, filling: Filling<'_>) -> Option<Filled> {
        let vertices = &side.ring.vertices;
        let n = vertices.len();
        // On an arc, the side from the last corner to the first is an edge that the removal makes.
        let is_side = |i: usize, j: usize| i.abs_diff(j) == 1 || i.abs_diff(j) == n - 1;
        let may_be = |i: usize, j: usize| is_side(i, j) || !self.is_edge(vertices[i], vertices[j]);
        let place = |v: VertexId| vertices.iter().position(|&w| w == v);
        let triangles: Vec<[usize; 3]> = match filling {
            Filling::Fan(apex) => {
                let start = place(apex)?;
                (1..n - 1).map(|i| [start, (start + i) % n, (start + i + 1) % n]).collect()
            }
            Filling::Given(triangles) => {
                let places = triangles.iter().filter_map(|&[a, b, c]| Some([place(a)?, place(b)?, place(c)?]));
                // A polygon's corners come in their order round it, whichever is first.
                let mut given: Vec<_> = places.collect();
                given.iter_mut().for_each(|t| t.sort_unstable());
                fill(n, &given).then_some(given)?
            }
            Filling::Cheapest if n > MOST_CORNERS => return None,
            Filling::Cheapest => {
                let cheapest = |p: &[DVec2]| {
                    let cost = |t: [usize; 3]| inverse_mean_ratio(t.map(|i| side.positions[i]), side.normal);
                    cheapest_filling(n, may_be, |t| is_sound(&[t], p).then(|| cost(t)))
                };
                let (flat, triangles) = side.laid_out(cheapest)?;
                return Some(Filled { triangles, flat: Some(flat) });
            }
        };
        let all_may_be = triangles.iter().all(|&[i, k, j]| may_be(i, k) && may_be(k, j) && may_be(i, j));
        (triangles.len() + 2 == n && all_may_be).then_some(Filled { triangles, flat: None })
    }

    /// The mean of the normals of some faces, by their areas.
    fn star_normal(&self, faces: &[FaceId]) -> DVec3 {
        let weighted = |face: Face| mesh_core::area(self.triangle(&face)) * face.normal;
        faces.iter().filter_map(|&f| self.face(f)).map(weighted).sum::<DVec3>().normalize_or_zero()
    }
}

impl Side {
    /// The longest side of the polygon, of those that are edges now.
    fn longest(&self) -> f64 {
        let steps = self.positions.windows(2).map(|w| w[0].distance(w[1])).fold(0.0, f64::max);
        match self.positions[..] {
            [first, .., last] if self.along.is_none() => steps.max(last.distance(first)),
            _ => steps,
        }
    }

    /// The first layout without a fold in which `find` finds something, and what it finds.
    fn laid_out<T>(&self, find: impl Fn(&[DVec2]) -> Option<T>) -> Option<(Vec<DVec2>, T)> {
        let is_flat_enough = |p: &[DVec2]| are_unfolded(&self.spokes(p));
        match self.along {
            None => {
                let layouts = full_star(self.centre, &self.positions);
                layouts.into_iter().filter(|p| is_flat_enough(p)).find_map(|p| find(&p).map(|t| (p, t)))
            }
            Some([ahead, behind]) => {
                let is_unfolded = |p: &[DVec2]| self.spokes(p).iter().all(|t| exact::orient2d(t[0], t[1], t[2]) > 0.0);
                let [lengths, circle] = half_star(self.centre, &self.positions, ahead, behind);
                let lengths = Some(lengths).filter(|p| is_flat_enough(p)).and_then(|p| find(&p).map(|t| (p, t)));
                lengths.or_else(|| Some(circle).filter(|p| is_unfolded(p)).and_then(|p| find(&p).map(|t| (p, t))))
            }
        }
    }

    /// The triangles between the vertex, at the origin, and its ring.
    fn spokes(&self, flat: &[DVec2]) -> Vec<[DVec2; 3]> {
        (0..self.ring.faces.len()).map(|i| [DVec2::ZERO, flat[i], flat[(i + 1) % flat.len()]]).collect()
    }

    fn edit(&self, v: VertexId, triangles: &[[usize; 3]], flat: &[DVec2]) -> Edit {
        let w = &self.ring.vertices;
        let corners = |i: usize| [v, w[i], w[(i + 1) % w.len()]];
        let faces = self.ring.faces.iter().zip(self.spokes(flat)).enumerate();
        let old = faces.map(|(i, (&f, layout))| (f, corners(i), layout)).collect();
        Edit { old, new: triangles.iter().map(|t| (t.map(|i| w[i]), t.map(|i| flat[i]))).collect() }
    }
}

/// Do these triangles, their corners rising, fill a polygon of `n` corners? Its sides must be theirs, and each of their other edges be
/// there once in both directions: then they cover any flat polygon once, if none is folded.
fn fill(n: usize, triangles: &[[usize; 3]]) -> bool {
    let sides = triangles.iter().flat_map(|t| (0..3).map(|c| [t[c], t[(c + 1) % 3]]));
    let back = (0..n).map(|i| [(i + 1) % n, i]);
    let mut edges: Vec<[usize; 2]> = sides.chain(back).collect();
    let mut reversed: Vec<[usize; 2]> = edges.iter().map(|&[i, j]| [j, i]).collect();
    edges.sort_unstable();
    reversed.sort_unstable();
    triangles.len() + 2 == n && edges == reversed && edges.windows(2).all(|w| w[0] != w[1])
}

/// Are these triangles of a flat polygon unfolded?
fn is_sound(triangles: &[[usize; 3]], flat: &[DVec2]) -> bool {
    triangles.iter().all(|t| are_unfolded(&[t.map(|i| flat[i])]))
}

/// All vertices of one side of an arc but the first and the last.
fn inner(side: &Ring) -> &[VertexId] {
    &side.vertices[1..side.vertices.len() - 1]
}
