//! Folds, each relaxed by itself with all around it held, as if there were no others: among hundreds of thousands of triangles a few have
//! little say, and where many give way for them these fold in turn.

use crate::ShapeOptions;
use crate::domain::{Domain, Freedom};
use crate::mend::Mender;
use crate::part::Part;
use crate::placement::{Placement, Spot};
use crate::quality::Quality;
use crate::relax::best_shape;
use mesh_core::{FaceId, HalfedgeId, IdVec, Topology, VertexId};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Mean quality that a place may lose: the worst triangle is all that counts there.
const SLACK: f64 = 0.1;
/// A place whose rim meets itself in a vertex is widened at most so often.
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
    let mut left: Vec<Place> = domain.topology.clusters(faces).iter().filter_map(|f| Place::new(domain, f, edges)).collect();
    while !left.is_empty() {
        let (apart, others) = apart(left);
        let relaxed: Vec<_> = apart.par_iter().map(|place| place.relaxed(mender, targets, placement, options)).collect();
        for (moved, steps_there) in relaxed {
            moved.into_iter().for_each(|(v, spot)| placement.move_to(v, spot));
            steps += steps_there;
        }
        left = others;
    }
    steps
}

/// A fold and what is around it.
struct Place {
    faces: Vec<FaceId>,
    part: Part,
}

impl Place {
    /// The place of some faces with all vertices up to `edges` edges away free. Wider where it would be no manifold.
    fn new(domain: &Domain, folds: &[FaceId], edges: usize) -> Option<Self> {
        (edges..edges + MOST_WIDER).find_map(|edges| {
            let free = within(domain.topology, folds, edges);
            let faces = domain.fans(&free);
            let normals = |f| [0, 1, 2].map(|c| domain.normals[HalfedgeId::of(f, c)]);
            let triangles: Vec<_> = faces.iter().map(|&f| (domain.topology.face(f), normals(f))).collect();
            let is_free = |v| free.binary_search(&v).is_ok();
            let part = Part::new(&triangles, |v| if is_free(v) { domain.freedoms[v] } else { Freedom::Fixed })?;
            Some(Self { faces, part })
        })
    }

    /// Where its vertices are after it was relaxed, and the number of Newton steps.
    fn relaxed(
        &self,
        mender: &Mender,
        targets: &IdVec<FaceId, f64>,
        placement: &Placement,
        options: &ShapeOptions,
    ) -> (Vec<(VertexId, Spot)>, usize) {
        let domain = self.part.domain(mender.domain);
        let targets = self.faces.iter().map(|&f| targets[f]).collect();
        let start = self.part.placement(|v| placement[v]);
        let quality = Quality::of(&start, &domain);
        let (best, _, steps) = best_shape(&mender.of_part(&domain), &targets, (start, quality), SLACK, options);
        (self.part.moved(&best), steps)
    }
}

/// Some places that have no vertex in common, and all others.
fn apart(places: Vec<Place>) -> (Vec<Place>, Vec<Place>) {
    let mut taken = BTreeSet::new();
    places.into_iter().partition(|place| {
        let is_free = place.part.vertices.iter().all(|v| !taken.contains(v));
        if is_free {
            taken.extend(place.part.vertices.iter().copied());
        }
        is_free
    })
}

/// The vertices at most so many edges away from some faces, in rising order.
fn within(topology: &Topology, faces: &[FaceId], edges: usize) -> Vec<VertexId> {
    let mut reached: BTreeSet<VertexId> = faces.iter().flat_map(|&f| topology.face(f)).collect();
    let mut last: Vec<VertexId> = reached.iter().copied().collect();
    for _ in 0..edges {
        last = last.into_iter().flat_map(|v| topology.one_ring(v)).filter(|&w| reached.insert(w)).collect();
    }
    reached.into_iter().collect()
}
