//! Snapping: first to bends of arcs, then to minor creases.

use crate::assigner::Assigner;
use crate::bends::bends;
use crate::minor::pieces;
use crate::retarget::retarget;
use crate::{LetGo, SnapError, SnapOptions};
use mesh_core::{EdgeId, VertexId};
use region_map::{Domain, Surface};
use std::collections::BTreeSet;

/// When a vertex has moved to a bend, the edges beside it may cut off another one. So bends are looked for so many times.
const BEND_ROUNDS: usize = 3;

/// A domain on a finer network.
#[derive(Clone, Debug)]
pub struct Snapped {
    /// The surface with a network that has minor creases as arcs, and bends and the ends of these arcs as corners.
    pub surface: Surface,
    /// The domain on it, at its new points. Some of its triangles may be folded until it is relaxed.
    pub domain: Domain,
    /// The bends, each with the domain vertex that is there now.
    pub bends: Vec<Bend>,
    /// The pieces of minor creases that edges of the domain follow.
    pub tracks: Vec<Track>,
}

/// A bend of an arc, and the domain vertex that is there now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bend {
    /// The vertex of the working mesh.
    pub at: VertexId,
    /// The domain vertex.
    pub vertex: VertexId,
}

/// A piece of a minor crease, and the domain vertices along it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Track {
    /// The edges of the working mesh, in order.
    pub edges: Vec<EdgeId>,
    /// The domain vertices, in the same order; each is joined with the next by an edge.
    pub path: Vec<VertexId>,
    /// Whether it is followed only as a person sees its edges as sharp.
    pub only_seen: bool,
}

/// Moves vertices of a relaxed domain to the bends of arcs and to the minor creases that its edges can follow.
///
/// The nearer end of the edge that cuts off a bend moves there. A minor crease is cut where it turns sharply or meets an arc, and
/// each piece gets a path of edges inside its sheet. The vertices around move along. Left as they are: creases that turn too much
/// for the edges, or that the domain is near to as it is, or without a path, and what is in `let_go`. Edges in `seen` are those that a person sees
/// as sharp: of them shorter pieces are followed as well, and however near the domain is.
///
/// The domain of the result fits its surface ([`Domain::check`]). The caller has to relax it there, and may ask [`Snapped::poor`]
/// what was not worth it.
///
/// A surface that is interrupted ends it early, with some of it left out.
///
/// Fails where the domain does not fit the surface.
pub fn snap(
    surface: &Surface,
    domain: &Domain,
    seen: &BTreeSet<EdgeId>,
    let_go: &LetGo,
    options: &SnapOptions,
) -> Result<Snapped, SnapError> {
    domain.check(surface.network())?;
    let mut assigner = Assigner::new(surface, domain);
    let mut taken = Vec::new();
    for _ in 0..BEND_ROUNDS {
        let bends = bends(surface, assigner.assignment.spans(), options);
        for at in bends.into_iter().filter(|v| !let_go.bends.contains(v)) {
            taken.extend(assigner.take_on_arc(at).map(|vertex| Bend { at, vertex }));
        }
    }
    let is_kept = |edge: EdgeId| !let_go.minor.contains(&edge);
    let mut tracks = followed(&mut assigner, is_kept, false, options);
    let in_tracks: BTreeSet<EdgeId> = tracks.iter().flat_map(|track| track.edges.iter().copied()).collect();
    let is_left = |edge: EdgeId| seen.contains(&edge) && is_kept(edge) && !in_tracks.contains(&edge);
    tracks.extend(followed(&mut assigner, is_left, true, &options.for_seen()));
    let (surface, domain) = retarget(&assigner.assignment)?;
    Ok(Snapped { surface, domain, bends: taken, tracks })
}

/// Follows the minor creases, as far as their edges are kept.
fn followed(assigner: &mut Assigner<'_>, is_kept: impl Fn(EdgeId) -> bool, only_seen: bool, options: &SnapOptions) -> Vec<Track> {
    let (surface, edge_length) = (assigner.assignment.surface, assigner.assignment.edge_length);
    let chains = surface.network().minor.iter();
    let pieces: Vec<_> = chains.flat_map(|chain| pieces(surface, chain, edge_length, &is_kept, options)).collect();
    let mut tracks = Vec::new();
    for piece in pieces {
        if surface.interrupt().is_set() {
            break;
        }
        // The path of a short piece may turn a ring inside out.
        let may_be = !only_seen || !assigner.assignment.closes_a_ring(&piece);
        if may_be && assigner.depth(&piece) >= options.least_depth {
            tracks.extend(assigner.follow(&piece).map(|path| Track { edges: piece.edges, path, only_seen }));
        }
    }
    tracks
}

impl Snapped {
    /// True when nothing was snapped to.
    pub fn is_unchanged(&self) -> bool {
        self.bends.is_empty() && self.tracks.is_empty()
    }
}
