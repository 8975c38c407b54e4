//! Reading.

use super::array::{Array, FLOAT, INT, INT32, Numbers};
use super::header::{Header, MAGIC, SAVE_AGAIN, split};
use crate::error::Fault;
use crate::packed::most_unpacked;
use flate2::bufread::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive, ZipFileHeaderRecord, ZipSliceArchive};
use std::io::Read;

/// The arrays of a file, in its order, compressed or not; the only one of a npy file, without a name. Together they may take what a compressed file may.
pub(crate) fn read(bytes: &[u8]) -> Result<Vec<Array<'static>>, Fault> {
    if bytes.starts_with(MAGIC) {
        return Ok(vec![array("", bytes)?]);
    }
    let broken = |error: rawzip::Error| Fault::data(format!("it is no npz file, or is cut off ({error})"));
    let archive = ZipArchive::from_slice(bytes).map_err(broken)?;
    let mut entries = archive.entries();
    let (mut arrays, mut most) = (Vec::new(), most_unpacked(bytes.len()));
    while let Some(entry) = entries.next_entry().map_err(broken)? {
        let file_name = String::from_utf8_lossy(entry.file_path().as_ref()).into_owned();
        let name = file_name.strip_suffix(".npy").unwrap_or(&file_name);
        let of_array = |fault: Fault| fault.of(&format!("the array {name}"));
        let contents = contents(&archive, &entry, most).map_err(of_array)?;
        // Entries that share their bytes cannot fill the memory either.
        most -= contents.len() as u64;
        arrays.push(array(name, &contents).map_err(of_array)?);
    }
    Ok(arrays)
}

/// The bytes of an entry, at most so many.
fn contents(archive: &ZipSliceArchive<&[u8]>, entry: &ZipFileHeaderRecord, most: u64) -> Result<Vec<u8>, Fault> {
    let damaged = |error: String| Fault::data(format!("it is damaged ({error})"));
    let stored = archive.get_entry(entry.wayfinder()).map_err(|e| damaged(e.to_string()))?;
    let mut contents = Vec::new();
    let read = match entry.compression_method() {
        CompressionMethod::STORE => stored.verifying_reader(stored.data()).take(most + 1).read_to_end(&mut contents),
        CompressionMethod::DEFLATE => {
            let unpacked = DeflateDecoder::new(stored.data());
            stored.verifying_reader(unpacked).take(most + 1).read_to_end(&mut contents)
        }
        _ => return Err(Fault::unsupported("it is compressed by another method than deflate", SAVE_AGAIN)),
    };
    read.map_err(|e| damaged(e.to_string()))?;
    if contents.len() as u64 > most {
        return Err(Fault::unsupported("it is too large for the size of the file", SAVE_AGAIN));
    }
    Ok(contents)
}

/// The array of a npy file.
fn array(name: &str, bytes: &[u8]) -> Result<Array<'static>, Fault> {
    let (Header { kind, is_fortran, shape }, numbers) = split(bytes)?;
    if is_fortran && shape.len() > 1 {
        return Err(Fault::unsupported("it is in Fortran order", SAVE_AGAIN));
    }
    let count = shape.iter().try_fold(1_usize, |n, &size| n.checked_mul(size));
    let is_whole = |width: usize| count.and_then(|n| n.checked_mul(width)) == Some(numbers.len());
    let values = match kind {
        FLOAT if is_whole(8) => Numbers::Float(values(numbers, f64::from_le_bytes).into()),
        INT if is_whole(8) => Numbers::Int(values(numbers, i64::from_le_bytes).into()),
        INT32 if is_whole(4) => Numbers::Int32(values(numbers, i32::from_le_bytes).into()),
        FLOAT | INT | INT32 => {
            return Err(Fault::data(format!("its {} bytes are not those of the shape {shape:?}", numbers.len())));
        }
        _ => return Err(Fault::unsupported(format!("its numbers are of type {}", crate::text::quoted(kind)), SAVE_AGAIN)),
    };
    Ok(Array { name: name.to_owned(), shape, values })
}

fn values<T, const N: usize>(bytes: &[u8], number: impl Fn([u8; N]) -> T) -> Vec<T> {
    bytes.as_chunks::<N>().0.iter().map(|&chunk| number(chunk)).collect()
}
