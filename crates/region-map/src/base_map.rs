//! The bijection between base mesh and working mesh: charts, and a history of small re-triangulations of flat layouts.
//!
//! Every patch starts with a chart, an injective piecewise linear map into a convex polygon, in which its base faces are straight
//! triangles. A later change of the base mesh (flip, split, collapse) lays a few faces out flat, without fold or gap, and
//! triangulates the same polygon anew. So the whole is a composition of piecewise linear bijections, and the working mesh is
//! never changed.

use glam::{DMat3, DVec2, DVec3};
use mesh_core::exact::orient2d;
use mesh_core::{FaceId, Id as _, IdVec, SurfaceIndex, SurfacePoint, TriMesh, closest_on_triangle, define_id};
use std::ops::Range;
use std::sync::Arc;

define_id! {
    /// A chart: one for every patch.
    ChartId "chart"
    /// A base face of the map, present or replaced.
    MapFaceId "mf"
}

/// A piece of a working face in a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartFace {
    /// Vertices of the chart.
    pub vertices: [u32; 3],
    /// The working face that the piece is a part of.
    pub source: FaceId,
    /// Barycentric coordinates of the three vertices in the working face.
    pub barycentric: [DVec3; 3],
}

/// An injective piecewise linear map from a patch into the plane.
#[derive(Clone, Debug)]
pub struct Chart(Layout);

/// Where decimation starts there is a chart for every working face: those take no memory of their own.
#[derive(Clone, Debug)]
enum Layout {
    /// A whole working face on [`WHOLE_FACE`].
    Whole(ChartFace),
    /// Pieces of working faces.
    Pieces(Box<Pieces>),
}

/// Where the corners of a whole working face are in its chart. The shape does not matter: the map is affine there.
const WHOLE_FACE: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

#[derive(Clone, Debug)]
struct Pieces {
    uv: Vec<DVec2>,
    faces: Vec<ChartFace>,
    /// `(source, face)` in rising order.
    by_source: Vec<(FaceId, u32)>,
    index: SurfaceIndex,
}

/// Why something is not a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum MapError {
    /// A piece is folded or has no area in the plane.
    #[error("piece {0} of a chart is folded or has no area")]
    Folded(usize),
    /// A chart has no pieces, a vertex that is not there, or a coordinate that is not finite.
    #[error("a chart has no pieces, a vertex that is not there, or a coordinate that is not finite")]
    Invalid,
    /// A base face is in a chart that is not there.
    #[error("a base face is in chart {0}, which is not there")]
    NoSuchChart(ChartId),
    /// Old and new triangles of an edit don't cover the same area, or one is folded.
    #[error("an edit of the base mesh does not cover the same flat area before and after")]
    Uncovered,
}

impl Chart {
    /// Takes a chart whose pieces must all be counter-clockwise in the plane (decided exactly).
    pub fn new(uv: Vec<DVec2>, faces: Vec<ChartFace>) -> Result<Self, MapError> {
        let flat = TriMesh::new(uv.iter().map(|p| p.extend(0.0)).collect(), faces.iter().map(|f| f.vertices).collect());
        let flat = flat.ok().filter(|m| m.n_faces() > 0).ok_or(MapError::Invalid)?;
        let folded = |f: &ChartFace| {
            let [a, b, c] = f.vertices.map(|v| uv[v as usize]);
            orient2d(a, b, c) <= 0.0
        };
        if let Some(i) = faces.iter().position(folded) {
            return Err(MapError::Folded(i));
        }
        let mut by_source: Vec<_> = faces.iter().enumerate().map(|(i, f)| (f.source, i as u32)).collect();
        by_source.sort_unstable();
        Ok(Self(Layout::Pieces(Box::new(Pieces { index: SurfaceIndex::new(&flat), uv, faces, by_source }))))
    }

    /// The chart of a whole working face, its corners at (0, 0), (1, 0) and (0, 1).
    pub fn of_face(source: FaceId) -> Self {
        Self(Layout::Whole(ChartFace { vertices: [0, 1, 2], source, barycentric: [DVec3::X, DVec3::Y, DVec3::Z] }))
    }

    /// Positions of the vertices in the plane.
    pub fn uv(&self) -> &[DVec2] {
        match &self.0 {
            Layout::Whole(_) => &WHOLE_FACE,
            Layout::Pieces(pieces) => &pieces.uv,
        }
    }
    /// The pieces.
    pub fn faces(&self) -> &[ChartFace] {
        match &self.0 {
            Layout::Whole(face) => std::slice::from_ref(face),
            Layout::Pieces(pieces) => &pieces.faces,
        }
    }

