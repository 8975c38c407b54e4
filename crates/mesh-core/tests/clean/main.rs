//! Every defect as a small case with a known answer, then random soups.

mod layers;

use glam::DVec3;
use mesh_core::{CleanError, CleanOptions, CleanReport, Cleaned, FaceId, Soup, TriMesh, VertexId, area, clean, exact, inspect};
use proptest::prelude::*;

fn soup(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Soup {
    Soup { positions: positions.iter().map(|&p| p.into()).collect(), triangles: triangles.to_vec() }
}

/// Cleans, and checks what holds for every result.
fn cleaned(soup: &Soup) -> Cleaned {
    let cleaned = clean(soup, &CleanOptions::default()).unwrap();
    check(soup, &cleaned);
    cleaned
}

fn check(soup: &Soup, cleaned: &Cleaned) {
    let Cleaned { mesh, source_face, source_vertex, report, .. } = cleaned;
    assert_eq!((source_face.len(), source_vertex.len()), (mesh.n_faces(), mesh.n_vertices()));
    let moved = source_vertex.enumerate().filter(|&(v, &s)| mesh.position(v) != soup.positions[s as usize]);
    assert!(moved.count() <= report.split_edges, "only vertices in the middle of edges are new");
    let mut used = vec![false; mesh.n_vertices()];
    for &v in mesh.faces().iter().flatten() {
        used[v.0 as usize] = true;
    }
    assert!(used.iter().all(|&u| u), "all vertices are used");
    // A face without flip or split has the corners of its source.
    if report.zero_area_flipped + report.split_edges == 0 {
        for f in mesh.faces().ids() {
            let mut source = soup.triangles[source_face[f] as usize].map(|v| soup.positions[v as usize].to_array());
            let mut face = mesh.triangle(f).map(|p| p.to_array());
            source.sort_by(|a, b| a.partial_cmp(b).unwrap());
            face.sort_by(|a, b| a.partial_cmp(b).unwrap());
            assert_eq!(source, face);
        }
    }
    let flat = mesh.faces().ids().filter(|&f| {
        let [a, b, c] = mesh.triangle(f);
        exact::collinear(a, b, c)
    });
    assert_eq!(flat.count(), 0);
}

fn volume(mesh: &TriMesh) -> f64 {
    let six = mesh.faces().ids().map(|f| {
        let [a, b, c] = mesh.triangle(f);
        a.dot(b.cross(c))
    });
    six.sum::<f64>() / 6.0
}

fn n_components(cleaned: &Cleaned) -> usize {
    cleaned.topology.components().1
}

fn n_loops(cleaned: &Cleaned) -> usize {
    cleaned.topology.border_loops().len()
}

/// (0, 0, 0), x, y, z, facing outwards.
const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
const CORNERS: [[f64; 3]; 5] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];

/// A wavy square of 2 n^2 triangles.
fn sheet(n: u32) -> Soup {
    let share = |i: u32| f64::from(i) / f64::from(n);
    let positions = (0..=n).flat_map(|i| (0..=n).map(move |j| (share(i), share(j))));
    let positions = positions.map(|(x, y)| DVec3::new(x, y, 0.1 * (5.0 * x).sin() * y)).collect();
    let id = |i: u32, j: u32| i * (n + 1) + j;
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = squares
        .flat_map(|(i, j)| [[id(i, j), id(i + 1, j), id(i + 1, j + 1)], [id(i, j), id(i + 1, j + 1), id(i, j + 1)]])
        .collect();
    Soup { positions, triangles }
}

/// A ring of `n` squares that joins up after `twists` half turns.
fn ring(n: u32, twists: u32) -> Soup {
    let at = |i: u32, side: f64| {
        let turn = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        let tilt = 0.5 * f64::from(twists) * turn;
        let out = DVec3::new(turn.cos(), turn.sin(), 0.0);
        3.0 * out + side * (tilt.cos() * out + tilt.sin() * DVec3::Z)
    };
    let positions = (0..n).flat_map(|i| [at(i, -1.0), at(i, 1.0)]).collect();
    let triangles = (0..n).flat_map(|i| {
        let [a, b] = [2 * i, 2 * i + 1];
        let [c, d] = match (i + 1 == n, twists % 2) {
            (false, _) => [2 * i + 2, 2 * i + 3],
            (true, 0) => [0, 1],
            (true, _) => [1, 0],
        };
        [[a, c, d], [a, d, b]]
    });
    Soup { positions, triangles: triangles.collect() }
}

