//! What an unknown may be.

use glam::{DVec2, DVec3};
use std::ops::{Add, AddAssign, Mul};

/// One unknown of a system: a number, or some coordinates that belong together.
pub trait Vector: Copy + Send + Sync + Add<Output = Self> + AddAssign + Mul<f64, Output = Self> {
    /// All coordinates 0.
    const ZERO: Self;

    /// The sum of the products of the coordinates.
    fn dot(self, other: Self) -> f64;
}

impl Vector for f64 {
    const ZERO: Self = 0.0;

    fn dot(self, other: Self) -> f64 {
        self * other
    }
}

impl Vector for DVec2 {
    const ZERO: Self = DVec2::ZERO;

    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }
}

impl Vector for DVec3 {
    const ZERO: Self = DVec3::ZERO;

    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }
}
