//! Reading and writing off.

use crate::{check_refused, document, without_extras};
use glam::DVec3;
use mesh_io::Format::Off;

const BODY: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 2 1 0\n";

#[test]
fn plain() {
    let d = document(format!("OFF\n4 2 0\n{BODY}"), Off);
    assert_eq!(d.soup.positions, [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y]);
    assert_eq!(d.soup.triangles, [[0, 1, 2], [0, 2, 3], [2, 1, 0]]);
    assert_eq!((d.polygon_of, d.n_polygons_above_3), (vec![0, 0, 1], 1));
}

#[test]
fn layouts_that_files_have() {
    let plain = document(format!("OFF\n4 2 0\n{BODY}"), Off);
    let extra = "0 0 0 1 2 3\n1 0 0 1 2 3\n1 1 0 1 2 3\n0 1 0 1 2 3\n4 0 1 2 3 255 0 0\n3 2 1 0 0.5 0.5 0.5 1\n";
    let layouts = [
        format!("OFF 4 2 0\n{BODY}"),
        format!("OFF4 2 0\n{BODY}"),
        format!("4 2 5\n{BODY}"),
        format!("off\n4 2\n{BODY}"),
        format!("OFF # made by hand\n# a comment\n\n4 2 0 # counts\n\n{}", BODY.replace("1 0 0\n", "1 0 0 # second\n\n# gap\n")),
        format!("OFF\n4 2 0\n{BODY}").replace('\n', "\r\n"),
        format!("OFF\n4 2 0\n{}", BODY.trim_end()),
        format!("OFF\n4 2 0\n{BODY}and more"),
        format!("COFF\n4 2 0\n{extra}"),
        format!("NOFF\n4 2 0\n{extra}"),
        format!("STOFF\n4 2 0\n{extra}"),
        format!("STCNOFF 4 2 0\n{extra}"),
        format!("OFF\n4 2 0\n{extra}"),
    ];
    for text in layouts {
        assert_eq!(without_extras(document(&text, Off)), plain, "{text:?}");
    }
}

#[test]
fn bad_indices_and_numbers_that_are_not_finite_are_kept() {
    let d = document("OFF 3 2 0\nnan inf 0\n1 0 0\n0 1 0\n3 0 1 3\n3 -1 1 2\n", Off);
    assert!(d.soup.positions[0].x.is_nan() && d.soup.positions[0].y.is_infinite());
    assert_eq!(d.soup.triangles, [[0, 1, 3], [u32::MAX, 1, 2]]);
    assert_eq!(d.polygons_out_of_range, [0, 1]);
}

#[test]
fn files_without_faces_are_read() {
    assert!(document("OFF\n0 0 0\n", Off).soup.positions.is_empty());
    assert!(document("OFF\n1 0 0\n1 2 3\n", Off).soup.triangles.is_empty());
}

#[test]
fn faults_name_their_line() {
    check_refused("", Off, Some(1), "the header");
    check_refused("PLY\n", Off, Some(1), "\"PLY\" is not an integer");
    check_refused("XOFF\n1 0 0\n", Off, Some(1), "not an off header");
    check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0.3abc\n3 0 1 2\n", Off, Some(5), "\"0.3abc\" is not a number");
    check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", Off, Some(6), "a face of 2 corners");
    check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 x\n", Off, Some(6), "\"x\"");
    check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", Off, Some(5), "face 0 of 1");
    check_refused("OFF\n-3 1 0\n", Off, Some(2), "a count of -3");
    check_refused("OFF\n4000000000 4000000000 0\n0 0 0\n", Off, Some(3), "vertex 1 of 4000000000");
    check_refused("OFF\n1 1 0\n0 0 0\n4000000000 0 0 0\n", Off, Some(4), "face 0 of 1");
}

#[test]
fn other_kinds_are_refused_clearly() {
    check_refused("OFF BINARY\n\0\0\0\u{8}", Off, None, "binary off");
    check_refused("4OFF\n1 0 0\n", Off, None, "3 dimensions");
    check_refused("nOFF 5\n1 0 0\n", Off, None, "3 dimensions");
}
