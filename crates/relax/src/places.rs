//! Folds, each relaxed by itself with all around it held, as if there were no others: among hundreds of thousands of triangles a
//! few have little say, and where many give way for them these fold in turn.

use crate::ShapeOptions;
use crate::best_shape::best_shape;
use crate::freedom::Freedom;
use crate::measured::Measured;
use crate::mend::Mender;
use crate::movable_domain::MovableDomain;
use crate::part::{Part, PartFace};
use crate::placed_vertex::PlacedVertex;
use crate::placement::Placement;
use mesh_core::{FaceId, HalfedgeId, IdVec, Topology, VertexId};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Mean quality (AR) that a place may lose for having its folds undone: the worst triangle is all that counts there.
const SLACK: f64 = 0.1;
/// A place whose rim meets itself in a vertex is widened at most so often, and then left as it is. More would reach places that
/// are large.
const MOST_WIDER: usize = 8;

/// Relaxes the places of some faces, each with the vertices up to `edges` edges away. Returns the number of Newton steps.
pub(crate) fn relax_places(
    mender: &Mender,
    targets: &IdVec<FaceId, f64>,
    placement: &mut Placement,
    (faces, edges): (&[FaceId], usize),
    options: &ShapeOptions,
) -> usize {
    let domain = mender.domain;
    let mut steps = 0;
    let clusters = domain.topology.clusters(faces);
    let mut left: Vec<Place<'_>> = clusters.iter().filter_map(|f| Place::new(domain, f, edges, targets)).collect();
    while !left.is_empty() {
        let (apart, others) = apart(left);
        let relaxed: Vec<_> = apart.par_iter().map(|place| place.relaxed(mender, placement, options)).collect();
        for (moved, steps_there) in relaxed {
            moved.into_iter().for_each(|(v, placed)| placement.move_to(v, placed));
            steps += steps_there;
        }
        left = others;
    }
    steps
}

/// A fold and what is around it.
struct Place<'a>(Part<'a>);

impl<'a> Place<'a> {
    /// The place of some faces with all vertices up to `edges` edges away free. Wider where it would be no manifold.
    fn new(domain: &MovableDomain<'a>, folds: &[FaceId], edges: usize, targets: &IdVec<FaceId, f64>) -> Option<Self> {
        (0..MOST_WIDER).find_map(|wider| {
            let free = within(&domain.topology, folds, edges.saturating_add(wider));
            let faces = domain.fans(&free);
            let normals = |f| [0, 1, 2].map(|c| domain.normals[HalfedgeId::of(f, c)]);
            let part_face =
                |&f: &FaceId| PartFace { corners: domain.topology.face(f), normals: normals(f), target_area: targets[f] };
            let triangles: Vec<PartFace> = faces.iter().map(part_face).collect();
            let is_free = |v| free.binary_search(&v).is_ok();
            Part::new(domain, &triangles, |v| if is_free(v) { domain.freedoms[v] } else { Freedom::Fixed }).map(Self)
        })
    }

    /// Where its vertices are after it was relaxed, and the number of Newton steps.
    fn relaxed(&self, mender: &Mender, placement: &Placement, options: &ShapeOptions) -> (Vec<(VertexId, PlacedVertex)>, usize) {
        let Self(part) = self;
        let start = Measured::new(&part.domain, part.placement(|v| placement[v]));
        let best = best_shape(&mender.of_part(&part.domain), &part.targets, start, SLACK, options);
        (part.moved(best.measured.placement()), best.steps)
    }
}

/// Some places that have no vertex in common, and all others.
fn apart(places: Vec<Place<'_>>) -> (Vec<Place<'_>>, Vec<Place<'_>>) {
    let mut taken = BTreeSet::new();
    places.into_iter().partition(|place| {
        let is_free = place.0.vertices.iter().all(|v| !taken.contains(v));
        if is_free {
            taken.extend(place.0.vertices.iter().copied());
        }
        is_free
    })
}

/// The vertices at most so many edges away from some faces, in rising order.
fn within(topology: &Topology, faces: &[FaceId], edges: usize) -> Vec<VertexId> {
    let mut reached: BTreeSet<VertexId> = faces.iter().flat_map(|&f| topology.face(f)).collect();
    let mut last: Vec<VertexId> = reached.iter().copied().collect();
    for _ in 0..edges {
        if last.is_empty() {
            break;
        }
        last = last.into_iter().flat_map(|v| topology.one_ring(v)).filter(|&w| reached.insert(w)).collect();
    }
    reached.into_iter().collect()
}
