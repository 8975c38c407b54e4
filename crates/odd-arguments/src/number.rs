//! Numbers.

use proptest::prelude::*;

/// Numbers that nobody thinks of.
pub fn value() -> impl Strategy<Value = f64> {
    prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, 0.3, 1e-300, 1e300, f64::MAX, f64::NAN, f64::INFINITY, f64::NEG_INFINITY])
}

/// Numbers that nobody means to hand in, and ordinary ones.
pub fn odd() -> impl Strategy<Value = f64> {
    let special = [0.0, -0.0, -1.0, 1.0, 1e-300, 1e300, f64::MAX, f64::MIN_POSITIVE, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    prop_oneof![prop::sample::select(special.to_vec()), 0.0..200.0f64, -1.0..2.0f64]
}

/// A unit of length, so that areas and volumes may be no numbers.
pub fn unit() -> impl Strategy<Value = f64> {
    prop_oneof![3 => Just(1.0), 1 => prop::sample::select(vec![1e-200, 1e-160, 1e-80, 1e80, 1e160, 1e300])]
}

/// Small numbers of something, and some that are none of anything.
pub fn id() -> impl Strategy<Value = u32> {
    prop_oneof![0..40u32, prop::sample::select(vec![1_000, 1 << 31, u32::MAX - 1, u32::MAX])]
}
