//! Typed ids and the vectors that they index.
//!
//! An id is a `u32` that cannot be mixed up with one of another kind. An [`IdVec`] is a `Vec` that only its own id indexes.

use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

/// What every id can do: be made from an index, and give it back.
pub trait Id: Copy + Eq + Ord + std::hash::Hash + std::fmt::Debug {
    /// The id of the element at `index`. Panics when `index` does not fit in 32 bits.
    fn new(index: usize) -> Self;
    /// The index of the element.
    fn index(self) -> usize;
}

/// Defines id types: `define_id! { /// A patch. PatchId "p" }` gives a `u32` newtype that prints as `p12`.
#[macro_export]
macro_rules! define_id {
    ($($(#[$doc:meta])* $name:ident $prefix:literal)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $crate::Id for $name {
            fn new(index: usize) -> Self {
                Self(u32::try_from(index).expect("more than 2^32 elements"))
            }
            fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl std::fmt::Debug for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, concat!($prefix, "{}"), self.0)
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, "{}", self.0)
            }
        }
    )*};
}

define_id! {
    /// A vertex of a mesh.
    VertexId "v"
    /// A face (triangle) of a mesh.
    FaceId "f"
    /// A halfedge: `3 * face + corner`, from that corner to the next.
    HalfedgeId "h"
    /// An undirected edge.
    EdgeId "e"
}

impl HalfedgeId {
    /// The halfedge of `face` that starts at its corner `corner` (0, 1 or 2). Faces of a mesh are below 1,431,655,765, so that the
    /// numbers of their halfedges fit; the halfedge of another one is that of some face that it is not.
    pub fn of(face: FaceId, corner: usize) -> Self {
        Self(face.0.wrapping_mul(3).wrapping_add(corner as u32))
    }
    /// The face that the halfedge belongs to.
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }
    /// The corner of its face that the halfedge starts at.
    pub fn corner(self) -> usize {
        (self.0 % 3) as usize
    }
    /// The next halfedge of the same face.
    pub fn next(self) -> Self {
        if self.0 % 3 == 2 { Self(self.0 - 2) } else { Self(self.0.wrapping_add(1)) }
    }
    /// The previous halfedge of the same face.
    pub fn prev(self) -> Self {
        if self.0.is_multiple_of(3) { Self(self.0.wrapping_add(2)) } else { Self(self.0 - 1) }
    }
}

/// A vector indexed by one kind of id.
#[derive(Clone, PartialEq, Eq)]
pub struct IdVec<I, T> {
    raw: Vec<T>,
    id: PhantomData<fn() -> I>,
}

impl<I: Id, T> IdVec<I, T> {
    /// An empty vector.
    pub fn new() -> Self {
        Self::from_vec(Vec::new())
    }
    /// The elements of `raw`, with ids in their order.
    pub fn from_vec(raw: Vec<T>) -> Self {
        Self { raw, id: PhantomData }
    }
    /// `n` copies of `value`.
    pub fn filled(value: T, n: usize) -> Self
    where
        T: Clone,
    {
        Self::from_vec(vec![value; n])
    }
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.raw.len()
    }
    /// True without elements.
    pub fn is_empty(&self) -> bool {
        self.raw.is_empty()
    }
    /// Appends an element and returns its id.
    pub fn push(&mut self, value: T) -> I {
        self.raw.push(value);
        I::new(self.raw.len() - 1)
    }
    /// The element of `id`, `None` out of range.
    pub fn get(&self, id: I) -> Option<&T> {
        self.raw.get(id.index())
    }
    /// All ids in order.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = I> + ExactSizeIterator + use<I, T> {
        (0..self.raw.len()).map(I::new)
    }
    /// The elements in order.
    pub fn iter(&self) -> std::slice::Iter<'_, T> {
        self.raw.iter()
    }
    /// The elements in order, to change.
    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, T> {
        self.raw.iter_mut()
    }
    /// Ids with their elements, in order.
    pub fn enumerate(&self) -> impl DoubleEndedIterator<Item = (I, &T)> + ExactSizeIterator {
        self.raw.iter().enumerate().map(|(i, t)| (I::new(i), t))
    }
    /// The elements as a slice.
    pub fn as_slice(&self) -> &[T] {
        &self.raw
    }
    /// The elements as a mutable slice.
    pub fn as_mut_slice(&mut self) -> &mut [T] {
        &mut self.raw
    }
    /// The elements without their id type.
    pub fn into_vec(self) -> Vec<T> {
        self.raw
    }
}

impl<I: Id, T> Default for IdVec<I, T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<I: Id, T> Index<I> for IdVec<I, T> {
    type Output = T;
    fn index(&self, id: I) -> &T {
        &self.raw[id.index()]
    }
}

impl<I: Id, T> IndexMut<I> for IdVec<I, T> {
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.raw[id.index()]
    }
}

impl<I: Id, T> FromIterator<T> for IdVec<I, T> {
    fn from_iter<It: IntoIterator<Item = T>>(items: It) -> Self {
        Self::from_vec(items.into_iter().collect())
    }
}

impl<'a, I, T> IntoIterator for &'a IdVec<I, T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;
    fn into_iter(self) -> Self::IntoIter {
        self.raw.iter()
    }
}

impl<I, T: std::fmt::Debug> std::fmt::Debug for IdVec<I, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.raw.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halfedges_go_round_their_face() {
        for c in 0..3 {
            let h = HalfedgeId::of(FaceId(7), c);
            assert_eq!((h.face(), h.corner()), (FaceId(7), c));
            assert_eq!(h.next().prev(), h);
            assert_eq!(h.next().next().next(), h);
            assert_eq!(h.next().corner(), (c + 1) % 3);
        }
    }

    #[test]
    fn ids_print_with_their_kind() {
        assert_eq!(format!("{:?} {:?} {}", VertexId(3), FaceId(0), EdgeId(5)), "v3 f0 5");
    }
}
