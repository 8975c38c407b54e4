//! How to search.

use crate::ReconnectError;
use relax::ShapeOptions;

/// How to search.
#[derive(Clone, Debug, PartialEq)]
pub struct ReconnectOptions {
    /// The energy, and the steps that an edit is tried with. Default that of [`ShapeOptions`] with 10 untangling steps and 4
    /// others.
    pub shape: ShapeOptions,
    /// Rings of base faces round the vertices of an edit that are relaxed with it, 1 to 16. Default 2: with 1 fandisk ends at a
    /// mean AR lower by .005, with 3 higher by .002.
    pub rings: usize,
    /// What a flip must gain, in energies of equilateral triangles of the first subdivision, 0 or more. Default 0.05.
    pub least_gain: f64,
    /// What taking a vertex away and putting one in elsewhere must gain, 0 or more. Default 1: below it casting began to lose
    /// parts that the first subdivision does not show (with 0.5 and more tries it failed); fandisk gains .004 of mean AR with
    /// 0.2.
    pub least_exchange_gain: f64,
    /// Tries at most, for each base edge. Default 8.
    pub tries: usize,
}

impl Default for ReconnectOptions {
    fn default() -> Self {
        let shape = ShapeOptions { untangling_steps: 10, steps: 4, ..ShapeOptions::default() };
        Self { shape, rings: 2, least_gain: 0.05, least_exchange_gain: 1.0, tries: 8 }
    }
}

impl ReconnectOptions {
    /// Fails for the first option that is out of its range.
    pub fn check(&self) -> Result<(), ReconnectError> {
        self.shape.check()?;
        in_range("rings", self.rings as f64, [1.0, 16.0])?;
        in_range("least_gain", self.least_gain, [0.0, f64::INFINITY])?;
        in_range("least_exchange_gain", self.least_exchange_gain, [0.0, f64::INFINITY])
    }
}

fn in_range(name: &'static str, value: f64, [least, most]: [f64; 2]) -> Result<(), ReconnectError> {
    // Not so for NaN either.
    if least <= value && value <= most { Ok(()) } else { Err(ReconnectError::Option { name, value, least, most }) }
}