/// All sides of the given cells of a grid of cubes, facing outwards; `walls` keeps those between two cells (twice).
fn voxels(cells: &[[i32; 3]], walls: bool) -> Soup {
    let mut soup = Soup::default();
    for &cell in cells {
        for axis in 0..3 {
            for side in 0..2 {
                let mut next = cell;
                next[axis] += 2 * side - 1;
                if !walls && cells.contains(&next) {
                    continue;
                }
                let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
                let first = soup.positions.len() as u32;
                for (i, j) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                    let mut p = cell;
                    (p[axis], p[u], p[v]) = (p[axis] + side, p[u] + i, p[v] + j);
                    soup.positions.push(DVec3::from_array(p.map(f64::from)));
                }
                // The diagonal of a wall is the same from both cells.
                let halves = if side == 1 { [[0, 1, 2], [0, 2, 3]] } else { [[0, 2, 1], [0, 3, 2]] };
                soup.triangles.extend(halves.map(|h| h.map(|k| first + k)));
            }
        }
    }
    soup
}

#[test]
fn a_clean_mesh_comes_back_as_it_was() {
    for soup in [sheet(5), ring(9, 0), ring(9, 2), soup(&CORNERS[..4], &TETRAHEDRON)] {
        let cleaned = cleaned(&soup);
        assert_eq!(cleaned.mesh.to_soup(), soup);
        assert_eq!(cleaned.report, CleanReport::default());
    }
}

#[test]
fn unusable_triangles_are_dropped_and_counted() {
    let mut broken = soup(&CORNERS, &TETRAHEDRON);
    broken.positions[4].y = f64::NAN;
    broken.triangles.insert(0, [0, 1, 9]);
    broken.triangles.insert(2, [0, 4, 1]);
    broken.triangles.insert(4, [2, 2, 1]);
    let cleaned = cleaned(&broken);
    assert_eq!(cleaned.mesh.to_soup(), soup(&CORNERS[..4], &TETRAHEDRON));
    assert_eq!(cleaned.source_face.as_slice(), [1, 3, 5, 6]);
    let expected = CleanReport { bad_index: 1, not_finite: 1, collapsed: 1, unused_vertices: 1, ..CleanReport::default() };
    assert_eq!(cleaned.report, expected);
}

#[test]
fn without_a_face_the_error_says_why() {
    let nothing = soup(&CORNERS, &[[0, 1, 7], [2, 2, 1], [0, 1, 1]]);
    let expected = CleanError::NothingLeft { triangles: 3, bad_index: 1, not_finite: 0, without_area: 2 };
    assert_eq!(clean(&nothing, &CleanOptions::default()).unwrap_err(), expected);
    assert!(clean(&Soup::default(), &CleanOptions::default()).is_err());
    let line = soup(&[[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]], &TETRAHEDRON);
    assert!(clean(&line, &CleanOptions::default()).is_err());
}

#[test]
fn equal_positions_are_merged() {
    let mut cube = voxels(&[[0, 0, 0]], false);
    for p in cube.positions.iter_mut().step_by(2) {
        *p = DVec3::from_array(p.to_array().map(|x| if x == 0.0 { -0.0 } else { x }));
    }
    let cleaned = cleaned(&cube);
    assert_eq!((cleaned.mesh.n_vertices(), cleaned.report.merged_exactly), (8, 16));
    assert_eq!((n_loops(&cleaned), volume(&cleaned.mesh)), (0, 1.0));
}

