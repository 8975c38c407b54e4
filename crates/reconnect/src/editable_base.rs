//! A base mesh as its relaxed first subdivision: every base face has its corners and the middles of its edges, all on the
//! surface.

use crate::ReconnectError;
use crate::base_face::BaseFace;
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, IdVec, VertexId};
use region_map::Domain;
use relax::ShapeOptions;
use relax::parts::{Freedom, PlacedVertex, Whole};

/// The place of a base face among all that there ever were.
pub(crate) type FaceIndex = usize;

/// The base mesh while it is edited.
pub(crate) struct EditableBase<'a> {
    /// The first subdivision as it was at the start.
    pub(crate) whole: &'a Whole<'a>,
    /// Faces that are gone leave holes.
    pub(crate) faces: Vec<Option<BaseFace>>,
    /// The faces round every base vertex, in rising order.
    pub(crate) stars: IdVec<VertexId, Vec<FaceIndex>>,
    /// Where every vertex of the first subdivision is.
    pub(crate) placed: IdVec<VertexId, PlacedVertex>,
    /// What each of them is free to do.
    pub(crate) freedoms: IdVec<VertexId, Freedom>,
    /// The cost of every face where its vertices are now.
    pub(crate) costs: Vec<f64>,
}

impl<'a> EditableBase<'a> {
    /// Takes a domain that was subdivided once: part `i` of face `f` is face `4 f + i`, as [`BaseFace::parts`] has them.
    pub(crate) fn new(whole: &'a Whole<'a>, domain: &Domain, options: &ShapeOptions) -> Result<Self, ReconnectError> {
        let topology = &domain.topology;
        if topology.n_faces() == 0 || !topology.n_faces().is_multiple_of(4) {
            return Err(ReconnectError::NotSubdivided);
        }
        let mut faces = Vec::with_capacity(topology.n_faces() / 4);
        let mut stars = IdVec::filled(Vec::new(), topology.n_vertices());
        for f in (0..topology.n_faces() / 4).map(|f| 4 * f as u32) {
            let part = |i: u32| topology.face(FaceId(f + i));
            let normal = |i: u32, c: usize| whole.normals()[HalfedgeId::of(FaceId(f + i), c)];
            let face = BaseFace {
                corners: [part(0)[0], part(1)[0], part(2)[0]],
                middles: [part(0)[1], part(1)[1], part(2)[1]],
                normals: [[0, 1, 2].map(|i| normal(i, 0)), [0, 1, 2].map(|i| normal(i, 1))],
                sheet: domain.region.sheet_of_face[FaceId(f)],
            };
            if (0..4).any(|i| face.triangles()[i as usize].0 != part(i)) {
                return Err(ReconnectError::NotSubdivided);
            }
            face.corners.iter().for_each(|&v| stars[v].push(faces.len()));
            faces.push(Some(face));
        }
        let costs = whole.costs(options).chunks(4).map(|parts| parts.iter().sum()).collect();
        Ok(Self { whole, faces, stars, placed: whole.placed().clone(), freedoms: whole.freedoms().clone(), costs })
    }

    pub(crate) fn face(&self, f: FaceIndex) -> Option<&BaseFace> {
        self.faces.get(f)?.as_ref()
    }

    /// The face with an edge from `a` to `b`, turned to begin with it.
    pub(crate) fn face_at(&self, a: VertexId, b: VertexId) -> Option<(FaceIndex, BaseFace)> {
        self.stars[a].iter().find_map(|&f| {
            let face = self.face(f)?.from(a);
            (face.corners[1] == b).then_some((f, face))
        })
    }

    pub(crate) fn is_edge(&self, a: VertexId, b: VertexId) -> bool {
        self.stars[a].iter().any(|&f| self.face(f).is_some_and(|f| f.corners.contains(&b)))
    }

    /// All base vertices, in order.
    pub(crate) fn vertices(&self) -> impl Iterator<Item = VertexId> {
        self.stars.enumerate().filter(|(_, star)| !star.is_empty()).map(|(v, _)| v)
    }

    /// Is the middle of an edge on an arc?
    pub(crate) fn is_on_arc(&self, middle: VertexId) -> bool {
        !matches!(self.freedoms[middle], Freedom::Sheet)
    }

    /// Would a face with these edges at `v`, given by their middles, have two edges on one arc? Its corner there opens to 180
    /// degrees as the arc is subdivided.
    pub(crate) fn has_two_edges_on_arc(&self, v: VertexId, middles: [VertexId; 2]) -> bool {
        matches!(self.freedoms[v], Freedom::Arc(_)) && middles.into_iter().all(|m| self.is_on_arc(m))
    }

    /// A place near a point, by a walk from the nearest of those vertices that are inside the sheet. `None` where none is.
    pub(crate) fn start_near(&self, target: DVec3, from: &[VertexId]) -> Option<PlacedVertex> {
        let placed = from.iter().filter(|&&v| !self.is_on_arc(v)).map(|&v| &self.placed[v]);
        let nearest = placed.min_by(|a, b| a.position().distance(target).total_cmp(&b.position().distance(target)))?;
        Some(self.whole.walked(nearest, target - nearest.position()))
    }

    /// All edges between two faces, ends rising, in order.
    pub(crate) fn edges(&self) -> Vec<[VertexId; 2]> {
        self.edges_of(0..self.faces.len())
    }

    /// The edges of some faces, ends rising, in order.
    pub(crate) fn edges_of(&self, faces: impl IntoIterator<Item = FaceIndex>) -> Vec<[VertexId; 2]> {
        let sides =
            faces.into_iter().filter_map(|f| self.face(f)).flat_map(|f| (0..3).map(|c| [f.corners[c], f.corners[(c + 1) % 3]]));
        let mut edges: Vec<_> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The sum of the costs of some faces.
    pub(crate) fn cost(&self, faces: &[FaceIndex]) -> f64 {
        faces.iter().map(|&f| self.costs[f]).sum()
    }

    /// The faces within so many rings of some vertices, in rising order.
    pub(crate) fn around(&self, vertices: &[VertexId], rings: usize) -> Vec<FaceIndex> {
        let mut faces: Vec<FaceIndex> = vertices.iter().flat_map(|&v| self.stars[v].iter().copied()).collect();
        faces.sort_unstable();
        faces.dedup();
        if rings <= 1 {
            return faces;
        }
        let mut corners: Vec<VertexId> = faces.iter().filter_map(|&f| self.face(f)).flat_map(|f| f.corners).collect();
        corners.sort_unstable();
        corners.dedup();
        self.around(&corners, rings - 1)
    }
}
