//! From a displacement to its mesh.

use crate::level::Level;
use crate::{Displacement, DisplacementError, Residual};
use mesh_core::TriMesh;

impl Displacement {
    /// The mesh of a level: 0 is the base mesh. Its faces and vertices have the order of the mesh that was encoded.
    ///
    /// Fails where there is no such level, the base mesh is no oriented manifold, a level has not as many numbers as it has new vertices, or a
    /// vertex is displaced to where a coordinate is not finite.
    pub fn decode(&self, level: u32, residual: Residual) -> Result<TriMesh, DisplacementError> {
        let finest = self.finest();
        if level > finest {
            return Err(DisplacementError::NoLevel { level, finest });
        }
        let mut mesh = self.base.clone();
        for (number, displacement) in (0..level).zip(&self.levels) {
            mesh = Level::new(number, mesh)?.displaced(displacement, residual)?;
        }
        Ok(mesh)
    }
}
