//! The numbers of the command line: each is told its range where it is out of it.

use std::ops::RangeInclusive;

/// Subdivision levels.
pub(crate) fn levels(text: &str) -> Result<u32, String> {
    whole(text, 0..=semireg::MAX_LEVELS.into()).map(|n| n as u32)
}

/// A number of base vertices.
pub(crate) fn base_vertices(text: &str) -> Result<u32, String> {
    whole(text, 1..=u32::MAX.into()).map(|n| n as u32)
}

/// A number of vertices or triangles of a result.
pub(crate) fn count(text: &str) -> Result<u32, String> {
    whole(text, 4..=semireg::MAX_TRIANGLES).map(|n| n as u32)
}

/// A length in the units of a mesh.
pub(crate) fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length.is_finite() && length > 0.0 => Ok(length),
        _ => Err("a length above 0 is needed".to_owned()),
    }
}

/// A growth of lengths per length.
pub(crate) fn slope(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(slope) if slope.is_finite() && slope >= 0.0 => Ok(slope),
        _ => Err("a number from 0 on is needed".to_owned()),
    }
}

/// A share of a whole.
pub(crate) fn fraction(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(share) if share > 0.0 && share < 1.0 => Ok(share),
        _ => Err("a share above 0 and below 1 is needed".to_owned()),
    }
}

/// A number of threads.
pub(crate) fn threads(text: &str) -> Result<u16, String> {
    whole(text, 1..=1024).map(|n| n as u16)
}

/// A number of iterations.
pub(crate) fn iterations(text: &str) -> Result<u32, String> {
    whole(text, 0..=1_000_000).map(|n| n as u32)
}

/// A mean quality of triangles.
pub(crate) fn quality(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(quality) if (0.0..=1.0).contains(&quality) => Ok(quality),
        _ => Err("a quality from 0 to 1 is needed".to_owned()),
    }
}

/// How many results.
pub(crate) fn variants(text: &str) -> Result<u32, String> {
    whole(text, 1..=1_000).map(|n| n as u32)
}

/// Bits that a number is quantised to.
pub(crate) fn bits(text: &str) -> Result<u8, String> {
    whole(text, 2..=24).map(|n| n as u8)
}

/// A seed.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    whole(text, 0..=u64::MAX)
}

fn whole(text: &str, range: RangeInclusive<u64>) -> Result<u64, String> {
    let needed = || format!("a whole number from {} to {} is needed", range.start(), range.end());
    text.parse().ok().filter(|n| range.contains(n)).ok_or_else(needed)
}

/// An angle between two faces, in degrees.
pub(crate) fn degrees(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(angle) if angle > 0.0 && angle <= 180.0 => Ok(angle),
        _ => Err("an angle above 0 and at most 180 degrees is needed".to_owned()),
    }
}

/// Seconds, or an amount of memory: more than nothing.
pub(crate) fn amount(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(amount) if amount > 0.0 && amount <= 1e9 => Ok(amount),
        _ => Err("a number above 0, at most 1e9, is needed".to_owned()),
    }
}
