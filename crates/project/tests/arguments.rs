//! Whatever the arguments are, there is a result or an error.

use odd_arguments::{damaged, id, value};
use project::{ProjectOptions, project};
use proptest::prelude::*;
use region_map::{Domain, Surface};

proptest! {
    #[test]
    fn projecting_gives_a_result_or_an_error(kind in 0..12u32, i in id(), value in value(), ray_reach in value()) {
        let surface = Surface::with_creases(fixtures::cylinder(1.0, 1.0, 8), 40.0).unwrap();
        let domain = damaged(&Domain::identity(&surface), kind, i, value, fixtures::plane());
        if let Ok(projected) = project(&surface, &domain, None, &ProjectOptions { ray_reach }) {
            projected.domain.check(surface.network()).unwrap();
        }
    }
}
