//! Writing.

use super::array::{Array, Numbers};
use rawzip::ZipArchiveWriter;
use std::io::{self, Write as _};

/// Beginning of every npy file, with version 1.0.
const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
/// The numbers begin at a multiple of this.
const ALIGNMENT: usize = 64;

/// The bytes of a file with these arrays.
pub(crate) fn write(arrays: &[Array]) -> io::Result<Vec<u8>> {
    let mut archive = ZipArchiveWriter::new(Vec::new());
    for array in arrays {
        let name = format!("{}.npy", array.name);
        let (mut entry, config) = archive.new_file(name.as_str()).start().map_err(io::Error::other)?;
        let mut writer = config.wrap(&mut entry);
        writer.write_all(&header(array))?;
        match &array.values {
            Numbers::Float(values) => write_numbers(&mut writer, values, f64::to_le_bytes)?,
            Numbers::Int(values) => write_numbers(&mut writer, values, i64::to_le_bytes)?,
            Numbers::Int32(values) => write_numbers(&mut writer, values, i32::to_le_bytes)?,
        }
        let (_, descriptor) = writer.finish().map_err(io::Error::other)?;
        entry.finish(descriptor).map_err(io::Error::other)?;
    }
    archive.finish().map_err(io::Error::other)
}

/// In pieces: one call for each number would take its time.
fn write_numbers<T: Copy, const N: usize>(
    writer: &mut impl io::Write,
    values: &[T],
    bytes: impl Fn(T) -> [u8; N],
) -> io::Result<()> {
    const PIECE: usize = 8192;
    values.chunks(PIECE).try_for_each(|piece| writer.write_all(&piece.iter().flat_map(|&x| bytes(x)).collect::<Vec<u8>>()))
}

/// The header of an array: what a Python dictionary says of it, padded.
fn header(array: &Array) -> Vec<u8> {
    let kind = array.values.kind();
    // A tuple of one has a comma, too.
    let shape: String = array.shape.iter().map(|n| format!("{n},")).collect();
    let text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape})}}");
    let length = (MAGIC.len() + 2 + text.len() + 1).next_multiple_of(ALIGNMENT) - MAGIC.len() - 2;
    let padded = format!("{text:width$}\n", width = length - 1);
    // Shapes of a few numbers: the length is far below 64 KiB.
    [MAGIC, &(length as u16).to_le_bytes(), padded.as_bytes()].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_aligned_and_say_what_follows() {
        let array =
            |shape: &[usize]| Array { name: "a".into(), shape: shape.to_vec(), values: Numbers::Int([].as_slice().into()) };
        for (shape, text) in [(vec![5], "(5,)"), (vec![7, 3], "(7,3,)"), (vec![], "()"), (vec![usize::MAX; 4], "615,)")] {
            let header = header(&array(&shape));
            assert_eq!((header.len() % 64, header.last()), (0, Some(&b'\n')));
            assert_eq!(usize::from(u16::from_le_bytes([header[8], header[9]])), header.len() - 10);
            assert!(String::from_utf8_lossy(&header).contains(&format!("{text}}}")), "{shape:?}");
        }
    }

    /// Both are read back by a package that knows zip.
    #[test]
    fn arrays_are_stored_one_after_the_other() {
        let (floats, ints) = ([0.5, f64::NAN], [-1, 1 << 40, 7]);
        let arrays = [
            Array { name: "floats".into(), shape: vec![2], values: Numbers::Float(floats.as_slice().into()) },
            Array { name: "ints".into(), shape: vec![1, 3], values: Numbers::Int(ints.as_slice().into()) },
        ];
        let bytes = write(&arrays).unwrap();
        assert_eq!(bytes, write(&arrays).unwrap());
        let archive = rawzip::ZipArchive::from_slice(&bytes).unwrap();
        let mut entries = archive.entries();
        for (name, numbers) in [
            ("floats.npy", floats.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>()),
            ("ints.npy", ints.iter().flat_map(|x: &i64| x.to_le_bytes()).collect()),
        ] {
            let entry = entries.next_entry().unwrap().unwrap();
            assert_eq!(entry.file_path().as_ref(), name.as_bytes());
            let stored = archive.get_entry(entry.wayfinder()).unwrap();
            let mut data = Vec::new();
            io::copy(&mut stored.verifying_reader(stored.data()), &mut data).unwrap();
            assert!(data.starts_with(MAGIC) && data.ends_with(&numbers) && data.len() == 128 + numbers.len(), "{name}");
        }
        assert!(entries.next_entry().unwrap().is_none());
    }
}
