//! Reading and writing obj.

use crate::{check_refused, document};
use glam::DVec3;
use mesh_io::Document;
use mesh_io::Format::Obj;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn polygons_become_fans_and_keep_their_numbers() {
    let d = document(format!("{SQUARE}f 1 2 3\nf 1 2 3 4\nv 5 5 5\nf 1 2 3 4 5\n"), Obj);
    assert_eq!(d.soup.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3], [0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    assert_eq!(d.polygon_of, [0, 1, 1, 2, 2, 2]);
    assert_eq!((d.n_polygons, d.n_polygons_above_3), (3, 2));
}

#[test]
fn groups_objects_and_materials_share_one_index_space() {
    let text = format!("mtllib none.mtl\no a\n{SQUARE}usemtl red\nf 3 2 1\ng b\nusemtl blue\ns 1\nf 4 3 1\no c\nf 2 3 4\n");
    let d = document(text, Obj);
    assert_eq!(d.soup.positions.len(), 4);
    assert_eq!(d.soup.triangles, [[2, 1, 0], [3, 2, 0], [1, 2, 3]]);
}

#[test]
fn equal_and_unused_vertices_stay() {
    let d = document("v 9 9 9\nv 0 0 0\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 5 4 3\nf 2 4 5", Obj);
    assert_eq!(d.soup.positions.len(), 5);
    assert_eq!(d.soup.triangles, [[4, 3, 2], [1, 3, 4]]);
}

#[test]
fn negative_indices_count_back_from_where_they_stand() {
    let d = document("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -4 -3 -1\nf 1 5 2\nv 2 2 2\n", Obj);
    assert_eq!(d.soup.triangles, [[0, 1, 2], [0, 1, 3], [0, 4, 1]]);
    assert!(d.polygons_out_of_range.is_empty());
}

#[test]
fn texture_and_normal_indices_are_passed_over() {
    let text = format!("{SQUARE}vt 0 0\nvn 0 0 -nan(ind)\nf 1/1/1 2/1/7 3/-9/1\nf 1//1 2// 4/3\n");
    assert_eq!(document(text, Obj).soup.triangles, [[0, 1, 2], [0, 1, 3]]);
}

#[test]
fn faces_out_of_range_are_kept_and_listed() {
    let d = document(format!("{SQUARE}f 1 2 3\nf 1 2 5\nf 0 1 2\nf -5 1 2 3\nf 4 3 2\nf 1 2 9999999999\n"), Obj);
    let none = u32::MAX;
    let expected = [[0, 1, 2], [0, 1, 4], [none, 0, 1], [none, 0, 1], [none, 1, 2], [3, 2, 1], [0, 1, none]];
    assert_eq!(d.soup.triangles, expected);
    assert_eq!(d.polygons_out_of_range, [1, 2, 3, 5]);
    assert_eq!(d.polygon_of, [0, 1, 2, 3, 3, 4, 5]);
    let only_bad = document("f 1 2 3", Obj);
    assert_eq!((only_bad.soup.positions.len(), only_bad.polygons_out_of_range), (0, vec![0]));
}

#[test]
fn numbers_in_every_spelling() {
    let d = document("v 1e-3 +.5 5.\nv -1.5E+2 inf -Infinity\nv NaN 0.1 0.123456789012345678901\n", Obj);
    assert_eq!(d.soup.positions[0], DVec3::new(1e-3, 0.5, 5.0));
    assert_eq!(d.soup.positions[1], DVec3::new(-150.0, f64::INFINITY, f64::NEG_INFINITY));
    assert!(d.soup.positions[2].x.is_nan());
    assert_eq!(d.soup.positions[2].z, 0.123_456_789_012_345_68);
}

#[test]
fn weights_divide_and_colours_do_not() {
    let d = document("v 1 2 3 2\nv 1 2 3 0.5 0.25 0\nv 1 2 3 .1 .2 .3 1\nf 1 2 3\n", Obj);
    assert_eq!(d.soup.positions, [DVec3::new(0.5, 1.0, 1.5), DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 2.0, 3.0)]);
    check_refused("v 1 2 3 0\n", Obj, Some(1), "weight 0");
}

