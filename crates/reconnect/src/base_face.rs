//! One face of a base mesh, with the middles of its edges.

use mesh_core::VertexId;
use region_map::SheetId;
use relax::parts::{CornerNormal, PartFace};

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

    /// The triangles of its four parts, each with the normals that it takes at its corners.
    pub(crate) fn triangles(&self) -> [([VertexId; 3], [CornerNormal; 3]); 4] {
        let ([a, b, c], [ab, bc, ca]) = (self.corners, self.middles);
        let [[na, nb, nc], [nab, nbc, nca]] = self.normals;
        [
            ([a, ab, ca], [na, nab, nca]),
            ([b, bc, ab], [nb, nbc, nab]),
            ([c, ca, bc], [nc, nca, nbc]),
            ([bc, ca, ab], [nbc, nca, nab]),
        ]
    }

    /// Its four parts, which shall have this area each.
    pub(crate) fn parts(&self, target_area: f64) -> [PartFace; 4] {
        self.triangles().map(|(corners, normals)| PartFace { corners, normals, target_area })
    }

    /// All its vertices.
    pub(crate) fn vertices(&self) -> impl Iterator<Item = VertexId> {
        self.corners.into_iter().chain(self.middles)
    }
}
