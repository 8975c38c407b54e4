//! [`badness`]: how far a triangle is from what the certificate accepts.

use certify::Reference;
use glam::DVec3;
use mesh_core::aspect_ratio;

/// The quality (AR) that triangles shall have. The certificate asks for half of it.
const SOUND: f64 = 0.02;

/// What a triangle lacks in quality, as a share; 2 and its quality where it faces against the input, so that it gets thin before it turns over. 0 for a
/// sound one.
pub(crate) fn badness(input: &Reference, triangle: [DVec3; 3]) -> f64 {
    let [a, b, c] = triangle;
    let quality = aspect_ratio(triangle);
    if input.index().opposes((a + b + c) / 3.0, (b - a).cross(c - a)) { 2.0 + quality } else { (1.0 - quality / SOUND).max(0.0) }
}
