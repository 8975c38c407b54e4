//! Whatever the arguments are, there is a result or an error.

use odd_arguments::{damaged, id, value};
use project::{ProjectOptions, project, project_refined};
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

    #[test]
    fn projecting_a_finer_level_gives_a_result_or_an_error(kind in 0..12u32, of_coarse in any::<bool>(), i in id(), value in value()) {
        let surface = Surface::with_creases(fixtures::cylinder(1.0, 1.0, 8), 40.0).unwrap();
        let coarse = Domain::identity(&surface);
        let finer = subdiv::subdivide(&coarse, 1).unwrap().domain;
        let odd = |domain: &Domain| damaged(domain, kind, i, value, fixtures::plane());
        let [coarse, finer] = if of_coarse { [odd(&coarse), finer] } else { [coarse.clone(), odd(&finer)] };
        if let Ok(projected) = project_refined(&surface, &coarse, &finer) {
            projected.domain.check(surface.network()).unwrap();
        }
    }
}
