//! The header of a npy file: a Python dictionary of the type of the numbers, their order, and the shape.

use crate::error::Fault;

/// What a header says.
#[derive(Debug, PartialEq)]
pub(super) struct Header<'a> {
    /// The type of the numbers, as numpy writes it.
    pub(super) kind: &'a str,
    /// Whether the first index runs fastest.
    pub(super) is_fortran: bool,
    pub(super) shape: Vec<usize>,
}

/// What every npy file begins with, before its version.
pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

/// The header of a npy file, and the bytes after it.
pub(super) fn split(bytes: &[u8]) -> Result<(Header<'_>, &[u8]), Fault> {
    let broken = || Fault::unsupported("it has no header of an array of numbers", SAVE_AGAIN);
    let rest = bytes.strip_prefix(MAGIC).ok_or_else(broken)?;
    let (version, rest) = rest.split_first_chunk::<2>().ok_or_else(broken)?;
    let (length, rest) = match version[0] {
        1 => rest.split_first_chunk().map(|(n, rest)| (usize::from(u16::from_le_bytes(*n)), rest)),
        2 | 3 => rest.split_first_chunk().map(|(n, rest)| (u32::from_le_bytes(*n) as usize, rest)),
        version => return Err(Fault::unsupported(format!("it has version {version} of npy"), SAVE_AGAIN)),
    }
    .ok_or_else(broken)?;
    let (text, numbers) = rest.split_at_checked(length).ok_or_else(broken)?;
    let text = std::str::from_utf8(text).map_err(|_| broken())?;
    Ok((parse(text).ok_or_else(broken)?, numbers))
}

/// What to do with an array that is not of a kind that is read.
pub(super) const SAVE_AGAIN: &str = "save it with numpy.savez as an array of float64, int64 or int32 in C order";

/// `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }`, in any order.
fn parse(text: &str) -> Option<Header<'_>> {
    let mut entries = text.trim().strip_prefix('{')?.strip_suffix('}')?.trim();
    let (mut kind, mut is_fortran, mut shape) = (None, None, None);
    while !entries.is_empty() {
        let (key, value) = quoted(entries)?;
        let value = value.trim_start().strip_prefix(':')?.trim_start();
        let rest = match key {
            "descr" => {
                let (name, rest) = quoted(value)?;
                kind = Some(name);
                rest
            }
            "fortran_order" => {
                let (flag, rest) = flag(value)?;
                is_fortran = Some(flag);
                rest
            }
            "shape" => {
                let (inside, rest) = value.strip_prefix('(')?.split_once(')')?;
                shape = Some(sizes(inside)?);
                rest
            }
            _ => return None,
        };
        let rest = rest.trim_start();
        entries = rest.strip_prefix(',').or(rest.is_empty().then_some(rest))?.trim_start();
    }
    Some(Header { kind: kind?, is_fortran: is_fortran?, shape: shape? })
}

/// A text between quotes, and what comes after it.
fn quoted(text: &str) -> Option<(&str, &str)> {
    let quote = text.chars().next().filter(|c| ['\'', '"'].contains(c))?;
    text[1..].split_once(quote)
}

fn flag(text: &str) -> Option<(bool, &str)> {
    let is = |word| text.strip_prefix(word);
    is("True").map(|rest| (true, rest)).or(is("False").map(|rest| (false, rest)))
}

/// The numbers of a tuple, with a comma after the last one or not.
fn sizes(inside: &str) -> Option<Vec<usize>> {
    let inside = inside.trim();
    let listed = inside.strip_suffix(',').unwrap_or(inside);
    if listed.is_empty() {
        return Some(Vec::new());
    }
    listed.split(',').map(|size| size.trim().parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_of_numpy_are_read() {
        for (text, kind, is_fortran, shape) in [
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }   \n", "<f8", false, vec![3, 2]),
            ("{'descr': '<i8', 'fortran_order': True, 'shape': (5,), }", "<i8", true, vec![5]),
            ("{\"shape\":(),\"fortran_order\":False,\"descr\":\"<i4\"}", "<i4", false, vec![]),
        ] {
            assert_eq!(parse(text), Some(Header { kind, is_fortran, shape }), "{text}");
        }
    }

    #[test]
    fn others_are_none() {
        for text in [
            "",
            "{",
            "{}",
            "{'descr': '<f8'}",
            "{'descr': '<f8', 'fortran_order': 0, 'shape': ()}",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (1 2)}",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999999,)}",
            "{'descr': '<f8' 'fortran_order': False, 'shape': ()}",
            "{'descr': é, 'shape': ()}",
            // Records.
            "{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (3,), }",
        ] {
            assert_eq!(parse(text), None, "{text}");
        }
    }
}
