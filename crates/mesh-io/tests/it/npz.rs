//! Arrays for numpy, there and back, and what is refused.

use flate2::Compression;
use flate2::write::DeflateEncoder;
use mesh_io::{Array, Numbers, ReadError, array_bytes, read_arrays, read_arrays_bytes, write_arrays};
use std::io::Write as _;

fn arrays() -> Vec<Array<'static>> {
    let array = |name: &str, shape: &[usize], values| Array { name: name.to_owned(), shape: shape.to_vec(), values };
    vec![
        array("floats", &[2, 3], Numbers::Float(vec![0.5, -0.0, f64::MAX, 5e-324, f64::INFINITY, 1.0 / 3.0].into())),
        array("ints", &[3], Numbers::Int(vec![i64::MIN, 0, 1 << 40].into())),
        array("small", &[1, 2], Numbers::Int32(vec![i32::MIN, 7].into())),
        array("one", &[], Numbers::Float(vec![0.25].into())),
        array("none", &[0, 3], Numbers::Float(vec![].into())),
    ]
}

/// A zip file with one entry of these contents, compressed by deflate.
fn zip(name: &str, contents: &[u8]) -> Vec<u8> {
    let mut archive = rawzip::ZipArchiveWriter::new(Vec::new());
    let (mut entry, config) = archive.new_file(name).compression_method(rawzip::CompressionMethod::DEFLATE).start().unwrap();
    let mut writer = config.wrap(DeflateEncoder::new(&mut entry, Compression::best()));
    writer.write_all(contents).unwrap();
    let (encoder, descriptor) = writer.finish().unwrap();
    encoder.finish().unwrap();
    entry.finish(descriptor).unwrap();
    archive.finish().unwrap()
}

/// A npy file with this header.
fn npy(header: &str, numbers: &[u8]) -> Vec<u8> {
    [b"\x93NUMPY\x01\x00".as_slice(), &(header.len() as u16).to_le_bytes(), header.as_bytes(), numbers].concat()
}

#[test]
fn arrays_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    write_arrays(&path, &arrays()).unwrap();
    assert_eq!(read_arrays(&path).unwrap(), arrays());
    let alone = npy("{'descr': '<f8', 'fortran_order': True, 'shape': (2,), }\n", &[0; 16]);
    for (name, bytes) in [("x", zip("x.npy", &alone)), ("", alone)] {
        let read = read_arrays_bytes(&bytes).unwrap();
        assert_eq!(read, [Array { name: name.into(), shape: vec![2], values: Numbers::Float(vec![0.0; 2].into()) }]);
    }
}

#[test]
fn what_is_no_array_is_told() {
    let refused =
        |header: &str, numbers: usize| read_arrays_bytes(&zip("x.npy", &npy(header, &vec![0; numbers]))).unwrap_err().to_string();
    for (header, numbers, part) in [
        ("{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }", 15, "15 bytes are not those of the shape [2]"),
        ("{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296, 2), }", 0, "not those of the shape"),
        ("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 1), }", 16, "Fortran order"),
        ("{'descr': '>f8', 'fortran_order': False, 'shape': (2,), }", 16, "type \">f8\""),
        ("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (2,), }", 16, "no header of an array of numbers"),
        ("nonsense", 16, "no header of an array of numbers"),
    ] {
        let told = refused(header, numbers);
        assert!(told.starts_with("<bytes>: the array x: ") && told.contains(part) && told.contains("; "), "{told}");
    }
    let bomb = zip("x.npy", &vec![0; 1 << 27]);
    let told = read_arrays_bytes(&bomb).unwrap_err().to_string();
    assert!(told.contains("too large for the size of the file"), "{told}");
    assert!(matches!(read_arrays("no/such.npz".as_ref()), Err(ReadError::Io { .. })));
}

/// Cut off anywhere, or with any byte another one, a file is refused or read, and nothing panics.
#[test]
fn broken_files_are_refused() {
    let bytes = array_bytes(&arrays()).unwrap();
    for n in 0..bytes.len() {
        assert!(read_arrays_bytes(&bytes[..n]).is_err(), "{n} bytes");
        for change in [1, 0x80, 0xff] {
            let mut broken = bytes.clone();
            broken[n] ^= change;
            let _ = read_arrays_bytes(&broken);
        }
    }
    assert!(read_arrays_bytes(b"").is_err() && read_arrays_bytes(b"PK").is_err());
    // A number that is another one is found by its checksum.
    let at = bytes.windows(8).position(|w| w == f64::MAX.to_le_bytes()).unwrap();
    let mut broken = bytes.clone();
    broken[at] ^= 1;
    let told = read_arrays_bytes(&broken).unwrap_err().to_string();
    assert!(told.contains("the array floats: it is damaged"), "{told}");
}
