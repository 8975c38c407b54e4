//! [`Array`]: an array with a name.

use std::borrow::Cow;

/// An array with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Array<'a> {
    /// Its name: `numpy.load` gives it by that.
    pub name: String,
    /// Its size in each direction, the last one running fastest; empty for a single number.
    pub shape: Vec<usize>,
    /// Its values; as many as the product of the sizes.
    pub values: Numbers<'a>,
}

/// The values of an array.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers<'a> {
    /// 64-bit floating point (`float64`).
    Float(Cow<'a, [f64]>),
    /// 64-bit integers (`int64`).
    Int(Cow<'a, [i64]>),
    /// 32-bit integers (`int32`).
    Int32(Cow<'a, [i32]>),
}

impl Numbers<'_> {
    /// The type as numpy writes it.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Float(_) => FLOAT,
            Self::Int(_) => INT,
            Self::Int32(_) => INT32,
        }
    }
}

/// `float64`, little endian.
pub(super) const FLOAT: &str = "<f8";
/// `int64`, little endian.
pub(super) const INT: &str = "<i8";
/// `int32`, little endian.
pub(super) const INT32: &str = "<i4";
