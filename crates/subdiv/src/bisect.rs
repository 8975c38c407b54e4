//! What becomes of the finest level when edges of the base mesh are bisected: no vertex of it is lost, and every new one is the middle
//! of an edge that was there before.
//!
//! Let a base face (a, b, c) be cut from c to the middle m of ab. A vertex of the finest level with the weights (p, q, r) / n in it has,
//! where p is at least q, the weights (p - q, 2q, r) / n in (a, m, c), and so is one of the vertices there. The others lie half way
//! between two that differ by a step along ab.

use mesh_core::{FaceId, IdVec, VertexId};
use rustc_hash::FxHashMap;

/// A vertex of the bisected domain that was not there before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Middle {
    /// The ends of the edge that it is the middle of.
    pub ends: [u32; 2],
    /// The third vertices of triangles beside that edge, as far as they are in the same base face.
    pub beside: [Option<u32>; 2],
}

/// A domain on a base mesh with bisected edges, told by the one before.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bisected {
    /// The new vertices in the order in which they can be made. They have the numbers after those of the vertices of the domain before;
    /// so have those that they lie between.
    pub middles: Vec<Middle>,
    /// For every vertex of the new domain its number: that of the vertex before, or that of a new one.
    pub numbers: IdVec<VertexId, u32>,
}

/// A base mesh and its subdivision, by their faces.
#[derive(Clone, Copy, Debug)]
pub struct Faces<'a> {
    /// Those of the base mesh.
    pub base: &'a IdVec<FaceId, [VertexId; 3]>,
    /// Those of the finest level, in the order of [`subdivide`](crate::subdivide).
    pub finest: &'a IdVec<FaceId, [VertexId; 3]>,
}

/// Matches the subdivision of a base mesh with that of the same base mesh after bisections: of the edges (a, b) by a new base vertex m,
/// given as [a, b, m] in their order. `None` where the new base mesh is not what these make of the old one.
pub fn bisected(before: Faces<'_>, bisections: &[[VertexId; 3]], after: Faces<'_>, levels: u32) -> Option<Bisected> {
    let n = 1usize << levels;
    let corners = finest_corners(levels);
    let mut patches: Vec<Patch> = Vec::new();
    let mut at_edge: FxHashMap<[VertexId; 2], usize> = FxHashMap::default();
    let mut middles =
        Middles { first: 1 + before.finest.iter().flatten().map(|v| v.0).max()?, made: Vec::new(), of: FxHashMap::default() };
    for (f, &base) in before.base.enumerate() {
        let mut grid = Grid::new(n);
        for (i, places) in corners.iter().enumerate() {
            let face = before.finest.get(FaceId((f.0 << (2 * levels)) + i as u32))?;
            places.iter().zip(face).for_each(|(&at, v)| grid.set(at, v.0));
        }
        add(&mut patches, &mut at_edge, Patch { corners: base, grid });
    }
    for &[a, b, m] in bisections {
        let sides = [[a, b], [b, a]].map(|edge| at_edge.get(&edge).copied());
        for (i, [from, to]) in sides.into_iter().zip([[a, b], [b, a]]).filter_map(|(i, edge)| Some((i?, edge))) {
            let patch = patches[i].from(from)?;
            let [first, second] = patch.halves(m, &mut middles);
            sides_of(patch.corners).iter().for_each(|side| _ = at_edge.remove(side));
            debug_assert_eq!(patch.corners[1], to);
            add(&mut patches, &mut at_edge, first);
            add(&mut patches, &mut at_edge, second);
        }
    }
    let mut numbers = IdVec::filled(u32::MAX, 1 + after.finest.iter().flatten().map(|v| v.0).max()? as usize);
    for (f, &[a, b, c]) in after.base.enumerate() {
        let patch = patches[*at_edge.get(&[a, b])?].from(a)?;
        if patch.corners != [a, b, c] {
            return None;
        }
        for (i, places) in corners.iter().enumerate() {
            let face = after.finest.get(FaceId((f.0 << (2 * levels)) + i as u32))?;
            places.iter().zip(face).for_each(|(&at, &v)| numbers[v] = patch.grid.at(at));
        }
    }
    Some(Bisected { middles: middles.made, numbers })
}