    /// The piece that is closest to a point of the plane, and the barycentric coordinates of the closest point in it.
    fn closest(&self, p: DVec2) -> (&ChartFace, DVec3) {
        match &self.0 {
            Layout::Whole(face) if p.is_finite() => (face, closest_on_triangle(p.extend(0.0), WHOLE_FACE.map(|c| c.extend(0.0)))),
            Layout::Whole(face) => (face, DVec3::X),
            Layout::Pieces(pieces) => {
                // There always is a piece, and so a closest one to every finite point.
                let (face, w) = pieces.index.closest(p.extend(0.0)).map_or((FaceId(0), DVec3::X), |c| (c.face, c.barycentric));
                (&pieces.faces[face.index()], w)
            }
        }
    }

    /// The pieces of a working face.
    fn pieces_of(&self, source: FaceId) -> impl Iterator<Item = &ChartFace> {
        let (whole, pieces) = match &self.0 {
            Layout::Whole(face) => (Some(face).filter(|f| f.source == source), None),
            Layout::Pieces(pieces) => (None, Some(pieces)),
        };
        let pieces = pieces.into_iter().flat_map(move |pieces| {
            let start = pieces.by_source.partition_point(|&(f, _)| f < source);
            let own = pieces.by_source[start..].iter().take_while(move |(f, _)| *f == source);
            own.map(|&(_, i)| &pieces.faces[i as usize])
        });
        whole.into_iter().chain(pieces)
    }

    /// The point of the working mesh at `p`; for a point outside of the chart that of the nearest point inside.
    pub fn locate(&self, p: DVec2) -> SurfacePoint {
        let (piece, w) = self.closest(p);
        let [a, b, c] = piece.barycentric;
        SurfacePoint::new(piece.source, w.x * a + w.y * b + w.z * c)
    }

    /// Where a point of the working mesh lies in the plane, `None` for a face that is not in the chart.
    pub fn find(&self, point: SurfacePoint) -> Option<DVec2> {
        self.find_deepest(point).map(|found| found.0)
    }

    /// The same, with how deep inside the nearest piece of its face the point lies: negative for a point outside of the chart.
    fn find_deepest(&self, point: SurfacePoint) -> Option<(DVec2, f64)> {
        let (piece, w) = self
            .pieces_of(point.face)
            .map(|piece| {
                let [a, b, c] = piece.barycentric;
                (piece, DMat3::from_cols(a, b, c).inverse() * point.barycentric)
            })
            .max_by(|a, b| depth(a.1).total_cmp(&depth(b.1)))?;
        let depth = depth(w);
        let w = clamped(w);
        let [a, b, c] = piece.vertices.map(|v| self.uv()[v as usize]);
        Some((w.x * a + w.y * b + w.z * c, depth))
    }
}

/// A base face of the map in the layout that it was made in.
#[derive(Clone, Debug)]
struct MapFace {
    origin: Origin,
    layout: [DVec2; 3],
    /// The edit that took the face away.
    replaced_by: Option<u32>,
}

#[derive(Clone, Copy, Debug)]
enum Origin {
    Chart(ChartId),
    Edit(u32),
}

/// A flat polygon, triangulated in two ways: the faces that go, by their places in [`BaseMap::replaced`], and those that come.
#[derive(Clone, Debug)]
struct Edit {
    old: Range<usize>,
    new: Range<usize>,
}

/// The bijection between base faces and working mesh.
#[derive(Clone, Debug)]
pub struct BaseMap {
    /// No edit changes them, and they are many where every working face has its own: copies of the map share them.
    charts: Arc<IdVec<ChartId, Chart>>,
    /// The charts with pieces of a working face, in rising order. A face that base edges cross is in several.
    by_source: Vec<(FaceId, ChartId)>,
    /// The first base faces, chart by chart, and where those of each chart begin.
    roots: Vec<MapFaceId>,
    roots_from: IdVec<ChartId, usize>,
    faces: IdVec<MapFaceId, MapFace>,
    edits: Vec<Edit>,
    /// The faces that edits took away, in the layout of the edit.
    replaced: Vec<(MapFaceId, [DVec2; 3])>,
}

