//! Arrays for numpy, made of slices.

use mesh_io::{Array, Numbers};

/// Integers in rows of so many; with one, an array of one dimension.
pub(crate) fn ints<'a>(name: &str, width: usize, values: &[u32]) -> Array<'a> {
    let numbers: Vec<i64> = values.iter().copied().map(i64::from).collect();
    Array { name: name.to_owned(), shape: shape(values.len(), width), values: Numbers::Int(numbers.into()) }
}

/// The same of integers that may be negative.
pub(crate) fn int64<'a>(name: &str, width: usize, values: &'a [i64]) -> Array<'a> {
    Array { name: name.to_owned(), shape: shape(values.len(), width), values: Numbers::Int(values.into()) }
}

/// The same of floating point numbers.
pub(crate) fn floats<'a>(name: &str, width: usize, values: &'a [f64]) -> Array<'a> {
    Array { name: name.to_owned(), shape: shape(values.len(), width), values: Numbers::Float(values.into()) }
}

/// The same of integers of 32 bits.
pub(crate) fn int32<'a>(name: &str, width: usize, values: &'a [i32]) -> Array<'a> {
    Array { name: name.to_owned(), shape: shape(values.len(), width), values: Numbers::Int32(values.into()) }
}

/// A single number.
pub(crate) fn one<'a>(name: &str, value: f64) -> Array<'a> {
    Array { name: name.to_owned(), shape: Vec::new(), values: Numbers::Float(vec![value].into()) }
}

fn shape(n: usize, width: usize) -> Vec<usize> {
    if width == 1 { vec![n] } else { vec![n / width, width] }
}
