//! Whatever the arguments are, there is a result or an error.

use fit::{FitOptions, fit_holding};
use mesh_core::FaceId;
use odd_arguments::{damaged, id, value};
use proptest::prelude::*;
use region_map::{Domain, Surface};

/// Options of which most are within their ranges.
fn options() -> impl Strategy<Value = FitOptions> {
    let share = || prop_oneof![4 => 0.0..1.0, 1 => value()];
    let rounds = || prop_oneof![8 => 0..3usize, 1 => Just(usize::MAX)];
    (rounds(), rounds(), share(), share(), share(), share()).prop_map(
        |(slides, rises, reach, quality_loss, mean_quality_loss, least_gain)| FitOptions {
            slides,
            rises,
            reach,
            quality_loss,
            mean_quality_loss,
            least_gain,
        },
    )
}

proptest! {
    #[test]
    fn fitting_gives_a_result_or_an_error(
        kind in 0..16u32,
        i in id(),
        value in value(),
        options in options(),
        still in prop::collection::vec(id(), 0..4),
    ) {
        let surface = Surface::with_creases(fixtures::cylinder(1.0, 1.0, 8), 40.0).unwrap();
        let domain = damaged(&Domain::identity(&surface), kind, i, value, fixtures::plane());
        let still: Vec<_> = still.into_iter().map(FaceId).collect();
        if let Ok(fitted) = fit_holding(&surface, &domain, &still, &options) {
            fitted.domain.check(surface.network()).unwrap();
            prop_assert!(fitted.report.end.max <= fitted.report.start.max);
        }
    }
}
