//! The numbers after the header of a ply file, from text or binary.

use super::header::{Encoding, Scalar};
use crate::error::Fault;
use crate::text::{Words, number};

/// A source of numbers, read from first to last.
pub(super) enum Values<'a> {
    Text(Words<'a>),
    Binary { rest: &'a [u8], encoding: Encoding },
}

impl<'a> Values<'a> {
    /// From a text whose first line is line `first_line` of the file.
    pub(super) fn text(text: &'a str, first_line: usize) -> Self {
        Self::Text(Words::new(text, first_line))
    }
    /// From binary of the byte order that `encoding` says.
    pub(super) fn binary(bytes: &'a [u8], encoding: Encoding) -> Self {
        Self::Binary { rest: bytes, encoding }
    }

    /// The next number. `f64` holds every type of ply exactly.
    pub(super) fn scalar(&mut self, scalar: Scalar) -> Result<f64, Fault> {
        match self {
            Self::Text(words) => number(words.expect(|| "this element".to_owned())?, words.line()),
            Self::Binary { rest, encoding } => binary_scalar(rest, *encoding, scalar),
        }
    }

    /// The next number, which must be an integer.
    pub(super) fn integer(&mut self, scalar: Scalar) -> Result<i64, Fault> {
        let value = self.scalar(scalar)?;
        if value.fract() != 0.0 {
            return Err(self.fault(format!("{value} is not an integer")));
        }
        Ok(value as i64)
    }

    /// Ends a row: what is left of its line of text is dropped.
    pub(super) fn end_row(&mut self) {
        if let Self::Text(words) = self {
            words.end_line();
        }
    }

    /// A fault at this place.
    pub(super) fn fault(&self, what: String) -> Fault {
        match self {
            Self::Text(words) => Fault::line(words.line(), what),
            Self::Binary { .. } => Fault::data(what),
        }
    }
}

fn binary_scalar(rest: &mut &[u8], encoding: Encoding, scalar: Scalar) -> Result<f64, Fault> {
    let size = match scalar {
        Scalar::I8 | Scalar::U8 => 1,
        Scalar::I16 | Scalar::U16 => 2,
        Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
        Scalar::F64 => 8,
    };
    let (bytes, after) = rest.split_at_checked(size).ok_or_else(|| Fault::data("the file ends here"))?;
    *rest = after;
    let mut little_endian = [0; 8];
    little_endian[..size].copy_from_slice(bytes);
    if encoding == Encoding::BigEndian {
        little_endian[..size].reverse();
    }
    let bits = u64::from_le_bytes(little_endian);
    Ok(match scalar {
        Scalar::I8 => f64::from(bits as i8),
        Scalar::U8 => f64::from(bits as u8),
        Scalar::I16 => f64::from(bits as i16),
        Scalar::U16 => f64::from(bits as u16),
        Scalar::I32 => f64::from(bits as i32),
        Scalar::U32 => f64::from(bits as u32),
        Scalar::F32 => f64::from(f32::from_bits(bits as u32)),
        Scalar::F64 => f64::from_bits(bits),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_in_both_byte_orders() {
        let cases: [(Scalar, &[u8], f64); 8] = [
            (Scalar::I8, &[0xfe], -2.0),
            (Scalar::U8, &[0xfe], 254.0),
            (Scalar::I16, &[0xff, 0xfe], -2.0),
            (Scalar::U16, &[0x12, 0x34], 4660.0),
            (Scalar::I32, &[0xff, 0xff, 0xff, 0xfd], -3.0),
            (Scalar::U32, &[0xff, 0xff, 0xff, 0xfd], 4294967293.0),
            (Scalar::F32, &1.5f32.to_be_bytes(), 1.5),
            (Scalar::F64, &0.1f64.to_be_bytes(), 0.1),
        ];
        for (scalar, big, value) in cases {
            let little: Vec<u8> = big.iter().rev().copied().collect();
            assert_eq!(Values::binary(big, Encoding::BigEndian).scalar(scalar).unwrap(), value);
            assert_eq!(Values::binary(&little, Encoding::LittleEndian).scalar(scalar).unwrap(), value);
            assert!(Values::binary(&big[1..], Encoding::BigEndian).scalar(scalar).is_err());
        }
    }
}
