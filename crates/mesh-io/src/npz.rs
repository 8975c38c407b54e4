//! npz, numpy's format of several arrays: a zip file of npy files.
//!
//! A npy file is a header of text and the plain numbers (NumPy enhancement proposal 1). The zip around them is the part with pitfalls, and a
//! package does it. Packages for npy itself (npyz, ndarray-npy) read the header with a parser of all Python literals, which brings ten more
//! packages and which a header can overflow or nest until it panics; a header of ours has three entries of fixed kinds.

mod array;
mod header;
mod read;
mod write;

pub use array::{Array, Numbers};
pub(crate) use read::read;
pub(crate) use write::write;