fn add(patches: &mut Vec<Patch>, at_edge: &mut FxHashMap<[VertexId; 2], usize>, patch: Patch) {
    at_edge.extend(sides_of(patch.corners).map(|side| (side, patches.len())));
    patches.push(patch);
}

fn sides_of(corners: [VertexId; 3]) -> [[VertexId; 2]; 3] {
    [0, 1, 2].map(|k| [corners[k], corners[(k + 1) % 3]])
}

/// The weights of a vertex of the finest level in its base face, times the number of segments of a side.
type Place = [usize; 3];

/// Where the corners of the finest faces in a base face are, in the order of the finest level.
fn finest_corners(levels: u32) -> Vec<[Place; 3]> {
    let n = 1usize << levels;
    let mut faces = vec![[[n, 0, 0], [0, n, 0], [0, 0, n]]];
    let middle = |p: Place, q: Place| [0, 1, 2].map(|i| (p[i] + q[i]) / 2);
    for _ in 0..levels {
        let children = |[a, b, c]: [Place; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]]
        };
        faces = faces.into_iter().flat_map(children).collect();
    }
    faces
}

/// The vertices of the finest level in a base face.
#[derive(Clone)]
struct Grid {
    n: usize,
    numbers: Vec<u32>,
}

impl Grid {
    fn new(n: usize) -> Self {
        Self { n, numbers: vec![u32::MAX; (n + 1) * (n + 1)] }
    }
    fn at(&self, [_, q, r]: Place) -> u32 {
        self.numbers[q * (self.n + 1) + r]
    }
    fn set(&mut self, [_, q, r]: Place, number: u32) {
        self.numbers[q * (self.n + 1) + r] = number;
    }
    /// The grid with the numbers that a function has for its places.
    fn filled(n: usize, mut number: impl FnMut(Place) -> u32) -> Self {
        let mut grid = Self::new(n);
        for q in 0..=n {
            for r in 0..=n - q {
                let place = [n - q - r, q, r];
                grid.set(place, number(place));
            }
        }
        grid
    }
}

/// A base face under change.
struct Patch {
    corners: [VertexId; 3],
    grid: Grid,
}

impl Patch {
    /// The same with its corners turned so that `v` comes first. `None` where it is no corner.
    fn from(&self, v: VertexId) -> Option<Self> {
        let c = self.corners.iter().position(|&w| w == v)?;
        let corners = [0, 1, 2].map(|i| self.corners[(c + i) % 3]);
        let grid = Grid::filled(self.grid.n, |p| self.grid.at([0, 1, 2].map(|i| p[(i + 3 - c) % 3])));
        Some(Self { corners, grid })
    }

    /// Both halves of the patch (a, b, c) with m in the middle of ab: (a, m, c) and (m, b, c).
    fn halves(&self, m: VertexId, middles: &mut Middles) -> [Self; 2] {
        let ([a, b, c], n) = (self.corners, self.grid.n);
        // In halves of the patch's own weights.
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
    first: u32,
    made: Vec<Middle>,
    of: FxHashMap<[u32; 2], u32>,
}

impl Middles {
    /// The number of the vertex between the places (p + 1, q, r) and (p, q + 1, r).
    fn between(&mut self, grid: &Grid, [p, q, r]: Place) -> u32 {
        let ends = [grid.at([p + 1, q, r]), grid.at([p, q + 1, r])];
        let beside = [Some(grid.at([p, q, r + 1])), (r > 0).then(|| grid.at([p + 1, q + 1, r.max(1) - 1]))];
        let next = self.first + self.made.len() as u32;
        let key = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let made = &mut self.made;
        *self.of.entry(key).or_insert_with(|| {
            made.push(Middle { ends, beside });
            next
        })
    }
}
