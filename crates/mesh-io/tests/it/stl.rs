//! Reading and writing stl.

use crate::{check_refused, document, small_tetrahedron};
use glam::DVec3;
use mesh_io::Format::Stl;
use mesh_io::write_bytes;

const FACET: &str = "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 0.1 0\n endloop\nendfacet\n";

#[test]
fn text_in_double_precision() {
    let d = document(format!("solid a part\n{FACET}{FACET}endsolid a part\n"), Stl);
    assert_eq!(d.soup.triangles, [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(d.soup.positions[2], DVec3::new(0.0, 0.1, 0.0));
}

#[test]
fn layouts_that_files_have() {
    let plain = document(format!("solid x\n{FACET}endsolid\n"), Stl);
    let layouts = [
        format!("solid\n{FACET}endsolid x"),
        format!("solid x\n{FACET}"),
        format!("solid x\n{}end solid\n", FACET.replace("end", "end ")),
        format!("  SOLID x\n{}ENDSOLID\n", FACET.to_uppercase()),
        format!("\u{feff}solid x\n{FACET}"),
        format!("solid x\r\n{}", FACET.replace('\n', "\r\n")),
        format!("solid x\n{}", FACET.replace('\n', " ")),
        format!("solid x\n{}", FACET.replace("0 0 1", "nan -nan(ind) 1.#INF")),
        format!("solid x\nendsolid x\n\nsolid y\n{FACET}endsolid y\n"),
    ];
    for text in layouts {
        assert_eq!(document(&text, Stl), plain, "{text:?}");
    }
    assert!(document("solid x\nendsolid\n", Stl).soup.triangles.is_empty());
}

#[test]
fn a_binary_file_may_begin_with_solid() {
    let mut bytes = write_bytes(&small_tetrahedron(), Stl).unwrap();
    let plain = document(&bytes, Stl);
    bytes[..80].fill(b' ');
    bytes[..20].copy_from_slice(b"solid facet normal \n");
    assert_eq!(document(&bytes, Stl), plain);
    bytes.extend(b"\0trailing");
    assert_eq!(document(&bytes, Stl), plain);
}

#[test]
fn values_that_are_not_finite_are_kept() {
    let d = document(format!("solid\n{}", FACET.replace("0.1", "nan")), Stl);
    assert!(d.soup.positions[2].y.is_nan());
    let mut bytes = write_bytes(&small_tetrahedron(), Stl).unwrap();
    bytes[96..100].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert_eq!(document(bytes, Stl).soup.positions[0].x, f64::INFINITY);
}

#[test]
fn faults_name_their_line() {
    let with = |from: &str, to: &str| format!("solid x\n{}", FACET.replacen(from, to, 1));
    check_refused(with("1 0 0", "1 0 0.3abc"), Stl, Some(5), "\"0.3abc\" is not a number");
    check_refused(with(" vertex 1 0 0\n", ""), Stl, Some(6), "a facet of 2 corners");
    check_refused(with("outer", "inner"), Stl, Some(3), "\"inner\" where \"outer\"");
    check_refused(with("facet", "face"), Stl, Some(2), "\"face\" where a facet");
    check_refused(with(" endloop\nendfacet\n", ""), Stl, Some(6), "in the middle of a facet");
}

#[test]
fn a_binary_file_must_be_as_long_as_it_claims() {
    let mut bytes = write_bytes(&small_tetrahedron(), Stl).unwrap();
    bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    check_refused(bytes, Stl, None, "claims 4294967295 triangles but the file has room for 4");
    check_refused("", Stl, None, "neither");
}