impl BaseMap {
    /// A map from charts that cover the working faces, and the first base faces as triangles in them. Fails where a base face is in a
    /// chart that is not there.
    pub fn new(charts: IdVec<ChartId, Chart>, base: &[(ChartId, [DVec2; 3])]) -> Result<Self, MapError> {
        if let Some((chart, _)) = base.iter().find(|(chart, _)| charts.get(*chart).is_none()) {
            return Err(MapError::NoSuchChart(*chart));
        }
        let sources = charts.enumerate().flat_map(|(id, chart)| chart.faces().iter().map(move |f| (f.source, id)));
        let mut by_source: Vec<_> = sources.collect();
        by_source.sort_unstable();
        by_source.dedup();
        let face = |&(chart, layout): &(ChartId, [DVec2; 3])| MapFace { origin: Origin::Chart(chart), layout, replaced_by: None };
        let faces: IdVec<MapFaceId, MapFace> = base.iter().map(face).collect();
        let mut roots: Vec<MapFaceId> = faces.ids().collect();
        roots.sort_by_key(|f| base[f.index()].0);
        let roots_from = charts.ids().map(|id| roots.partition_point(|f| base[f.index()].0 < id)).collect();
        Ok(Self { charts: Arc::new(charts), by_source, roots, roots_from, faces, edits: Vec::new(), replaced: Vec::new() })
    }

    /// The charts.
    pub fn charts(&self) -> &IdVec<ChartId, Chart> {
        &self.charts
    }
    /// The first base faces in a chart, before any edit, as flat triangles; none in one that is not there.
    pub fn first_faces(&self, chart: ChartId) -> impl Iterator<Item = [DVec2; 3]> + '_ {
        self.roots_of(chart).iter().map(|&f| self.faces[f].layout)
    }
    fn roots_of(&self, chart: ChartId) -> &[MapFaceId] {
        let Some(&from) = self.roots_from.get(chart) else { return &[] };
        let to = self.roots_from.get(ChartId(chart.0 + 1)).copied().unwrap_or(self.roots.len());
        &self.roots[from..to]
    }
    /// Number of edits so far.
    pub fn n_edits(&self) -> usize {
        self.edits.len()
    }
    /// True for a face that is there and that no edit has taken away.
    pub fn is_present(&self, face: MapFaceId) -> bool {
        self.faces.get(face).is_some_and(|f| f.replaced_by.is_none())
    }
    /// True where the charts only have pieces of faces that a working mesh has.
    pub fn is_of(&self, working: &TriMesh) -> bool {
        self.by_source.last().is_none_or(|(f, _)| f.index() < working.n_faces())
    }

    /// Replaces faces, laid out flat, by new triangles of the same polygon. Fails, changing nothing, when one is folded, the
    /// areas differ, or a face is not there (any more).
    pub fn replace(&mut self, old: &[(MapFaceId, [DVec2; 3])], new: &[[DVec2; 3]]) -> Result<Vec<MapFaceId>, MapError> {
        let before = unfolded_area(old.iter().map(|o| &o.1)).ok_or(MapError::Uncovered)?;
        let after = unfolded_area(new).ok_or(MapError::Uncovered)?;
        // Layouts are of unit scale and have few triangles: rounding is far below this.
        if (before - after).abs() > 1e-9 * before || old.iter().any(|(f, _)| !self.is_present(*f)) {
            return Err(MapError::Uncovered);
        }
        let edit = self.edits.len() as u32;
        for (f, _) in old {
            self.faces[*f].replaced_by = Some(edit);
        }
        let origin = Origin::Edit(edit);
        let made: Vec<_> = new.iter().map(|&layout| self.faces.push(MapFace { origin, layout, replaced_by: None })).collect();
        let (first_old, first_new) = (self.replaced.len(), self.faces.len() - made.len());
        self.replaced.extend_from_slice(old);
        self.edits.push(Edit { old: first_old..self.replaced.len(), new: first_new..self.faces.len() });
        Ok(made)
    }

    /// Takes back all edits but the first `n_edits`: the map is again what it was after these.
    pub fn undo_to(&mut self, n_edits: usize) {
        let Some(Edit { old, new }) = self.edits.get(n_edits).cloned() else { return };
        self.edits.truncate(n_edits);
        let mut faces = std::mem::take(&mut self.faces).into_vec();
        faces.truncate(new.start);
        for (f, _) in self.replaced.drain(old.start..) {
            if let Some(face) = faces.get_mut(f.index()) {
                face.replaced_by = None;
            }
        }
        self.faces = IdVec::from_vec(faces);
    }

    /// The point of the working mesh at barycentric coordinates of a base face: the history run backwards.
    pub fn locate(&self, mut face: MapFaceId, mut barycentric: DVec3) -> SurfacePoint {
        loop {
            let MapFace { origin, layout, .. } = &self.faces[face];
            let p = at(layout, barycentric);
            match *origin {
                Origin::Chart(chart) => return self.charts[chart].locate(p),
                Origin::Edit(edit) => {
                    (face, barycentric) = containing(self.old_faces(edit).iter().map(|(f, t)| (*f, t)), p, face)
                }
            }
        }
    }

    /// The present base face and the barycentric coordinates in it of a point of the working mesh: the history run forwards.
    /// `None` for a face that no chart holds.
    pub fn find(&self, point: SurfacePoint) -> Option<(MapFaceId, DVec3)> {
        let start = self.by_source.partition_point(|&(f, _)| f < point.face);
        let charts = self.by_source[start..].iter().take_while(|(f, _)| *f == point.face);
        let found = charts.filter_map(|&(_, chart)| Some((chart, self.charts[chart].find_deepest(point)?)));
        let (chart, (p, _)) = found.max_by(|a, b| a.1.1.total_cmp(&b.1.1).then(b.0.cmp(&a.0)))?;
        let roots = self.roots_of(chart);
        let (mut face, mut barycentric) = containing(roots.iter().map(|&f| (f, &self.faces[f].layout)), p, *roots.first()?);
        while let Some(edit) = self.faces[face].replaced_by {
            let layout = &self.old_faces(edit).iter().find(|(f, _)| *f == face)?.1;
            let p = at(layout, barycentric);
            let new = self.edits[edit as usize].new.clone().map(MapFaceId::new);
            (face, barycentric) = containing(new.map(|f| (f, &self.faces[f].layout)), p, face);
        }
        Some((face, barycentric))
    }

    /// The faces that an edit took away, in its layout.
    fn old_faces(&self, edit: u32) -> &[(MapFaceId, [DVec2; 3])] {
        &self.replaced[self.edits[edit as usize].old.clone()]
    }
}

