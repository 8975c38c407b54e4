//! Every defect as a small case with a known answer.

use crate::shapes::{CORNERS, TETRAHEDRON, check, cleaned, n_components, n_loops, ring, sheet, soup, volume, voxels};
use glam::DVec3;
use mesh_core::{CleanError, CleanOptions, CleanReport, Cleaned, FaceId, Interrupt, Soup, VertexId, clean, clean_until, inspect};

#[test]
fn a_clean_mesh_comes_back_as_it_was() {
    for soup in [sheet(5), ring(9, 0), ring(9, 2), soup(&CORNERS[..4], &TETRAHEDRON)] {
        let cleaned = cleaned(&soup);
        assert_eq!(cleaned.mesh.to_soup(), soup);
        assert_eq!(cleaned.report, CleanReport::default());
    }
}

#[test]
fn cleaning_that_is_interrupted_is_an_error() {
    let interrupt = Interrupt::default();
    let run = || clean_until(&sheet(5), &CleanOptions::default(), &interrupt);
    assert_eq!(run().unwrap().mesh.to_soup(), sheet(5));
    interrupt.set();
    assert_eq!(run().unwrap_err(), CleanError::Interrupted);
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
    let closed = clean(&cube, &CleanOptions { weld_tolerance: 1e-4, ..CleanOptions::default() }).unwrap();
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
    let open = clean(&cube, &CleanOptions { weld_tolerance: 0.0, ..CleanOptions::default() }).unwrap();
    assert!(n_loops(&open) > 0);
}

/// A cube whose top is in `n` by `n` squares: its sides have two triangles each, with none of the vertices between.
fn cube_with_fine_top(n: u32) -> Soup {
    let mut cube = voxels(&[[0, 0, 0]], false);
    cube.triangles.retain(|t| t.iter().any(|&v| cube.positions[v as usize].z == 0.0));
    let first = cube.positions.len() as u32;
    let at = |i: u32| f64::from(i) / f64::from(n);
    cube.positions.extend((0..=n).flat_map(|j| (0..=n).map(move |i| DVec3::new(at(i), at(j), 1.0))));
    let id = |i: u32, j: u32| first + j * (n + 1) + i;
    let quads = (0..n).flat_map(|j| (0..n).map(move |i| [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)]));
    cube.triangles.extend(quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]));
    cube
}

/// Cleaned with all invariants checked.
fn without_t_vertices(soup: &Soup) -> Cleaned {
    let cleaned = clean(soup, &CleanOptions { close_t_vertices: true, ..CleanOptions::default() }).unwrap();
    check(soup, &cleaned);
    cleaned
}

#[test]
fn t_vertices_are_closed_on_request() {
    for n in [2, 3, 7] {
        let as_it_is = cleaned(&cube_with_fine_top(n));
        assert_eq!((as_it_is.report.open_t_vertices, as_it_is.report.t_vertices), (4 * (n as usize - 1), 0));
        assert!(n_loops(&as_it_is) > 0);
        let closed = without_t_vertices(&cube_with_fine_top(n));
        assert_eq!((closed.report.t_vertices, n_components(&closed), n_loops(&closed)), (4 * (n as usize - 1), 1, 0));
        assert!((volume(&closed.mesh) - 1.0).abs() < 1e-12);
    }
}

/// One triangle with such vertices on all of its edges, those of three others.
#[test]
fn t_vertices_on_all_edges_of_a_triangle_are_closed() {
    let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let beyond = [[2.0, 2.0, 0.0], [-1.0, 1.0, 0.0], [1.0, -1.0, 0.0]];
    let faces = [[0, 1, 2], [1, 6, 3], [3, 6, 2], [2, 7, 4], [4, 7, 0], [0, 8, 5], [5, 8, 1]];
    let closed = without_t_vertices(&soup(&[&corners[..], &beyond[..]].concat(), &faces));
    assert_eq!((closed.report.t_vertices, closed.mesh.n_faces(), n_components(&closed), n_loops(&closed)), (3, 10, 1, 1));
}

/// T-vertices that stay are told of again when the clean mesh is cleaned, and nothing else is.
#[test]
fn open_t_vertices_are_told_of_each_time() {
    let corners = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 1.0, -1.0]];
    let once = cleaned(&soup(&corners, &[[2, 0, 3], [0, 2, 1], [0, 3, 1]]));
    let twice = cleaned(&once.mesh.to_soup());
    assert_eq!(once.mesh, twice.mesh);
    assert_eq!(twice.report, CleanReport { open_t_vertices: once.report.open_t_vertices, ..CleanReport::default() });
    assert!(once.report.open_t_vertices > 0);
}

/// A border that only comes near another one, or leaves it on the way, stays as it is.
#[test]
fn borders_that_do_not_run_along_each_other_stay() {
    let floor = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, -1.0, 0.0]];
    let touching = [[1.0, 0.0, 0.0], [1.5, 1.0, 0.0], [0.5, 1.0, 0.0]];
    let bent = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    let apart = without_t_vertices(&soup(&[&floor[..], &touching[..]].concat(), &[[0, 1, 2], [3, 4, 5]]));
    assert_eq!((apart.report.t_vertices, apart.mesh.n_faces()), (0, 2));
    let apart = without_t_vertices(&soup(&[&floor[..], &bent[..]].concat(), &[[0, 1, 2], [3, 4, 6], [4, 5, 6]]));
    assert_eq!((apart.report.t_vertices, apart.mesh.n_faces()), (0, 3));
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

#[test]
fn source_faces_name_triangles_of_the_soup() {
    let cleaned = cleaned(&voxels(&[[0, 0, 0], [1, 0, 0]], true));
    assert_eq!(cleaned.source_face.as_slice(), (0..24).collect::<Vec<_>>());
    assert_eq!(cleaned.mesh.face(FaceId(0)).len(), 3);
}

/// Two cubes that share a wall, as single triangles: the wall's vertices have a copy for each cube, and each triangle's own vertex
/// is one of the cube that it belongs to. A triangle out of range, a needle and a vertex of nothing are in no face.
#[test]
fn every_element_of_the_soup_has_its_own_or_none() {
    let mut soup = voxels(&[[0, 0, 0], [1, 0, 0]], true);
    let (n, free) = (soup.triangles.len(), soup.positions.len());
    soup.positions.extend([DVec3::splat(9.0), DVec3::NAN]);
    soup.triangles.extend([[0, 1, 99], [0, 1, 0], [0, 1, free as u32 + 1]]);
    let cleaned = cleaned(&soup);
    assert_eq!(n_components(&cleaned), 2);
    assert!(cleaned.face_of[..n].iter().all(Option::is_some) && cleaned.face_of[n..].iter().all(Option::is_none));
    assert_eq!(cleaned.vertex_of[free..], [None, None]);
    let (part, _) = cleaned.topology.components();
    for (t, face) in cleaned.face_of[..n].iter().enumerate() {
        let face = face.unwrap();
        let corners = soup.triangles[t].map(|v| cleaned.vertex_of[v as usize].unwrap());
        let of_corner = corners.map(|v| part[cleaned.topology.fan(v).next().unwrap().face()]);
        assert!(of_corner == [part[face]; 3], "triangle {t}");
    }
}
