//! Which vertex is which in the finest levels of a base mesh before and after edges of it are bisected: no vertex is lost, and
//! every new one is the middle of an edge that was there before.
//!
//! Let a base face (a, b, c) be cut from c to the middle m of ab. A vertex of the finest level with the weights (p, q, r) / n in
//! it has, where p is at least q, the weights (p - q, 2q, r) / n in (a, m, c), and so is one of the vertices there. The others
//! lie half way between two that differ by a step along ab.

use crate::grid::{Grid, Place, finest_corners};
use mesh_core::{FaceId, Id as _, IdVec, TriMesh, VertexId};
use rustc_hash::FxHashMap;

/// A vertex of the bisected domain that was not there before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Middle {
    /// The ends of the edge that it is the middle of.
    pub(crate) ends: [VertexId; 2],
    /// The third vertices of triangles beside that edge, as far as they are in the same base face.
    pub(crate) beside: [Option<VertexId>; 2],
}

/// The vertices of a domain on a base mesh with bisected edges, told by those of the domain before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Matching {
    /// The new vertices in the order in which they can be made. They have the numbers after those of the vertices of the domain
    /// before; so have those that they lie between.
    pub(crate) middles: Vec<Middle>,
    /// For every vertex of the new domain its number: that of the vertex before, or that of a new one.
    pub(crate) numbers: IdVec<VertexId, VertexId>,
}

/// A base mesh and its subdivision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Subdivided<'a> {
    pub(crate) base: &'a TriMesh,
    /// With its faces in the order of [`subdivide`](crate::subdivide).
    pub(crate) finest: &'a TriMesh,
}

impl Subdivided<'_> {
    /// How many times every base face was split; `None` where the numbers of faces don't say so.
    pub(crate) fn levels(&self) -> Option<u32> {
        let (base, finest) = (self.base.n_faces(), self.finest.n_faces());
        (0..16).find(|&levels| base.checked_shl(2 * levels).is_some_and(|n| n == finest && n >> (2 * levels) == base))
    }

    /// The faces of the finest level in a base face.
    fn faces_in(&self, f: FaceId, levels: u32) -> Option<&[[VertexId; 3]]> {
        let n = 1usize << (2 * levels);
        self.finest.faces().as_slice().get(f.index() * n..(f.index() + 1) * n)
    }
}

/// Matches the subdivision of a base mesh with that of the same base mesh after bisections: of the edges (a, b) by a new base
/// vertex m, given as [a, b, m] in their order. `None` where the new base mesh is not what these make of the old one.
pub(crate) fn matching(before: Subdivided<'_>, bisections: &[[VertexId; 3]], after: Subdivided<'_>) -> Option<Matching> {
    let levels = before.levels().filter(|&levels| after.levels() == Some(levels))?;
    let corners = finest_corners(levels);
    let mut faces = BaseFaces::default();
    let mut middles = Middles { first: before.finest.n_vertices(), made: Vec::new(), of: FxHashMap::default() };
    for (f, &base) in before.base.faces().enumerate() {
        faces.add(BaseFace { corners: base, grid: Grid::of_faces(1 << levels, &corners, before.faces_in(f, levels)?)? });
    }
    for &[a, b, m] in bisections {
        let sides = [[a, b], [b, a]].map(|side| faces.at(side));
        for (i, from) in sides.into_iter().zip([a, b]).filter_map(|(i, from)| Some((i?, from))) {
            let face = faces.all[i].from(from)?;
            let [first, second] = face.halves(m, &mut middles);
            faces.remove(&face);
            faces.add(first);
            faces.add(second);
        }
    }
    let mut numbers = IdVec::<VertexId, Option<VertexId>>::filled(None, after.finest.n_vertices());
    for (f, &[a, b, c]) in after.base.faces().enumerate() {
        let face = faces.all[faces.at([a, b])?].from(a)?;
        if face.corners != [a, b, c] {
            return None;
        }
        for (places, vertices) in corners.iter().zip(after.faces_in(f, levels)?) {
            places.iter().zip(vertices).for_each(|(&at, &v)| numbers[v] = Some(face.grid.at(at)));
        }
    }
    let numbers = numbers.iter().copied().collect::<Option<Vec<VertexId>>>()?;
    Some(Matching { middles: middles.made, numbers: IdVec::from_vec(numbers) })
}

/// The base faces under change: all that there ever were, and which of them is on the left of a directed edge now.
#[derive(Default)]
struct BaseFaces {
    all: Vec<BaseFace>,
    at_edge: FxHashMap<[VertexId; 2], usize>,
}

impl BaseFaces {
    fn at(&self, edge: [VertexId; 2]) -> Option<usize> {
        self.at_edge.get(&edge).copied()
    }

    fn add(&mut self, face: BaseFace) {
        self.at_edge.extend(face.sides().map(|side| (side, self.all.len())));
        self.all.push(face);
    }

    fn remove(&mut self, face: &BaseFace) {
        face.sides().iter().for_each(|side| _ = self.at_edge.remove(side));
    }
}

/// A base face with the vertices of the finest level in it.
struct BaseFace {
    corners: [VertexId; 3],
    grid: Grid,
}

impl BaseFace {
    fn sides(&self) -> [[VertexId; 2]; 3] {
        [0, 1, 2].map(|k| [self.corners[k], self.corners[(k + 1) % 3]])
    }

