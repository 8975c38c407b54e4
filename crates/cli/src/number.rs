//! The numbers of the command line: each is told its range where it is out of it.

use std::ops::RangeInclusive;

/// Subdivision levels.
pub(crate) fn levels(text: &str) -> Result<u32, String> {
    whole(text, 0..=8).map(|n| n as u32)
}

/// A number of base vertices.
pub(crate) fn base_vertices(text: &str) -> Result<u32, String> {
    whole(text, 1..=u32::MAX.into()).map(|n| n as u32)
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
