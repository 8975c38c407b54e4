//! [`badness`]: how far a triangle is from what the certificate accepts.

use certify::Reference;
use glam::DVec3;
use mesh_core::aspect_ratio;

/// The quality (AR) that triangles shall have. The certificate asks for half of it.
const SOUND: f64 = 0.02;

/// What a triangle lacks in quality, as a share, and one more where it faces against the input. 0 for a sound one.
pub(crate) fn badness(input: &Reference, triangle: [DVec3; 3]) -> f64 {
    let [a, b, c] = triangle;
    let lacking = (1.0 - aspect_ratio(triangle) / SOUND).max(0.0);
    let is_folded = input.index().opposes((a + b + c) / 3.0, (b - a).cross(c - a));
    lacking + f64::from(is_folded)
}
