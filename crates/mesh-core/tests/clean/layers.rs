//! Triangles that lie on others: repeated ones, double sheets, needles, flaps.

use crate::shapes::{CORNERS, TETRAHEDRON, cleaned, n_components, n_loops, sheet, soup};
use glam::DVec3;

#[test]
fn of_equal_triangles_one_stays() {
    let mut twice = soup(&CORNERS[..4], &TETRAHEDRON);
    twice.triangles.extend([[2, 1, 0], [0, 1, 3], [1, 2, 3], [0, 3, 2]]);
    let cleaned = cleaned(&twice);
    assert_eq!((cleaned.report.repeated, cleaned.mesh.n_faces(), n_loops(&cleaned)), (4, 4, 0));
}

#[test]
fn of_a_double_sheet_one_side_stays() {
    for closed in [false, true] {
        let single = if closed { soup(&CORNERS[..4], &TETRAHEDRON) } else { sheet(4) };
        let mut double = single.clone();
        double.triangles.extend(single.triangles.iter().map(|&[a, b, c]| [a, c, b]));
        let cleaned = cleaned(&double);
        assert_eq!(cleaned.report.repeated, single.triangles.len());
        assert_eq!(cleaned.mesh.n_faces(), single.triangles.len());
        assert_eq!((n_components(&cleaned), n_loops(&cleaned)), (1, usize::from(!closed)));
    }
}

#[test]
fn repeated_triangles_leave_no_hole_and_no_stray_part() {
    // At the border, in the middle, and around a single triangle, which must still be oriented by its neighbours.
    let whole = sheet(4);
    let n = whole.triangles.len();
    for turned_copies in [vec![0], vec![15], (0..n).filter(|&f| f != 15).collect()] {
        let mut broken = whole.clone();
        broken.triangles[15].swap(0, 1);
        broken.triangles.extend(turned_copies.iter().map(|&f| whole.triangles[f]).map(|[a, b, c]| [a, c, b]));
        let cleaned = cleaned(&broken);
        assert_eq!((cleaned.mesh.n_faces(), n_components(&cleaned), n_loops(&cleaned)), (n, 1, 1));
        assert_eq!((cleaned.report.repeated, cleaned.report.turned), (turned_copies.len(), 1));
    }
}

#[test]
fn needles_on_an_edge_neither_part_the_surface_nor_stay() {
    // Not exactly on the edge, as rounded coordinates are: no sign says that they have no area.
    let whole = sheet(4);
    for first in [true, false] {
        for off in [0.0, 1e-9, -1e-9] {
            let mut broken = whole.clone();
            let [a, b, _] = whole.triangles[9];
            let [p, q] = [a, b].map(|v| whole.positions[v as usize]);
            broken.positions.push(p.lerp(q, 0.3) + off * DVec3::new(1.0, 2.0, 3.0));
            let needle = [a, b, whole.positions.len() as u32];
            broken.triangles.insert(if first { 0 } else { whole.triangles.len() }, needle);
            let cleaned = cleaned(&broken);
            assert_eq!(cleaned.mesh.to_soup(), whole);
            assert_eq!((cleaned.report.zero_area_dropped, cleaned.report.unused_vertices), (1, 1));
        }
    }
}

#[test]
fn a_folded_flap_goes() {
    let mut flap = soup(&CORNERS, &TETRAHEDRON);
    flap.triangles.extend([[0, 1, 4], [1, 0, 4]]);
    let cleaned = cleaned(&flap);
    assert_eq!(cleaned.mesh.to_soup(), soup(&CORNERS[..4], &TETRAHEDRON));
    assert_eq!((cleaned.report.flaps, cleaned.report.unused_vertices), (2, 1));
    let [a, b, tip] = [0, 1, 4].map(|v| flap.positions[v]);
    let longest = a.distance(b).max(b.distance(tip)).max(tip.distance(a));
    let width = (b - a).cross(tip - a).length() / longest;
    assert!((cleaned.report.flap_width - width).abs() < 1e-12, "{}", cleaned.report.flap_width);
}