#[test]
fn cracks_close_within_the_tolerance() {
    let mut cube = voxels(&[[0, 0, 0]], false);
    for (i, p) in cube.positions.iter_mut().enumerate() {
        *p += 1e-5 * DVec3::new((i as f64).sin(), (2.0 * i as f64).sin(), (3.0 * i as f64).sin());
    }
    assert_eq!(n_components(&cleaned(&cube)), 6);
    let closed = clean(&cube, &CleanOptions { weld_tolerance: 1e-4 }).unwrap();
    assert_eq!((closed.mesh.n_vertices(), closed.report.merged_by_tolerance, n_loops(&closed)), (8, 16, 0));
}

#[test]
fn cracks_of_rounding_are_closed() {
    let mut cube = voxels(&[[0, 0, 0]], false);
    for (i, p) in cube.positions.iter_mut().enumerate() {
        *p = (*p / 3.0 + 1e-8 * (i as f64).sin()).as_vec3().as_dvec3();
    }
    let closed = clean(&cube, &CleanOptions::default()).unwrap();
    assert_eq!((closed.mesh.n_vertices(), n_loops(&closed)), (8, 0));
    assert_eq!(closed.report.merged_exactly + closed.report.merged_by_tolerance, 16);
    let open = clean(&cube, &CleanOptions { weld_tolerance: 0.0 }).unwrap();
    assert!(n_loops(&open) > 0);
}

#[test]
fn what_is_no_border_is_not_merged() {
    // Two corners of a closed tetrahedron are as near as rounding.
    let mut positions = CORNERS;
    positions[1] = [1e-8, 0.0, 0.0];
    let closed = cleaned(&soup(&positions, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]));
    assert_eq!((closed.mesh.n_vertices(), closed.report.merged_by_tolerance), (4, 0));
}

#[test]
fn a_cap_in_a_t_junction_is_flipped() {
    // Edge 1-2 has its middle, vertex 4, in one of its faces; the gap to the other one is a face without area.
    let mut positions = CORNERS;
    positions[4] = [0.5, 0.5, 0.0];
    let faces = [[0, 2, 4], [0, 4, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3], [1, 4, 2]];
    let cleaned = cleaned(&soup(&positions, &faces));
    assert_eq!((cleaned.report.zero_area_flipped, n_loops(&cleaned), cleaned.mesh.n_faces()), (1, 0, 6));
    assert!((volume(&cleaned.mesh) - 1.0 / 6.0).abs() < 1e-15);
    assert_eq!(cleaned.source_face.as_slice(), [0, 1, 2, 3, 4, 4]);
}

#[test]
fn flips_end_where_products_underflow() {
    // Found by fuzzing: edges were flipped to and fro for ever.
    let positions = [
        [4.9e-311, 6.97e-309, 1.67e-308],
        [1.85e-310, 2.5e-308, 5.28e-308],
        [4.2e-140, 3.13e-294, 4.24e-313],
        [1.03e-310, 1.9e-310, 2.92e-308],
        [8.06e-313, 2.06e-310, 3.06e-308],
        [1.91e-313, 1.25e-310, 2.12e-310],
        [9.34e-313, 2.5e-310, 8.36e-309],
        [8.34e-308, 1.73e-77, 3.13e-294],
        [1.04e-312, 6.37e-314, 2.66e-310],
    ];
    let faces = [[0, 2, 1], [0, 3, 2], [1, 2, 6], [2, 3, 7], [2, 7, 6], [3, 8, 7], [4, 7, 8], [4, 5, 7], [5, 6, 7]];
    let _ = clean(&soup(&positions, &faces), &CleanOptions::default());
}

#[test]
fn the_middle_of_a_split_edge_may_be_dropped_again() {
    // Found by fuzzing: the number of vertex copies was one below 0.
    let mut positions = [[0.0; 3]; 20];
    let lone = [(3, 1.7e-313), (4, 1.0), (11, 3e-241), (15, 1.0), (16, 5.3e-308), (18, 1.0)];
    lone.iter().for_each(|&(v, z): &(usize, f64)| positions[v][2] = z);
    positions[19][1] = 1.0;
    let mut faces = vec![[1, 3, 2], [1, 4, 3], [0, 5, 4], [1, 0, 4], [2, 3, 9], [3, 4, 10], [3, 10, 9], [4, 5, 11], [4, 11, 10]];
    faces.extend([[5, 6, 12], [5, 12, 11], [6, 13, 12], [7, 8, 15], [7, 15, 14], [8, 16, 15], [10, 11, 16], [11, 15, 16]]);
    faces.extend([[11, 12, 15], [12, 14, 15], [12, 13, 14], [17, 18, 19]]);
    let report = cleaned(&soup(&positions, &faces)).report;
    assert_eq!((report.split_edges, report.vertex_copies), (1, 0));
}