#[test]
fn layouts_that_files_have() {
    let plain = document(format!("{SQUARE}f 1 2 3\n"), Obj);
    let smf = "# begin\n#$SMF 1.0\n#$vertices 4\nbegin\n";
    let layouts = [
        format!("{SQUARE}f 1 2 3\n").replace('\n', "\r\n"),
        format!("{SQUARE}f 1 2 3\n").replace('\n', "\r"),
        format!("{SQUARE}f 1 2 3").replace(' ', "\t  "),
        format!("\u{feff}{smf}  {SQUARE}\n\nf 1 2 3 # a face\\\nend\nl 1 2\np 1\ncstype bezier\n"),
        format!("{SQUARE}f 1 \\\n 2\\\r\n 3"),
        format!("# C:\\dir\\\n{SQUARE}f 1 2 3 \\"),
    ];
    for text in layouts {
        let Document { soup, polygon_of, .. } = document(&text, Obj);
        assert_eq!((soup, polygon_of), (plain.soup.clone(), plain.polygon_of.clone()), "{text:?}");
    }
    let named = document([b"o caf\xe9\n", SQUARE.as_bytes(), b"f 1 2 3"].concat(), Obj);
    assert_eq!((&named.soup, named.attributes.objects.name(0)), (&plain.soup, Some("caf\u{fffd}")));
}

#[test]
fn a_face_may_go_on_over_many_lines() {
    let corners = "1 2 3 \\\n".repeat(100_000);
    let d = document(format!("{SQUARE}f {corners}"), Obj);
    assert_eq!((d.n_polygons, d.soup.triangles.len()), (1, 299_998));
}

#[test]
fn files_without_faces_are_read() {
    assert_eq!(document("", Obj).soup, Default::default());
    assert_eq!(document(SQUARE, Obj).soup.positions.len(), 4);
    assert!(document(SQUARE, Obj).soup.triangles.is_empty());
}

#[test]
fn faults_name_their_line() {
    check_refused("v 0 0 0\r\nv 1.0.3abc 2 3\r\n", Obj, Some(2), "\"1.0.3abc\" is not a number");
    check_refused("v 1 2 \\\n 3,5\n", Obj, Some(1), "\"3,5\"");
    check_refused("# c\n\nv 1 2\n", Obj, Some(3), "2 coordinates");
    check_refused("v 1 2 3 red\n", Obj, Some(1), "\"red\"");
    check_refused(format!("{SQUARE}f 1 2\n"), Obj, Some(5), "a face of 2 corners");
    check_refused(format!("{SQUARE}f\n"), Obj, Some(5), "a face of 0 corners");
    check_refused(format!("{SQUARE}f 1 2 x\n"), Obj, Some(5), "\"x\" is not an integer");
    check_refused(format!("{SQUARE}f 1 2 3/q\n"), Obj, Some(5), "\"q\"");
    check_refused(format!("{SQUARE}f 1 2 3.5\n"), Obj, Some(5), "\"3.5\"");
    check_refused(format!("{SQUARE}f 1 2 /3\n"), Obj, Some(5), "\"\"");
}

#[test]
fn the_error_says_file_line_fault_and_remedy() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("bad.obj");
    std::fs::write(&path, "v 0 0 0\nv 0 0 zero\n").unwrap();
    let said = mesh_io::read(&path).unwrap_err().to_string();
    assert_eq!(said, format!("{}:2: \"zero\" is not a number; correct it or export the file again", path.display()));
}

#[test]
fn lines_are_chains_of_segments_and_cost_no_mesh() {
    let document = document(format!("{SQUARE}f 1 2 3 4\nl 1 2/7 -1\nl 3\nl 0 9 x\n"), Obj);
    assert_eq!(document.lines, [[0, 1], [1, 3], [u32::MAX, 8], [8, u32::MAX]]);
    assert_eq!(document.soup.triangles.len(), 2);
}
