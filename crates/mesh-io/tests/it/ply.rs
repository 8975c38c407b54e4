//! Reading and writing ply.

use crate::{check_refused, document, without_extras};
use glam::DVec3;
use mesh_io::Format::Ply;

const TEXT: &str = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                    element face 2\nproperty list uchar int vertex_indices\nend_header\n\
                    0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 2 1 0\n";

#[test]
fn text() {
    let d = document(TEXT, Ply);
    assert_eq!(d.soup.positions, [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y]);
    assert_eq!(d.soup.triangles, [[0, 1, 2], [0, 2, 3], [2, 1, 0]]);
    assert_eq!((d.polygon_of, d.n_polygons_above_3), (vec![0, 0, 1], 1));
}

#[test]
fn layouts_that_files_have() {
    let plain = document(TEXT, Ply);
    let layouts = [
        TEXT.replace('\n', "\r\n"),
        TEXT.trim_end().to_owned(),
        TEXT.replace("vertex_indices", "vertex_index").replace("float", "float32").replace("uchar", "uint8"),
        TEXT.replace("1 1 0\n", "\n  1. 1e0\t.0  \n\n"),
        TEXT.replace("comment by hand", "obj_info a b c\ncomment\n"),
        // Unknown properties and elements before, between and after; z y x in another order.
        "ply\nformat ascii 1.0\nelement camera 1\nproperty list uchar float a\nproperty int b\nelement vertex 4\nproperty uchar red\n\
         property float z\nproperty double y\nproperty list int int l\nproperty int x\nelement nothing 4000000000\n\
         element face 2\nproperty list int float uv\nproperty list uchar int vertex_indices\nproperty int q\nelement edge 1\nproperty int v\nend_header\n\
         2 0.5 0.5 7\n9 0 0 0 0\n9 0 0 2 3 4 1\n9 0 1 0 1\n9 0 1 1 5 0\n0 4 0 1 2 3 8\n2 .1 .2 3 2 1 0 8\n1\n"
            .to_owned(),
    ];
    for text in layouts {
        assert_eq!(without_extras(document(&text, Ply)), plain, "{text:?}");
    }
}

/// A binary file with every kind of number, in the byte order of `bytes_of`.
fn binary(order: &str, flip: impl Fn(&mut [u8])) -> Vec<u8> {
    let mut file = format!(
        "ply\nformat {order} 1.0\nelement other 1\nproperty list ushort double d\nelement vertex 3\nproperty double x\nproperty short y\n\
         property uchar c\nproperty float z\nelement face 1\nproperty list uint ushort vertex_index\nproperty char f\nend_header\n"
    )
    .into_bytes();
    let mut push = |little_endian: &[u8]| {
        let mut bytes = little_endian.to_vec();
        flip(&mut bytes);
        file.extend(bytes);
    };
    push(&2u16.to_le_bytes());
    push(&1.5f64.to_le_bytes());
    push(&2.5f64.to_le_bytes());
    for (x, y, z) in [(0.1f64, -3i16, 0.25f32), (1.0, 300, 0.5), (f64::NAN, 0, f32::INFINITY)] {
        push(&x.to_le_bytes());
        push(&y.to_le_bytes());
        push(&[7]);
        push(&z.to_le_bytes());
    }
    push(&3u32.to_le_bytes());
    for i in [2u16, 0, 1] {
        push(&i.to_le_bytes());
    }
    push(&[0xff]);
    file
}

#[test]
fn binary_of_both_byte_orders() {
    for file in [binary("binary_little_endian", |_| ()), binary("binary_big_endian", |b| b.reverse())] {
        let d = document(file, Ply);
        assert_eq!(d.soup.positions[..2], [DVec3::new(0.1, -3.0, 0.25), DVec3::new(1.0, 300.0, 0.5)]);
        assert!(d.soup.positions[2].x.is_nan() && d.soup.positions[2].z == f64::INFINITY);
        assert_eq!(d.soup.triangles, [[2, 0, 1]]);
    }
}

