//! How large displacements are, and what decoding gives back.

use crate::{Displacement, DisplacementError, LevelDisplacement, Residual};
use mesh_core::TriMesh;

/// Figures of a displacement. Lengths are shares of the diagonal of the box around the mesh that was encoded.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Of levels 1, 2 and so on.
    pub levels: Vec<LevelFigures>,
    /// How far vertices of the finest level are off when all numbers are used. Where these are quantised, that is what it costs; where they are
    /// not, it is rounding.
    pub with_residual: Size,
    /// How far they are off when the residual is dropped.
    pub without_residual: Size,
}

/// Figures of the displacements of a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelFigures {
    /// Number of new vertices.
    pub vertices: usize,
    /// The part along the normal.
    pub scalar: Size,
    /// The part orthogonal to it.
    pub residual: Size,
}

/// How large lengths are; 0 where there are none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Size {
    /// Their root mean square.
    pub rms: f64,
    /// The greatest.
    pub greatest: f64,
}

impl Size {
    /// Of lengths, in parts of the diagonal.
    fn of(lengths: impl Iterator<Item = f64>, diagonal: f64) -> Self {
        let mut size = Self::default();
        let mut n = 0;
        for length in lengths {
            // A mesh without extent has no lengths.
            let share = if diagonal > 0.0 { length / diagonal } else { 0.0 };
            size.rms += share * share;
            size.greatest = size.greatest.max(share);
            n += 1;
        }
        Self { rms: (size.rms / f64::from(n.max(1))).sqrt(), ..size }
    }
}

/// Decodes a displacement, with the residual and without it, and compares with the mesh that was encoded.
///
/// Fails where that is another mesh, and where the displacement cannot be decoded.
pub fn figures(displacement: &Displacement, mesh: &TriMesh) -> Result<Figures, DisplacementError> {
    let diagonal = mesh.diagonal();
    let off = |residual| {
        let decoded = displacement.decode(displacement.finest(), residual)?;
        if decoded.faces() != mesh.faces() || decoded.n_vertices() != mesh.n_vertices() {
            return Err(DisplacementError::OtherMesh);
        }
        let distances = decoded.positions().iter().zip(mesh.positions().iter()).map(|(p, q)| p.distance(*q));
        Ok(Size::of(distances, diagonal))
    };
    Ok(Figures {
        levels: displacement.levels.iter().map(|level| level_figures(level, diagonal)).collect(),
        with_residual: off(Residual::Kept)?,
        without_residual: off(Residual::Dropped)?,
    })
}

fn level_figures(level: &LevelDisplacement, diagonal: f64) -> LevelFigures {
    let residual = level.residual.values();
    LevelFigures {
        vertices: level.scalar.len(),
        scalar: Size::of(level.scalar.values().into_iter().map(f64::abs), diagonal),
        residual: Size::of(residual.chunks_exact(2).map(|t| t[0].hypot(t[1])), diagonal),
    }
}