#[test]
fn at_a_border_a_face_without_area_is_dropped() {
    let positions = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    let cleaned = cleaned(&soup(&positions, &[[0, 1, 2], [0, 2, 3], [2, 1, 3]]));
    assert_eq!((cleaned.report.zero_area_dropped, cleaned.mesh.n_faces(), n_loops(&cleaned)), (1, 2, 1));
}

#[test]
fn hundreds_of_parts_stay_apart_and_in_order() {
    let crowd: Vec<[i32; 3]> = (0..600).map(|k| [2 * (k % 10), 2 * (k / 10 % 10), 2 * (k / 100)]).collect();
    let cleaned = cleaned(&voxels(&crowd, false));
    assert_eq!((n_components(&cleaned), n_loops(&cleaned), volume(&cleaned.mesh)), (600, 0, 600.0));
    assert!(cleaned.source_face.iter().is_sorted());
}

#[test]
fn solids_that_touch_stay_closed() {
    let cases: [(&[[i32; 3]], usize); 4] = [
        (&[[0, 0, 0], [1, 1, 1]], 2),
        (&[[0, 0, 0], [1, 1, 0]], 2),
        (&[[0, 0, 0], [1, 1, 0], [0, 1, 1], [1, 0, 1]], 4),
        // One solid that touches itself along an edge.
        (&[[0, 0, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1]], 1),
    ];
    for (cells, components) in cases {
        let cleaned = cleaned(&voxels(cells, false));
        assert_eq!((n_components(&cleaned), n_loops(&cleaned)), (components, 0), "{cells:?}");
        assert_eq!(volume(&cleaned.mesh), cells.len() as f64);
        assert!(cleaned.topology.genus() == 0 && cleaned.report.leaf_cuts == 0);
    }
}

#[test]
fn a_wall_on_a_surface_is_cut_off() {
    let mut book = sheet(4);
    let top = book.positions.len() as u32;
    let [a, b] = [7, 12];
    book.positions.push(book.positions[a as usize] + DVec3::Z);
    book.triangles.push([a, b, top]);
    let cleaned = cleaned(&book);
    assert_eq!((n_components(&cleaned), n_loops(&cleaned)), (2, 2));
    assert_eq!((cleaned.report.non_manifold_edges, cleaned.report.leaf_cuts, cleaned.report.vertex_copies), (1, 1, 2));
    assert_eq!(cleaned.mesh.n_faces(), book.triangles.len());
}

#[test]
fn fans_that_meet_in_a_vertex_are_parted() {
    let bow_tie = soup(&CORNERS, &[[0, 1, 2], [0, 3, 4]]);
    let cleaned = cleaned(&bow_tie);
    assert_eq!((cleaned.mesh.n_vertices(), cleaned.report.vertex_copies), (6, 1));
    assert_eq!(cleaned.source_vertex.as_slice(), [0, 0, 1, 2, 3, 4]);
    assert_eq!(cleaned.mesh.position(VertexId(0)), cleaned.mesh.position(VertexId(1)));
}

#[test]
fn faces_are_turned_to_agree() {
    // Closed: outwards. Open: as most of them are.
    let mut cube = voxels(&[[0, 0, 0]], false);
    for f in [0, 3, 4, 5, 7, 8, 9, 11] {
        cube.triangles[f].swap(0, 1);
    }
    let turned = cleaned(&cube);
    assert_eq!((volume(&turned.mesh), turned.report.turned, n_loops(&turned)), (1.0, 8, 0));
    let mut open = sheet(3);
    for f in [0, 5, 6] {
        open.triangles[f].swap(1, 2);
    }
    let turned = cleaned(&open);
    assert_eq!(turned.report.turned, 3);
    assert!(turned.mesh.normals().iter().all(|n| n.z > 0.0));
    // What agrees stays, even inside out.
    let inside_out = soup(&CORNERS[..4], &TETRAHEDRON.map(|[a, b, c]| [a, c, b]));
    assert_eq!(cleaned(&inside_out).report, CleanReport::default());
}