#[test]
fn strips_restart_at_minus_one() {
    let header = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
    let vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";
    for (kind, restart) in [("int", "-1"), ("uint", "4294967295")] {
        let text = format!(
            "{header}element tristrips 2\nproperty list int {kind} vertex_indices\nend_header\n{vertices}\
             9 0 1 2 3 {restart} 4 3 2 {restart}\n3 0 1 4\n"
        );
        let d = document(text, Ply);
        assert_eq!(d.soup.triangles, [[0, 1, 2], [2, 1, 3], [4, 3, 2], [0, 1, 4]]);
        assert_eq!((d.n_polygons, d.polygon_of), (4, vec![0, 1, 2, 3]));
    }
}

#[test]
fn bad_indices_are_kept() {
    let d = document(TEXT.replace("3 2 1 0", "3 2 -1 4"), Ply);
    assert_eq!(d.soup.triangles[2], [2, u32::MAX, 4]);
    assert_eq!(d.polygons_out_of_range, [1]);
}

#[test]
fn files_without_faces_are_read() {
    let points = TEXT.replace("element face 2", "element face 0").replace("4 0 1 2 3\n3 2 1 0\n", "");
    assert_eq!(document(points, Ply).soup.positions.len(), 4);
    assert!(document("ply\nformat ascii 1.0\nend_header\n", Ply).soup.positions.is_empty());
}

#[test]
fn faults_name_their_line() {
    let with = |from: &str, to: &str| TEXT.replacen(from, to, 1);
    check_refused(with("1 1 0", "1 1.0.3abc 0"), Ply, Some(13), "vertex 2 of 4: \"1.0.3abc\" is not a number");
    check_refused(with("3 2 1 0", "2 2 1"), Ply, Some(16), "face 1 of 2: a face of 2 corners");
    check_refused(with("3 2 1 0", "3 2 1.5 0"), Ply, Some(16), "1.5 is not an integer");
    check_refused(with("3 2 1 0\n", ""), Ply, Some(15), "face 1 of 2");
    check_refused(with("ply", "plx"), Ply, Some(1), "begins with");
    check_refused(with("float y", "float w"), Ply, Some(4), "no properties x, y and z");
    check_refused(with("vertex_indices", "corners"), Ply, Some(8), "no list vertex_indices");
    check_refused(with("ascii", "utf8"), Ply, Some(2), "\"utf8\" is no ply format");
    check_refused(with("float y", "quad y"), Ply, Some(6), "\"quad\" is no type");
    check_refused(with("element face 2", "element face two"), Ply, Some(8), "\"two\" is not a count");
    check_refused(with("comment", "remark"), Ply, Some(3), "\"remark\"");
    check_refused(with("end_header", "comment"), Ply, Some(11), "\"0\" is no header line");
    check_refused("ply\nproperty int x\n", Ply, Some(2), "before the first element");
    check_refused("ply\nend_header\n", Ply, Some(2), "no line \"format\"");
    check_refused("ply\n", Ply, None, "does not end");
}

#[test]
fn claims_are_not_believed() {
    let header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n";
    check_refused(format!("{header}end_header\nabcdefghijkl"), Ply, None, "vertex 1 of 4000000000: the file ends here");
    let list = "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int vertex_indices\nend_header\n";
    check_refused([list.as_bytes(), &[0xff; 12]].concat(), Ply, None, "face 0 of 1: the file ends here");
}

#[test]
fn edges_are_lines() {
    let edges = "element edge 3\nproperty int vertex1\nproperty int vertex2\nend_header\n";
    let text = TEXT.replace("end_header\n", edges) + "0 1\n1 -3\n9 0.5\n";
    let document = document(text, Ply);
    assert_eq!(document.lines, [[0, 1], [1, u32::MAX], [9, u32::MAX]]);
    assert_eq!(document.soup.triangles.len(), 3);
}
