//! What a soup is, before any repair.

use crate::clean::{edge_groups, is_usable, merge_equal};
use crate::exact::collinear;
use crate::limits::{MOST_FACES, MOST_VERTICES};
use crate::partition::Partition;
use crate::{FaceId, HalfedgeId, Id, IdVec, Soup, VertexId};

/// Counts of a soup as it was read, and of its topology after merging vertices at exactly the same position and leaving out
/// triangles that are out of range, not finite, or collapse. Of more than 1.4e9 triangles the topology is not counted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inspection {
    /// Vertices as read.
    pub vertices: usize,
    /// Vertices after merging those at exactly the same position.
    pub merged_vertices: usize,
    /// Triangles as read.
    pub triangles: usize,
    /// Parts connected by edges or vertices.
    pub components: usize,
    /// Connected parts of the edges that have one triangle.
    pub boundary_loops: usize,
    /// Sum of the genus of all components; `None` where an edge or vertex is not manifold or orientation is not consistent.
    pub genus: Option<i64>,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Vertices on such an edge, or with more than one fan of triangles.
    pub non_manifold_vertices: usize,
    /// Edges of two triangles that face different ways.
    pub inconsistent_edges: usize,
    /// Triangles whose corners lie exactly on one line, those with the same corner twice included.
    pub zero_area: usize,
    /// Triangles beyond the first on the same three vertices, facing either way.
    pub repeated: usize,
    /// Triangles with a vertex index out of range.
    pub bad_index: usize,
    /// Vertices with a coordinate that is infinite, not a number, or larger than 1e75.
    pub not_finite: usize,
}

/// Counts what a soup holds; changes nothing.
pub fn inspect(soup: &Soup) -> Inspection {
    let merged = merge_equal(&soup.positions);
    let mut seen = Inspection { vertices: soup.positions.len(), triangles: soup.triangles.len(), ..Inspection::default() };
    seen.merged_vertices = merged.iter().enumerate().filter(|&(i, &m)| m as usize == i).count();
    seen.not_finite = soup.positions.iter().filter(|&&p| !is_usable(p)).count();
    let mut faces = IdVec::<FaceId, [VertexId; 3]>::new();
    for triangle in &soup.triangles {
        if triangle.iter().any(|&v| v as usize >= soup.positions.len()) {
            seen.bad_index += 1;
            continue;
        }
        let [a, b, c] = triangle.map(|v| soup.positions[v as usize]);
        if !(is_usable(a) && is_usable(b) && is_usable(c)) {
            continue;
        }
        seen.zero_area += usize::from(collinear(a, b, c));
        let [i, j, k] = triangle.map(|v| VertexId(merged[v as usize]));
        if i != j && j != k && k != i {
            faces.push([i, j, k]);
        }
    }
    seen.repeated = count_repeated(&faces);
    if faces.len() > MOST_FACES || soup.positions.len() > MOST_VERTICES {
        return seen;
    }
    inspect_topology(&faces, soup.positions.len(), &mut seen);
    seen
}

fn count_repeated(faces: &IdVec<FaceId, [VertexId; 3]>) -> usize {
    let mut sorted: Vec<_> = faces.iter().copied().collect();
    for f in &mut sorted {
        f.sort_unstable();
    }
    sorted.sort_unstable();
    sorted.windows(2).filter(|w| w[0] == w[1]).count()
}

fn inspect_topology(faces: &IdVec<FaceId, [VertexId; 3]>, n_vertices: usize, seen: &mut Inspection) {
    let mut parts = Partition::<VertexId>::of_singles(n_vertices);
    let mut loops = Partition::<VertexId>::of_singles(n_vertices);
    let mut fans = Fans::new(faces, n_vertices);
    let mut border = Vec::new();
    let mut n_edges = 0;
    for uses in edge_groups(faces).iter() {
        let ([a, b], first) = uses[0];
        n_edges += 1;
        parts.join(a, b);
        for &(_, h) in &uses[1..] {
            fans.connect(first, h, [a, b]);
        }
        match *uses {
            [_] => {
                loops.join(a, b);
                border.push(a);
            }
            [(_, g), (_, h)] => seen.inconsistent_edges += usize::from(fans.start(g) == fans.start(h)),
            _ => {
                seen.non_manifold_edges += 1;
                fans.spoil([a, b]);
            }
        }
    }
    seen.components = parts.count(faces.iter().map(|f| f[0]));
    seen.boundary_loops = loops.count(border);
    let (n_used, n_bad) = fans.count();
    seen.non_manifold_vertices = n_bad;
    if seen.non_manifold_edges + n_bad + seen.inconsistent_edges == 0 {
        let euler = n_used as i64 - n_edges + faces.len() as i64;
        seen.genus = Some((2 * seen.components as i64 - seen.boundary_loops as i64 - euler) / 2);
    }
}

/// The corners of faces, in parts that are the fans of their vertices. A corner goes by the halfedge that starts there.
struct Fans<'a> {
    faces: &'a IdVec<FaceId, [VertexId; 3]>,
    corners: Partition<HalfedgeId>,
    /// Vertices of edges with more than two faces.
    spoilt: IdVec<VertexId, bool>,
}

impl<'a> Fans<'a> {
    fn new(faces: &'a IdVec<FaceId, [VertexId; 3]>, n_vertices: usize) -> Self {
        Self { faces, corners: Partition::of_singles(3 * faces.len()), spoilt: IdVec::filled(false, n_vertices) }
    }

    fn start(&self, h: HalfedgeId) -> VertexId {
        self.faces[h.face()][h.corner()]
    }

    /// Two faces share the edge between `ends`.
    fn connect(&mut self, g: HalfedgeId, h: HalfedgeId, ends: [VertexId; 2]) {
        for v in ends {
            let [g, h] = [g, h].map(|e| if self.start(e) == v { e } else { e.next() });
            self.corners.join(g, h);
        }
    }

    fn spoil(&mut self, ends: [VertexId; 2]) {
        for v in ends {
            self.spoilt[v] = true;
        }
    }

    /// Vertices with faces, and how many of these are not manifold.
    fn count(mut self) -> (usize, usize) {
        let mut fans = IdVec::<VertexId, u32>::filled(0, self.spoilt.len());
        for corner in (0..3 * self.faces.len()).map(HalfedgeId::new) {
            if self.corners.part(corner) == corner {
                fans[self.start(corner)] += 1;
            }
        }
        let used = fans.iter().filter(|&&n| n > 0).count();
        let bad = fans.enumerate().filter(|&(v, &n)| n > 1 || self.spoilt[v]).count();
        (used, bad)
    }
}
