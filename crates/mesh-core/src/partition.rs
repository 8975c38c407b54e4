//! Union-find.

use crate::{Id, IdVec};

/// Elements in parts that can be joined (Tarjan's disjoint sets with path halving).
pub(crate) struct Partition<I> {
    parent: IdVec<I, I>,
}

impl<I: Id> Partition<I> {
    /// `n` parts of one element each.
    pub(crate) fn of_singles(n: usize) -> Self {
        Self { parent: (0..n).map(I::new).collect() }
    }

    /// The part of an element, named by its lowest element.
    pub(crate) fn part(&mut self, mut i: I) -> I {
        while self.parent[i] != i {
            self.parent[i] = self.parent[self.parent[i]];
            i = self.parent[i];
        }
        i
    }

    /// Makes one part of the parts of two elements.
    pub(crate) fn join(&mut self, a: I, b: I) {
        let (a, b) = (self.part(a), self.part(b));
        self.parent[a.max(b)] = a.min(b);
    }

    /// Number of parts that some elements are in.
    pub(crate) fn count(&mut self, elements: impl IntoIterator<Item = I>) -> usize {
        let mut parts: Vec<I> = elements.into_iter().map(|i| self.part(i)).collect();
        parts.sort_unstable();
        parts.dedup();
        parts.len()
    }
}
