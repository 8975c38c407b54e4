//! Files compressed by gzip: `scan.ply.gz` is read as `scan.ply`.

use crate::error::Fault;
use flate2::read::MultiGzDecoder;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// A mesh file shrinks by a factor of 3 to 20. One that grows by more than this is made to fill the memory.
const MOST_GROWTH: u64 = 200;
/// A small file may grow by more: to 64 MiB.
const ALWAYS_ALLOWED: u64 = 1 << 26;
/// No file may grow to more than 4 GiB.
const NEVER_ALLOWED: u64 = 1 << 32;

/// The name of the file inside, when the name ends in `.gz` (upper or lower case).
pub(crate) fn name_inside(path: &Path) -> Option<PathBuf> {
    let is_packed = path.extension()?.eq_ignore_ascii_case("gz");
    is_packed.then(|| path.with_extension(""))
}

/// What a gzip file begins with.
const FIRST_BYTES: [u8; 2] = [0x1f, 0x8b];

/// Whether these are the contents of a gzip file.
pub(crate) fn is_packed(bytes: &[u8]) -> bool {
    bytes.starts_with(&FIRST_BYTES)
}

/// The contents of a gzip file; several parts one after the other are taken as one.
pub(crate) fn unpack(bytes: &[u8]) -> Result<Vec<u8>, Fault> {
    if !bytes.iter().zip(FIRST_BYTES).all(|(found, first)| *found == first) {
        return Err(Fault::packed("its name ends in .gz, but it is no gz file"));
    }
    let most = most_unpacked(bytes.len());
    let mut contents = Vec::new();
    MultiGzDecoder::new(bytes).take(most + 1).read_to_end(&mut contents).map_err(fault)?;
    if contents.len() as u64 > most {
        let what = format!("the gz file holds more than {} MiB, too much for its size", most >> 20);
        return Err(Fault::unsupported(what, "unpack it first if it is what it should be"));
    }
    Ok(contents)
}

/// How many bytes may come out of a compressed file of so many.
pub(crate) fn most_unpacked(n: usize) -> u64 {
    (MOST_GROWTH * n as u64).clamp(ALWAYS_ALLOWED, NEVER_ALLOWED)
}

fn fault(error: std::io::Error) -> Fault {
    match error.kind() {
        ErrorKind::UnexpectedEof => Fault::packed("the gz file is cut off"),
        _ => Fault::packed(format!("the gz file is damaged ({error})")),
    }
}
