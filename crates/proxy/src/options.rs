//! How small the proxy shall be, and how true.

use crate::ProxyError;

/// How small the proxy shall be, and how true to the surface. Lengths are in the units of the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct ProxyOptions {
    /// Faces wanted, at least 1. There are more where the other bounds need them.
    pub faces: usize,
    /// No collapse makes an edge longer than this, above 0: what runs on the proxy sees the surface at this resolution at least.
    pub longest_edge: f64,
    /// No vertex goes whose neighbour would be farther than this from the planes of the faces that it stands for (root mean square), at least 0.
    pub distance: f64,
}

impl ProxyOptions {
    /// Fails for the first option that is out of its range.
    pub fn check(&self) -> Result<(), ProxyError> {
        let in_range = |name: &'static str, value: f64, is_right: bool| {
            if is_right { Ok(()) } else { Err(ProxyError::Option { name, value }) }
        };
        in_range("faces", self.faces as f64, self.faces > 0)?;
        in_range("longest_edge", self.longest_edge, self.longest_edge > 0.0)?;
        in_range("distance", self.distance, self.distance >= 0.0)
    }
}
