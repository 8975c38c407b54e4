//! [`Coefficients`]: the numbers of a level, as they are or quantised.

/// Numbers of a level: floating point, or integers and the step between them.
#[derive(Clone, Debug, PartialEq)]
pub enum Coefficients {
    /// As they are.
    Exact(Vec<f64>),
    /// Multiples of a step.
    Quantised {
        /// Each number over the step, rounded.
        multiples: Vec<i32>,
        /// The step, 0 or more. 0 where all numbers are 0.
        step: f64,
    },
}

impl Coefficients {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Exact(values) => values.len(),
            Self::Quantised { multiples, .. } => multiples.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The numbers, each the product of its multiple and the step where they are quantised.
    pub fn values(&self) -> Vec<f64> {
        match self {
            Self::Exact(values) => values.clone(),
            Self::Quantised { multiples, step } => multiples.iter().map(|&m| f64::from(m) * step).collect(),
        }
    }

    /// Numbers as they are, or rounded to the `2^bits - 1` multiples of a step from minus to plus the greatest magnitude of them. Zero is one
    /// of these, and no number is off by more than half a step.
    pub(crate) fn new(values: Vec<f64>, bits: Option<u8>) -> Self {
        let Some(bits) = bits else { return Self::Exact(values) };
        let greatest = values.iter().fold(0.0, |greatest: f64, value| greatest.max(value.abs()));
        let step = greatest / f64::from((1_i32 << (bits - 1)) - 1);
        // Without a step all numbers are 0, or so small that they are rounded to it.
        let multiple = |value: &f64| if step > 0.0 { (value / step).round() as i32 } else { 0 };
        Self::Quantised { multiples: values.iter().map(multiple).collect(), step }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_keeps_zero_and_both_ends() {
        let values = vec![-1.0, -0.3, 0.0, 0.1, 0.9, 1.0];
        for bits in 2..=24 {
            let quantised = Coefficients::new(values.clone(), Some(bits));
            let Coefficients::Quantised { multiples, step } = &quantised else { panic!("not quantised") };
            let most = (1 << (bits - 1)) - 1;
            assert_eq!((multiples[0], multiples[2], multiples[5]), (-most, 0, most), "{bits} bits");
            let off = quantised.values().iter().zip(&values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= step / 2.0 * (1.0 + 1e-12), "{bits} bits: {off}");
        }
    }

    #[test]
    fn all_zero_and_tiny_numbers_become_zero() {
        for values in [vec![], vec![0.0; 3], vec![5e-324, -5e-324]] {
            let n = values.len();
            assert_eq!(Coefficients::new(values, Some(8)).values(), vec![0.0; n]);
        }
    }
}
