//! A base mesh as its relaxed first subdivision: every base face has its corners and the middles of its edges, all on the surface.

use super::part::RelaxedPart;
use crate::corner_normal::CornerNormal;
use crate::freedom::Freedom;
use crate::movable_domain::MovableDomain;
use crate::placed_vertex::PlacedVertex;
use crate::placement::Placement;
use crate::shape::{costs, sheet_means};
use crate::{RelaxError, ShapeOptions};
use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, Id as _, IdVec, VertexId};
use region_map::{BaseEdit, RegionMap, SheetId};

/// A base face, subdivided once. Vertices are those of the first subdivision: the base vertices come first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BaseFace {
    pub(crate) corners: [VertexId; 3],
    /// The middle of the edge from each corner to the next.
    pub(crate) middles: [VertexId; 3],
    /// Which normal the face takes at its corners and at its middles.
    pub(crate) normals: [[CornerNormal; 3]; 2],
    pub(crate) sheet: SheetId,
}

impl BaseFace {
    /// The same face, its corners turned so that `v` comes first.
    pub(crate) fn from(&self, v: VertexId) -> Self {
        let c = self.corners.iter().position(|&w| w == v).unwrap_or(0);
        fn turned<T: Copy>(x: [T; 3], c: usize) -> [T; 3] {
            [0, 1, 2].map(|i| x[(c + i) % 3])
        }
        let normals = self.normals.map(|n| turned(n, c));
        Self { corners: turned(self.corners, c), middles: turned(self.middles, c), normals, sheet: self.sheet }
    }

    /// Its four parts: corners, and the normals that these take.
    pub(crate) fn parts(&self) -> [([VertexId; 3], [CornerNormal; 3]); 4] {
        let ([a, b, c], [ab, bc, ca]) = (self.corners, self.middles);
        let [[na, nb, nc], [nab, nbc, nca]] = self.normals;
        [
            ([a, ab, ca], [na, nab, nca]),
            ([b, bc, ab], [nb, nbc, nab]),
            ([c, ca, bc], [nc, nca, nbc]),
            ([bc, ca, ab], [nbc, nca, nab]),
        ]
    }

    /// All its vertices.
    pub(crate) fn vertices(&self) -> impl Iterator<Item = VertexId> {
        self.corners.into_iter().chain(self.middles)
    }
}

/// The place of a base face among all that there ever were.
pub(crate) type FaceIndex = usize;

/// The base mesh under change.
pub(crate) struct Coarse<'a> {
    pub(crate) domain: &'a MovableDomain<'a>,
    /// Faces that are gone leave holes.
    pub(crate) faces: Vec<Option<BaseFace>>,
    /// The faces round every base vertex, in rising order.
    pub(crate) stars: IdVec<VertexId, Vec<FaceIndex>>,
    pub(crate) placed: IdVec<VertexId, PlacedVertex>,
    pub(crate) freedoms: IdVec<VertexId, Freedom>,
    /// The cost of every face where its vertices are now.
    pub(crate) costs: Vec<f64>,
    /// The area that a part of a face of each sheet shall have.
    pub(crate) targets: Vec<f64>,
}

/// What an edit changes.
#[derive(Clone, Debug)]
pub(crate) struct Change {
    /// The edit, in the numbers of [`Coarse`].
    pub(crate) edit: BaseEdit,
    /// The base vertices of all faces that change.
    pub(crate) corners: Vec<VertexId>,
    /// Faces that go.
    pub(crate) old: Vec<FaceIndex>,
    /// Faces that come.
    pub(crate) new: Vec<BaseFace>,
    /// Vertices that are new or have new neighbours on their arc: where to begin, and what they are free to do.
    pub(crate) moved: Vec<(VertexId, PlacedVertex, Freedom)>,
}

impl Change {
    /// PlacedVertex and freedom of a vertex after the change.
    pub(crate) fn state(&self, coarse: &Coarse, v: VertexId) -> (PlacedVertex, Freedom) {
        let moved = self.moved.iter().find(|m| m.0 == v);
        moved.map_or_else(|| (coarse.placed[v], coarse.freedoms[v]), |&(_, placed, freedom)| (placed, freedom))
    }
}