#[test]
fn a_one_sided_strip_is_cut_once() {
    for twists in [1, 3] {
        let strip = cleaned(&ring(12, twists));
        assert_eq!((n_components(&strip), n_loops(&strip), strip.topology.euler()), (1, 1, 1));
        assert_eq!((strip.report.orientation_cuts, strip.report.vertex_copies), (1, 2));
        assert_eq!(strip.mesh.n_faces(), 24);
    }
}

#[test]
fn a_klein_bottle_becomes_orientable() {
    // A torus grid, glued with a flip along one side.
    let n = 6;
    let id = |i: u32, j: u32| if i < n { i * n + j % n } else { (n - j % n) % n };
    let positions: Vec<_> = (0..n * n).map(|k| DVec3::new(f64::from(k / n), f64::from(k % n), f64::from(k).sin())).collect();
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = squares
        .flat_map(|(i, j)| [[id(i, j), id(i + 1, j), id(i + 1, j + 1)], [id(i, j), id(i + 1, j + 1), id(i, j + 1)]])
        .collect();
    let cut = cleaned(&Soup { positions, triangles });
    assert!(cut.report.orientation_cuts >= 3 && n_loops(&cut) >= 1);
    assert_eq!((cut.mesh.n_faces(), n_components(&cut)), (2 * (n * n) as usize, 1));
}

#[test]
fn counts_of_what_was_read() {
    let mut soup = voxels(&[[0, 0, 0], [1, 1, 0]], false);
    soup.triangles.push([0, 0, 1]);
    soup.triangles.push([0, 1, 999]);
    let seen = inspect(&soup);
    assert_eq!((seen.vertices, seen.merged_vertices, seen.triangles), (48, 14, 26));
    assert_eq!((seen.components, seen.boundary_loops, seen.genus), (1, 0, None));
    assert_eq!((seen.non_manifold_edges, seen.non_manifold_vertices), (1, 2));
    assert_eq!((seen.zero_area, seen.bad_index, seen.repeated, seen.inconsistent_edges), (1, 1, 0, 0));
    let frame: Vec<[i32; 3]> = (0..9).filter(|&k| k != 4).map(|k| [k % 3, k / 3, 0]).collect();
    let seen = inspect(&voxels(&frame, false));
    assert_eq!((seen.genus, seen.components, seen.non_manifold_vertices), (Some(1), 1, 0));
    let strip = inspect(&ring(12, 1));
    assert_eq!((strip.inconsistent_edges, strip.genus, strip.boundary_loops), (1, None, 1));
    let bow_tie = inspect(&self::soup(&CORNERS, &[[0, 1, 2], [0, 3, 4], [0, 4, 3]]));
    assert_eq!((bow_tie.components, bow_tie.non_manifold_vertices, bow_tie.repeated), (1, 1, 1));
}

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
        if let Ok(cleaned) = clean(&soup, &CleanOptions { weld_tolerance: share }) {
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
        // Copies of vertices are merged again.
        if once.report.vertex_copies > 0 {
            return Ok(());
        }
        let twice = clean(&once.mesh.to_soup(), &CleanOptions::default()).unwrap();
        prop_assert_eq!(once.mesh, twice.mesh);
        prop_assert_eq!(twice.report, CleanReport::default());
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

#[test]
fn source_faces_name_triangles_of_the_soup() {
    let cleaned = cleaned(&voxels(&[[0, 0, 0], [1, 0, 0]], true));
    assert_eq!(cleaned.source_face.as_slice(), (0..24).collect::<Vec<_>>());
    assert_eq!(cleaned.mesh.face(FaceId(0)).len(), 3);
}
