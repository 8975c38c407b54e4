//! Growth of all patches at once from their seeds, cheapest face first.

use crate::disk::{PatchOf, can_add};
use crate::measured::Measured;
use crate::proxy::{Metric, Proxy};
use mesh_core::{FaceId, IdVec};
use region_map::PatchId;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A face that a patch may take.
#[derive(PartialEq)]
struct Candidate {
    cost: f64,
    face: FaceId,
    patch: PatchId,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    /// The cheapest is the greatest; ties go to the lower face, then to the lower patch.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_cost = other.cost.total_cmp(&self.cost);
        by_cost.then(other.face.cmp(&self.face)).then(other.patch.cmp(&self.patch))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Grows patches from the seeds of `proxies` over all faces. Faces that no patch can take become patches of their own, appended to
/// `proxies`, and grow too. Seeds must be distinct.
pub(crate) fn grow(surface: &Measured, metric: &Metric, proxies: &mut IdVec<PatchId, Proxy>) -> PatchOf {
    let mut growth =
        Growth { surface, metric, patch_of: IdVec::filled(None, surface.topology.n_faces()), queue: BinaryHeap::new() };
    for (patch, proxy) in proxies.enumerate() {
        growth.take(proxy.seed, patch, proxy);
    }
    growth.run(proxies);
    for f in surface.topology.faces().ids() {
        if growth.patch_of[f].is_none() {
            let proxy = Proxy::at(surface, f);
            let patch = proxies.push(proxy);
            growth.take(f, patch, &proxy);
            growth.run(proxies);
        }
    }
    growth.patch_of
}

struct Growth<'a> {
    surface: &'a Measured<'a>,
    metric: &'a Metric,
    patch_of: PatchOf,
    queue: BinaryHeap<Candidate>,
}

impl Growth<'_> {
    fn run(&mut self, proxies: &IdVec<PatchId, Proxy>) {
        while let Some(Candidate { face, patch, .. }) = self.queue.pop() {
            if self.patch_of[face].is_none() && can_add(self.surface, &self.patch_of, face, patch) {
                self.take(face, patch, &proxies[patch]);
            }
        }
    }

    /// Adds a face to a patch. Its neighbours become candidates, also those that were refused before: another edge may
    /// have made them fit.
    fn take(&mut self, f: FaceId, patch: PatchId, proxy: &Proxy) {
        self.patch_of[f] = Some(patch);
        for face in self.surface.topology.neighbours(f).into_iter().flatten() {
            if self.patch_of[face].is_none() {
                self.queue.push(Candidate { cost: self.metric.cost(self.surface, face, proxy), face, patch });
            }
        }
    }
}
