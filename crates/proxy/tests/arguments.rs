//! Whatever the arguments are, there is a proxy, a domain or an error, and no panic.

use odd_arguments::{damaged, id, odd, shape, unit, value};
use proptest::prelude::*;
use proxy::{Proxy, ProxyOptions};
use region_map::{Domain, Sizing, Surface};

proptest! {
    #[test]
    fn a_proxy_is_a_surface_of_the_same_topology_or_an_error(
        which in 0..6usize,
        unit in unit(),
        faces in prop_oneof![Just(0), Just(1), Just(20), Just(usize::MAX)],
        longest_edge in odd(),
        distance in odd(),
        length in odd(),
    ) {
        let dense = Surface::with_creases(shape(which, unit), 40.0).unwrap();
        let mut sizing = Sizing::uniform(dense.mesh());
        sizing.relative.iter_mut().for_each(|relative| *relative = length);
        if let Ok(proxy) = Proxy::new(&dense, &sizing, &ProxyOptions { faces, longest_edge, distance }) {
            prop_assert_eq!(proxy.surface.topology().euler(), dense.topology().euler());
            prop_assert_eq!(proxy.surface.network().arcs.len(), dense.network().arcs.len());
            // Where areas are no numbers there may be no way back.
            match proxy.carried(&Domain::identity(&proxy.surface), &dense) {
                Ok(carried) => prop_assert!(carried.check(dense.network()).is_ok()),
                Err(e) => prop_assert!(unit != 1.0, "{}", e),
            }
        }
    }

    #[test]
    fn what_is_carried_fits_the_surface_or_is_an_error(kind in 0..12u32, i in id(), value in value()) {
        let dense = Surface::with_creases(fixtures::cylinder(1.0, 1.0, 24), 40.0).unwrap();
        let options = ProxyOptions { faces: 30, longest_edge: 9.0, distance: 9.0 };
        let proxy = Proxy::new(&dense, &Sizing::uniform(dense.mesh()), &options).unwrap();
        let domain = damaged(&Domain::identity(&proxy.surface), kind, i, value, fixtures::plane());
        if let Ok(carried) = proxy.carried(&domain, &dense) {
            prop_assert!(carried.check(dense.network()).is_ok());
        }
    }
}
