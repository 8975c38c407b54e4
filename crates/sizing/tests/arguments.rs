//! Whatever the options are, there is a field of lengths or an error, and no panic.

use odd_arguments::{odd, shape, unit};
use proptest::prelude::*;
use region_map::Surface;
use sizing::{SizingOptions, sizing};

#[test]
fn options_out_of_range_are_named() {
    let surface = Surface::smooth(fixtures::cube(1)).unwrap();
    let message = |options: SizingOptions| sizing(&surface, &options).unwrap_err().to_string();
    let fine = || SizingOptions::new(1.0);
    assert_eq!(message(SizingOptions::new(0.0)), "sizing option edge_length is 0, it must be finite and above 0");
    assert_eq!(message(SizingOptions { turn: -1.0, ..fine() }), "sizing option turn is -1, it must be above 0");
    assert_eq!(message(SizingOptions { neutral_turn: 0.0, ..fine() }), "sizing option neutral_turn is 0, it must be above 0");
    assert_eq!(message(SizingOptions { range: 0.9, ..fine() }), "sizing option range is 0.9, it must be finite and at least 1");
    assert_eq!(message(SizingOptions { least: 1.5, ..fine() }), "sizing option least is 1.5, it must be above 0 and at most 1");
    assert_eq!(message(SizingOptions { gradation: f64::NAN, ..fine() }), "sizing option gradation is NaN, it must be at least 0");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn nothing_panics(
        which in 0..6usize,
        unit in unit(),
        edge_length in odd(),
        turn in odd(),
        neutral_turn in odd(),
        range in prop_oneof![Just(1.2), odd()],
        least in prop_oneof![Just(0.5), odd()],
        gradation in odd(),
    ) {
        let surface = Surface::with_creases(shape(which, unit), 40.0).unwrap();
        let options = SizingOptions { edge_length, turn, neutral_turn, range, least, gradation };
        if let Ok(field) = sizing(&surface, &options) {
            prop_assert_eq!(field.relative.len(), surface.mesh().n_vertices());
            prop_assert!(field.relative.iter().all(|&h| h > 0.0 && h <= range), "{:?}", field);
        }
    }
}
