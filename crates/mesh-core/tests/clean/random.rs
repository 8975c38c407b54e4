//! Random soups, and solids of cubes.

use crate::shapes::{check, cleaned, n_components, n_loops, volume, voxels};
use glam::DVec3;
use mesh_core::{CleanOptions, CleanReport, Cleaned, Soup, TriMesh, area, clean, inspect};
use proptest::prelude::*;

/// Few positions, some equal, many on lines, some not finite; triangles at random, some out of range.
fn any_soup() -> impl Strategy<Value = Soup> {
    let coordinate = prop_oneof![
        20 => (-1i8..=1).prop_map(f64::from),
        10 => -1.0..1.0,
        1 => Just(-0.0),
        1 => prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(1e300)],
    ];
    let positions = prop::collection::vec(prop::array::uniform3(coordinate).prop_map(DVec3::from_array), 3..16);
    let triangles = prop::collection::vec(prop::array::uniform3(0u32..17), 1..60);
    (positions, triangles).prop_map(|(positions, triangles)| {
        let n = positions.len() as u32 + 1;
        Soup { triangles: triangles.into_iter().map(|t| t.map(|v| v % n)).collect(), positions }
    })
}

fn cells() -> impl Strategy<Value = Vec<[i32; 3]>> {
    prop::collection::vec(any::<bool>(), 27).prop_map(|filled| {
        let all = (0..27).map(|k| [k % 3, k / 3 % 3, k / 9]);
        all.zip(filled).filter(|&(_, f)| f).map(|(c, _)| c).collect()
    })
}

fn neighbours([x, y, z]: [i32; 3]) -> [[i32; 3]; 6] {
    [[x - 1, y, z], [x + 1, y, z], [x, y - 1, z], [x, y + 1, z], [x, y, z - 1], [x, y, z + 1]]
}

proptest! {
    #[test]
    fn any_soup_becomes_manifold_or_is_refused(soup in any_soup()) {
        let Ok(cleaned) = clean(&soup, &CleanOptions::default()) else { return Ok(()) };
        check(&soup, &cleaned);
        let after = inspect(&cleaned.mesh.to_soup());
        prop_assert_eq!((after.bad_index, after.not_finite), (0, 0));
    }

    #[test]
    fn with_any_tolerance_too(soup in any_soup(), share in prop_oneof![Just(0.0), Just(1e-300), Just(1e-18), Just(1e-15), Just(f64::NAN), 0.0..2.0]) {
        if let Ok(cleaned) = clean(&soup, &CleanOptions { weld_tolerance: share, ..CleanOptions::default() }) {
            prop_assert!(cleaned.mesh.n_faces() > 0);
        }
    }

    #[test]
    fn the_numbering_of_vertices_does_not_matter(soup in any_soup()) {
        // Numbered backwards, all the same triangles.
        let last = soup.positions.len() as u32 - 1;
        let mirror = Soup {
            positions: soup.positions.iter().rev().copied().collect(),
            triangles: soup.triangles.iter().map(|t| t.map(|v| last.checked_sub(v).unwrap_or(v))).collect(),
        };
        let [a, b] = [soup, mirror].map(|s| clean(&s, &CleanOptions::default()).ok());
        let shape = |c: &Cleaned| c.mesh.faces().ids().map(|f| c.mesh.triangle(f)).collect::<Vec<_>>();
        prop_assert_eq!(a.as_ref().map(shape), b.as_ref().map(shape));
        prop_assert_eq!(a.map(|c| c.report), b.map(|c| c.report));
    }

    #[test]
    fn cleaning_twice_is_cleaning_once(soup in any_soup()) {
        let Ok(once) = clean(&soup, &CleanOptions::default()) else { return Ok(()) };
        // Vertices in one place are merged again: copies, and middles of edges that were split on both sides of a cut.
        let mut places: Vec<_> = once.mesh.positions().iter().map(|p| (p + DVec3::ZERO).to_array().map(f64::to_bits)).collect();
        places.sort_unstable();
        if places.windows(2).any(|pair| pair[0] == pair[1]) {
            return Ok(());
        }
        let twice = clean(&once.mesh.to_soup(), &CleanOptions::default()).unwrap();
        prop_assert_eq!(once.mesh, twice.mesh);
        // T-vertices stay, and are told of each time. They are looked for before repeated triangles go: the edge of one may be a border only the second time.
        prop_assert_eq!(CleanReport { open_t_vertices: 0, ..twice.report }, CleanReport::default());
    }

    #[test]
    fn solids_of_cubes_stay_closed(cells in cells()) {
        prop_assume!(!cells.is_empty());
        let cleaned = cleaned(&voxels(&cells, false));
        prop_assert_eq!(n_loops(&cleaned), 0);
        prop_assert!((volume(&cleaned.mesh) - cells.len() as f64).abs() < 1e-9);
        prop_assert_eq!(cleaned.report.turned + cleaned.report.leaf_cuts, 0);
        let area_of = |m: &TriMesh| m.faces().ids().map(|f| area(m.triangle(f))).sum::<f64>();
        let faces = cells.iter().flat_map(|&c| neighbours(c)).filter(|n| !cells.contains(n)).count();
        prop_assert!((area_of(&cleaned.mesh) - faces as f64).abs() < 1e-9);
    }

    #[test]
    fn cubes_with_common_walls_stay_cubes(cells in cells()) {
        prop_assume!(!cells.is_empty());
        let cleaned = cleaned(&voxels(&cells, true));
        prop_assert_eq!(n_loops(&cleaned), 0);
        // The one in the middle goes when it is walled in: all its sides are sides of others.
        let walled_in = cells.contains(&[1, 1, 1]) && neighbours([1, 1, 1]).iter().all(|n| cells.contains(n));
        let cubes = cells.len() - usize::from(walled_in);
        prop_assert_eq!(n_components(&cleaned), cubes);
        prop_assert!((volume(&cleaned.mesh) - cubes as f64).abs() < 1e-9);
        prop_assert_eq!(cleaned.topology.genus(), 0);
    }

    #[test]
    fn turned_faces_of_a_solid_turn_back(
        steps in prop::collection::vec(0usize..3, 0..12),
        turned in prop::collection::vec(any::<bool>(), 324),
    ) {
        // A staircase of cubes has no edge or vertex that is not manifold.
        let mut cells = vec![[0; 3]];
        for axis in steps {
            let mut next = cells[cells.len() - 1];
            next[axis] += 1;
            cells.push(next);
        }
        let mut soup = voxels(&cells, false);
        for (t, turn) in soup.triangles.iter_mut().zip(&turned) {
            if *turn {
                t.swap(0, 1);
            }
        }
        let cleaned = cleaned(&soup);
        let all = soup.triangles.len();
        let inside_out = turned[..all].iter().all(|&t| t);
        let sign = if inside_out { -1.0 } else { 1.0 };
        prop_assert_eq!((n_loops(&cleaned), n_components(&cleaned)), (0, 1));
        prop_assert!((volume(&cleaned.mesh) - sign * cells.len() as f64).abs() < 1e-9);
        let n_turned = if inside_out { 0 } else { turned[..all].iter().filter(|&&t| t).count() };
        prop_assert_eq!(cleaned.report.turned, n_turned);
    }
}
