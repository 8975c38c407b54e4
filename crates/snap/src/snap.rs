//! The verb of this crate: the network at the resolution of the finest level, and the domain hung on it.

use crate::bends::bends;
use crate::claims::Claims;
use crate::minor::pieces;
use crate::retarget::retarget;
use crate::{SnapError, SnapOptions};
use mesh_core::{EdgeId, FaceId, HalfedgeId, TriMesh, VertexId, aspect_ratio};
use region_map::{Domain, RegionMapError, Surface};
use std::collections::BTreeSet;

/// Once bends have taken vertices, the edges beside them may leave the arc at the next one.
const BEND_ROUNDS: usize = 3;
/// A triangle may keep this share of the quality that was the worst around.
const MOST_LOSS: f64 = 0.9;

/// What shall not be snapped to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LetGo {
    /// Bends, by their vertices of the working mesh.
    pub bends: BTreeSet<VertexId>,
    /// Edges of minor creases.
    pub minor: BTreeSet<EdgeId>,
}

/// A domain hung on a finer network.
#[derive(Clone, Debug)]
pub struct Snapped {
    /// The surface with a network that has minor creases as arcs, and bends and the ends of these arcs as corners.
    pub surface: Surface,
    /// The domain on it, at its new points. Some of its triangles may be folded until it is relaxed.
    pub domain: Domain,
    /// Bends with the domain vertices that they took.
    pub bends: Vec<(VertexId, VertexId)>,
    /// Pieces of minor creases, as edges of the working mesh, with the path of domain vertices along each.
    pub tracks: Vec<(Vec<EdgeId>, Vec<VertexId>)>,
}

/// Hangs a relaxed domain on the bends of arcs and on the minor creases that its edges can follow.
///
/// A bend takes the nearer end of the edge that cuts it off. A minor crease takes a path of edges inside its sheet, one for each
/// piece between its ends, sharp turns and meetings with arcs. The vertices around are dragged along. What turns too much for the
/// edges, what the domain hardly misses, and what finds no path, is left as it was; so is what is in `let_go`.
///
/// The domain of the result fits its surface ([`Domain::check`]). The caller has to relax it there, and may ask [`Snapped::poor`]
/// what was not worth it.
///
/// Fails where the domain does not fit the surface.
pub fn snap(surface: &Surface, domain: &Domain, let_go: &LetGo, options: &SnapOptions) -> Result<Snapped, SnapError> {
    domain.check(surface.network())?;
    let mut claims = Claims::new(surface, domain);
    let (mut taken, mut tracks) = (Vec::new(), Vec::new());
    for _ in 0..BEND_ROUNDS {
        for bend in bends(surface, &claims.spans, options).into_iter().filter(|v| !let_go.bends.contains(v)) {
            taken.extend(claims.pin_on_arc(bend).map(|v| (bend, v)));
        }
    }
    let chains = surface.network().minor.iter();
    let pieces: Vec<_> = chains.flat_map(|chain| pieces(surface, chain, claims.edge_length(), let_go, options)).collect();
    for piece in pieces {
        if claims.depth(&piece) >= options.least_depth {
            tracks.extend(claims.follow(&piece).map(|path| (piece.edges, path)));
        }
    }
    let (surface, domain) = retarget(&claims)?;
    Ok(Snapped { surface, domain, bends: taken, tracks })
}

impl Snapped {
    /// True when nothing was snapped to.
    pub fn is_unchanged(&self) -> bool {
        self.bends.is_empty() && self.tracks.is_empty()
    }

    /// What came out poor: triangles beside it have turned over, are among those `refused` or have a corner in common with one, or have less
    /// quality than the bound of the options and than the worst there before. Of a piece of a minor crease that is the half beside such
    /// triangles, or both.
    ///
    /// `before` and `after` are the domain before snapping, and relaxed after it. Fails where one of them has other numbers of vertices
    /// or faces than this domain. What is in `refused` and no face of the domain is passed over.
    pub fn poor(&self, [before, after]: [&TriMesh; 2], refused: &[FaceId], options: &SnapOptions) -> Result<LetGo, SnapError> {
        let topology = &self.domain.topology;
        for mesh in [before, after] {
            let sizes = [(mesh.n_vertices(), topology.n_vertices()), (mesh.n_faces(), topology.n_faces())];
            if let Some((found, expected)) = sizes.into_iter().find(|(found, expected)| found != expected) {
                return Err(RegionMapError::WrongSize { what: "the mesh", found, expected }.into());
            }
        }
        let corners = refused.iter().filter_map(|&f| topology.faces().get(f)).flatten();
        let refused: BTreeSet<FaceId> = corners.flat_map(|&v| topology.fan(v)).map(HalfedgeId::face).collect();
        let is_poor = |vertices: &[VertexId]| {
            let star: BTreeSet<FaceId> = vertices.iter().flat_map(|&v| topology.fan(v)).map(HalfedgeId::face).collect();
            let worst = |mesh: &TriMesh| star.iter().map(|&f| aspect_ratio(mesh.triangle(f))).fold(f64::INFINITY, f64::min);
            let turned = |&f: &FaceId| before.normal(f).dot(after.normal(f)) <= 0.0;
            star.iter().any(|f| turned(f) || refused.contains(f))
                || worst(after) < options.least_quality.min(MOST_LOSS * worst(before))
        };
        let bends = self.bends.iter().filter(|(_, v)| is_poor(&[*v])).map(|&(bend, _)| bend).collect();
        let mut minor = BTreeSet::new();
        for (edges, path) in &self.tracks {
            let ([first, second], [start, end]) = (halves(edges), halves(path));
            minor.extend(first.iter().filter(|_| is_poor(start)).chain(second.iter().filter(|_| is_poor(end))));
        }
        Ok(LetGo { bends, minor })
    }
}

/// Both halves of a list, the one in the middle in both.
fn halves<T>(list: &[T]) -> [&[T]; 2] {
    [&list[..list.len().div_ceil(2)], &list[list.len() / 2..]]
}