    /// The same with its corners turned so that `v` comes first. `None` where it is no corner.
    fn from(&self, v: VertexId) -> Option<Self> {
        let c = self.corners.iter().position(|&w| w == v)?;
        let corners = [0, 1, 2].map(|i| self.corners[(c + i) % 3]);
        let grid = Grid::filled(self.grid.n(), |p| self.grid.at([0, 1, 2].map(|i| p[(i + 3 - c) % 3])));
        Some(Self { corners, grid })
    }

    /// Both halves of the face (a, b, c) with m in the middle of ab: (a, m, c) and (m, b, c).
    fn halves(&self, m: VertexId, middles: &mut Middles) -> [Self; 2] {
        let ([a, b, c], n) = (self.corners, self.grid.n());
        // In halves of the face's own weights.
        let mut at_halves = |p: usize, q: usize, r: usize| {
            if p.is_multiple_of(2) { self.grid.at([p / 2, q / 2, r]) } else { middles.between(&self.grid, [p / 2, q / 2, r]) }
        };
        let first = Grid::filled(n, |[i, j, k]| at_halves(2 * i + j, j, k));
        let second = Grid::filled(n, |[i, j, k]| at_halves(i, i + 2 * j, k));
        [Self { corners: [a, m, c], grid: first }, Self { corners: [m, b, c], grid: second }]
    }
}

/// The new vertices so far.
struct Middles {
    /// The number of the first one.
    first: usize,
    made: Vec<Middle>,
    of: FxHashMap<[VertexId; 2], VertexId>,
}

impl Middles {
    /// The number of the vertex between the places (p + 1, q, r) and (p, q + 1, r).
    fn between(&mut self, grid: &Grid, [p, q, r]: Place) -> VertexId {
        let ends = [grid.at([p + 1, q, r]), grid.at([p, q + 1, r])];
        let beside = [Some(grid.at([p, q, r + 1])), (r > 0).then(|| grid.at([p + 1, q + 1, r.max(1) - 1]))];
        let next = VertexId::new(self.first + self.made.len());
        let key = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let made = &mut self.made;
        *self.of.entry(key).or_insert_with(|| {
            made.push(Middle { ends, beside });
            next
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subdivide;
    use glam::DVec3;
    use region_map::{Domain, Surface};

    fn subdivided(mesh: &TriMesh, levels: u32) -> TriMesh {
        let surface = Surface::with_creases(mesh.clone(), 40.0).unwrap();
        subdivide(&Domain::identity(&surface), levels).unwrap().domain.mesh
    }

    /// The mesh with a vertex in the middle of an edge.
    fn cut(mesh: &TriMesh, [a, b]: [VertexId; 2]) -> TriMesh {
        let m = mesh.n_vertices() as u32;
        let positions = mesh.positions().iter().copied().chain([mesh.position(a).midpoint(mesh.position(b))]).collect();
        let halves = |f: &[VertexId; 3]| {
            let with = |old: VertexId| f.map(|v| if v == old { m } else { v.0 });
            if f.contains(&a) && f.contains(&b) { vec![with(b), with(a)] } else { vec![f.map(|v| v.0)] }
        };
        TriMesh::new(positions, mesh.faces().iter().flat_map(halves).collect()).unwrap()
    }

    /// Told apart by nothing but positions.
    #[test]
    fn old_vertices_stay_and_new_ones_are_middles() {
        let meshes = [
            fixtures::plane(),
            fixtures::cube(1),
            fixtures::icosphere(2),
            fixtures::torus(1.0, 0.4, 12, 10),
            fixtures::cylinder(1.0, 1.0, 8),
            fixtures::brick(8),
        ];
        for (base, levels) in meshes.iter().flat_map(|mesh| (0..4).map(move |levels| (mesh, levels))) {
            let before = subdivided(base, levels);
            let (mut after_base, mut bisections) = (base.clone(), Vec::new());
            for i in 0..5usize {
                // The last ones cut what the first ones have made.
                let faces = after_base.faces();
                let face = faces[FaceId::new(if i < 2 { 3 * i % faces.len() } else { faces.len() - 1 - i % 2 })];
                let [a, b] = [face[i % 3], face[(i + 1) % 3]];
                bisections.push([a, b, VertexId::new(after_base.n_vertices())]);
                after_base = cut(&after_base, [a, b]);
            }
            let after = subdivided(&after_base, levels);
            let old = Subdivided { base, finest: &before };
            let new = Subdivided { base: &after_base, finest: &after };
            let found = matching(old, &bisections, new).unwrap();

            let mut positions: IdVec<VertexId, DVec3> = before.positions().clone();
            for middle in &found.middles {
                let [a, b] = middle.ends.map(|v| positions[v]);
                positions.push(a.midpoint(b));
            }
            for (v, &number) in found.numbers.enumerate() {
                assert!(after.position(v).distance(positions[number]) < 1e-12, "vertex {v} at level {levels}");
            }
            let mut numbers = found.numbers.as_slice().to_vec();
            numbers.sort_unstable();
            assert!(numbers.into_iter().eq(positions.ids()), "each vertex comes once");
            assert_eq!(matching(old, &bisections[1..], new), None, "one bisection is not told");
        }
    }
}