impl<'a> Coarse<'a> {
    /// Takes a domain that was subdivided once: part `i` of face `f` is face `4 f + i`, as [`BaseFace::parts`] has them.
    pub(crate) fn new(
        domain: &'a MovableDomain<'a>,
        region: &RegionMap,
        placement: Placement,
        options: &ShapeOptions,
    ) -> Result<Self, RelaxError> {
        let topology = &domain.topology;
        let mut faces = Vec::with_capacity(topology.n_faces() / 4);
        let mut stars = IdVec::filled(Vec::new(), topology.n_vertices());
        for f in (0..topology.n_faces() / 4).map(|f| 4 * f as u32) {
            let part = |i: u32| topology.face(FaceId(f + i));
            let normal = |i: u32, c: usize| domain.normals[HalfedgeId::of(FaceId(f + i), c)];
            let face = BaseFace {
                corners: [part(0)[0], part(1)[0], part(2)[0]],
                middles: [part(0)[1], part(1)[1], part(2)[1]],
                normals: [[0, 1, 2].map(|i| normal(i, 0)), [0, 1, 2].map(|i| normal(i, 1))],
                sheet: region.sheet_of_face[FaceId(f)],
            };
            if (0..4).any(|i| face.parts()[i as usize].0 != part(i)) {
                return Err(RelaxError::NotSubdivided);
            }
            face.corners.iter().for_each(|&v| stars[v].push(faces.len()));
            faces.push(Some(face));
        }
        if faces.is_empty() || !topology.n_faces().is_multiple_of(4) {
            return Err(RelaxError::NotSubdivided);
        }
        let targets = sheet_means(domain, &region.sheet_of_face, &placement);
        let target_of_part = region.sheet_of_face.iter().map(|s| targets[s.index()]).collect();
        let costs = costs(domain, &placement, &target_of_part, options).chunks(4).map(|parts| parts.iter().sum()).collect();
        Ok(Self { domain, faces, stars, placed: placement.0, freedoms: domain.freedoms.clone(), costs, targets })
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

    /// Would a face with these edges at `v`, given by their middles, be an ear? Its corner opens to 180 degrees as the arc is subdivided.
    pub(crate) fn is_ear(&self, v: VertexId, middles: [VertexId; 2]) -> bool {
        matches!(self.freedoms[v], Freedom::Arc(_)) && middles.into_iter().all(|m| self.is_on_arc(m))
    }

    /// A place near a point, by a walk from the nearest of those vertices that are inside the sheet. `None` where none is.
    pub(crate) fn start_near(&self, target: DVec3, from: &[VertexId]) -> Option<PlacedVertex> {
        let placed = from.iter().filter(|&&v| !self.is_on_arc(v)).map(|&v| &self.placed[v]);
        let nearest = placed.min_by(|a, b| a.position.distance(target).total_cmp(&b.position.distance(target)))?;
        Some(self.domain.walked(nearest, target - nearest.position))
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

    /// The faces of a region after a change: those that stay, then the new ones.
    pub(crate) fn after<'c>(&'c self, region: &'c [FaceIndex], change: &'c Change) -> impl Iterator<Item = &'c BaseFace> {
        region.iter().filter(|f| !change.old.contains(f)).filter_map(|&f| self.face(f)).chain(&change.new)
    }

    /// Carries a change out, with the costs and the places that were found for its region.
    pub(crate) fn apply(&mut self, region: &[FaceIndex], change: &Change, relaxed: &RelaxedPart) {
        let kept = region.iter().filter(|f| !change.old.contains(f)).copied();
        let new = self.faces.len()..self.faces.len() + change.new.len();
        self.costs.resize(new.end, 0.0);
        for (f, &cost) in kept.chain(new).zip(&relaxed.costs) {
            self.costs[f] = cost;
        }
        for &f in &change.old {
            if let Some(face) = self.faces[f].take() {
                face.corners.iter().for_each(|&v| self.stars[v].retain(|&g| g != f));
            }
        }
        for &(v, placed, freedom) in &change.moved {
            while self.placed.len() <= v.index() {
                self.placed.push(placed);
                self.freedoms.push(freedom);
                self.stars.push(Vec::new());
            }
            (self.placed[v], self.freedoms[v]) = (placed, freedom);
        }
        for face in &change.new {
            face.corners.iter().for_each(|&v| self.stars[v].push(self.faces.len()));
            self.faces.push(Some(*face));
        }
        for &(v, placed) in &relaxed.placed {
            self.placed[v] = placed;
        }
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
