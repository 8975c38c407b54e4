//! Reading files that gzip made.

use crate::small_tetrahedron;
use flate2::Compression;
use flate2::write::GzEncoder;
use mesh_io::{Format, ReadError, WriteError, read, read_from, readable_format, write, write_bytes};
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;
use tempfile::TempDir;

fn gz(contents: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(contents).unwrap();
    encoder.finish().unwrap()
}

/// A file in a folder of its own.
fn file(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn refused(name: &str, bytes: &[u8]) -> ReadError {
    let (_folder, path) = file(name, bytes);
    read(&path).unwrap_err()
}

#[test]
fn the_format_is_that_of_the_name_before_gz() {
    for format in Format::ALL {
        let bytes = write_bytes(&small_tetrahedron(), format).unwrap();
        for name in [format!("scan.{}.gz", format.extension()), format!("SCAN.{}.GZ", format.extension().to_uppercase())] {
            let (_folder, path) = file(&name, &gz(&bytes));
            assert_eq!(read(&path).unwrap().soup.triangles.len(), 4, "{name}");
        }
    }
    assert!(matches!(refused("scan.gz", &gz(b"")), ReadError::UnknownFormat { .. }));
    assert!(matches!(refused("scan.txt.gz", &gz(b"")), ReadError::UnknownFormat { .. }));
}

#[test]
fn several_parts_are_one_file() {
    let parts = [gz(b"v 0 0 0\nv 1 0 0\n"), gz(b"v 0 1 0\nf 1 2 3\n")].concat();
    let (_folder, path) = file("parts.obj.gz", &parts);
    assert_eq!(read(&path).unwrap().soup.triangles, [[0, 1, 2]]);
}

#[test]
fn a_fault_inside_names_its_line() {
    let said = refused("scan.obj.gz", &gz(b"v 0 0 0\nv 0 zero 0\n")).to_string();
    assert!(said.contains("scan.obj.gz:2: \"zero\" is not a number"), "{said}");
}

#[test]
fn a_file_cut_off_at_any_byte_is_told() {
    let whole = gz(&write_bytes(&small_tetrahedron(), Format::Obj).unwrap());
    for end in 1..whole.len() {
        let said = refused("scan.obj.gz", &whole[..end]).to_string();
        assert!(
            said.ends_with("the gz file is cut off; compress it again, or copy it again from where it came"),
            "{end}: {said}"
        );
    }
}

#[test]
fn what_is_damaged_or_no_gz_file_is_told() {
    let mut changed = gz(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let checksum = changed.len() - 8;
    changed[checksum] ^= 1;
    for (bytes, part) in [
        (changed.as_slice(), "the gz file is damaged"),
        (b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "it is no gz file"),
        (b"v", "it is no gz file"),
        (b"", "the gz file is cut off"),
    ] {
        let said = refused("scan.obj.gz", bytes).to_string();
        assert!(said.contains(part), "{said}");
    }
}

#[test]
fn a_small_file_that_unpacks_to_a_giant_is_refused() {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    for _ in 0..80 {
        encoder.write_all(&[b'\n'; 1 << 20]).unwrap();
    }
    let said = refused("bomb.obj.gz", &encoder.finish().unwrap()).to_string();
    assert!(said.contains("the gz file holds more than 64 MiB"), "{said}");
}

#[test]
fn writing_compressed_is_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let error = write(&folder.path().join("out.obj.gz"), &small_tetrahedron()).unwrap_err();
    assert!(matches!(error, WriteError::Packed { .. }) && error.to_string().contains("leave .gz off"), "{error}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_stream_is_read_packed_or_not() {
    for format in Format::ALL {
        let bytes = write_bytes(&small_tetrahedron(), format).unwrap();
        let plain = read_from(&mut bytes.as_slice(), "standard input", format).unwrap();
        let packed = read_from(&mut gz(&bytes).as_slice(), "standard input", format).unwrap();
        assert_eq!((plain.soup.triangles.len(), plain == packed), (4, true), "{format:?}");
    }
}

#[test]
fn a_fault_of_a_stream_has_its_name() {
    let said = |bytes: &[u8]| read_from(&mut &*bytes, "standard input", Format::Obj).unwrap_err().to_string();
    assert!(said(b"v 0 0 0\nv 0 zero 0\n").starts_with("standard input:2: \"zero\" is not a number"));
    assert!(said(&gz(b"v 0 0 0\n")[..12]).starts_with("standard input: the gz file is cut off"));
}

#[test]
fn a_name_tells_the_format_that_is_read() {
    assert_eq!(readable_format("a.b/scan.PLY.gz".as_ref()), Some(Format::Ply));
    assert_eq!(readable_format("scan.off".as_ref()), Some(Format::Off));
    assert_eq!(readable_format("scan.gz".as_ref()), None);
}