/// The point at barycentric coordinates of a flat triangle.
fn at(t: &[DVec2; 3], w: DVec3) -> DVec2 {
    w.x * t[0] + w.y * t[1] + w.z * t[2]
}

/// The area of flat triangles, `None` when one of them is folded or has none.
fn unfolded_area<'a>(triangles: impl IntoIterator<Item = &'a [DVec2; 3]>) -> Option<f64> {
    let area = |&[a, b, c]: &[DVec2; 3]| (orient2d(a, b, c) > 0.0).then(|| 0.5 * (b - a).perp_dot(c - a));
    triangles.into_iter().map(area).sum()
}

/// A point that lies this deep inside a triangle lies in no other one that does not overlap it, whatever rounding does.
const WELL_INSIDE: f64 = 1e-9;

/// The triangle that holds `p` (or comes nearest to), and the barycentric coordinates of `p` in it, clamped. `otherwise` without triangles.
fn containing<'a>(
    triangles: impl Iterator<Item = (MapFaceId, &'a [DVec2; 3])>,
    p: DVec2,
    otherwise: MapFaceId,
) -> (MapFaceId, DVec3) {
    let mut deepest: Option<(f64, MapFaceId, DVec3)> = None;
    for (f, t) in triangles {
        let w = flat_barycentric(t, p);
        let depth = depth(w);
        if deepest.is_none_or(|(most, g, _)| depth > most || (depth == most && f < g)) {
            deepest = Some((depth, f, w));
        }
        if depth > WELL_INSIDE {
            break;
        }
    }
    let (_, face, w) = deepest.unwrap_or((0.0, otherwise, DVec3::ONE));
    (face, clamped(w))
}

/// How deep inside its triangle a point lies: its least barycentric coordinate, negative outside. Triangles so small that their
/// coordinates are not finite come last.
fn depth(barycentric: DVec3) -> f64 {
    if barycentric.is_finite() { barycentric.min_element() } else { f64::NEG_INFINITY }
}

/// Barycentric coordinates brought into the triangle; its middle where they are not finite.
fn clamped(barycentric: DVec3) -> DVec3 {
    let w = if barycentric.is_finite() { barycentric.max(DVec3::ZERO) } else { DVec3::ONE };
    w / w.element_sum()
}

/// Barycentric coordinates of `p` in a flat triangle with area; negative ones outside of it.
pub fn flat_barycentric(&[a, b, c]: &[DVec2; 3], p: DVec2) -> DVec3 {
    let w = DVec3::new((c - b).perp_dot(p - b), (a - c).perp_dot(p - c), (b - a).perp_dot(p - a));
    w / w.element_sum()
}
