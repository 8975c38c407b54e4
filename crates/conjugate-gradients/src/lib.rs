//! Preconditioned conjugate gradients (Hestenes and Stiefel, *Methods of conjugate gradients for solving linear systems*, 1952).
//!
//! [`solve`] asks for the rows of a symmetric positive matrix times a vector, never for the matrix. An unknown is a [`Vector`]: a
//! number, or the two or three coordinates of a vertex. The result has the same bytes on any number of threads.
//!
//! ```
//! use conjugate_gradients::solve;
//!
//! // A chain of ten links whose ends are held at 0: every inner one is pulled by 1, and held by both neighbours.
//! let n = 9;
//! let at = |x: &[f64], i: usize| x.get(i).copied().unwrap_or(0.0);
//! let row = |x: &[f64], i: usize| 2.0 * x[i] - at(x, i.wrapping_sub(1)) - at(x, i + 1);
//! let found = solve(vec![1.0; n], row, |r, _| 0.5 * r, 1e-12, 100);
//!
//! // A parabola.
//! let expected = (1..=n).map(|i| 0.5 * (i * (n + 1 - i)) as f64);
//! assert!(found.iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-9));
//! ```

mod solve;
mod vector;

pub use solve::solve;
pub use vector::Vector;
