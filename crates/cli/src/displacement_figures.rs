//! How large displacements are, for the report and for the folder.

use crate::print::Table;
use displacement::{Figures, Size};
use serde::Serialize;

/// The figures of a displacement. Lengths are shares of the diagonal of the box around the result.
#[derive(Serialize)]
pub(crate) struct DisplacementFigures {
    folder: String,
    /// Null where numbers are not quantised.
    bits: Option<u8>,
    levels: Vec<LevelFigures>,
    /// How far vertices are off after decoding; where numbers are quantised, what that costs.
    error_with_residual: Lengths,
    error_without_residual: Lengths,
}

#[derive(Serialize)]
struct LevelFigures {
    level: u32,
    /// Vertices that are new on this level.
    vertices: usize,
    scalar: Lengths,
    residual: Lengths,
}

#[derive(Serialize)]
struct Lengths {
    rms: f64,
    max: f64,
}

impl From<Size> for Lengths {
    fn from(Size { rms, greatest }: Size) -> Self {
        Self { rms, max: greatest }
    }
}

impl DisplacementFigures {
    pub(crate) fn new(folder: String, bits: Option<u8>, figures: &Figures) -> Self {
        let levels = (1..).zip(&figures.levels).map(|(level, of_level)| LevelFigures {
            level,
            vertices: of_level.vertices,
            scalar: of_level.scalar.into(),
            residual: of_level.residual.into(),
        });
        let [with_residual, without_residual] = [figures.with_residual, figures.without_residual].map(Lengths::from);
        Self {
            folder,
            bits,
            levels: levels.collect(),
            error_with_residual: with_residual,
            error_without_residual: without_residual,
        }
    }

    /// Appends one line.
    pub(crate) fn summary(&self, table: &mut Table) {
        let rms: Vec<String> = self.levels.iter().map(|level| format!("{:.1e}", level.scalar.rms)).collect();
        let rms = match rms.len() {
            0 => "base mesh alone".to_owned(),
            _ => format!("RMS {} of the diagonal by level", rms.join(", ")),
        };
        table.row("displacement", format!("{rms}; decoded {}", self.errors()));
    }

    /// Appends a line for each level, and one for what decoding gives.
    pub(crate) fn rows(&self, table: &mut Table) {
        for LevelFigures { level, vertices, scalar, residual } in &self.levels {
            let part = |lengths: &Lengths| format!("RMS {:.2e}, greatest {:.2e}", lengths.rms, lengths.max);
            let what = format!("{vertices} vertices: {}; tangential residual {}", part(scalar), part(residual));
            table.row(&format!("displacement {level}"), what);
        }
        table.row("decoded", self.errors());
    }

    fn errors(&self) -> String {
        let Self { bits, error_with_residual: with, error_without_residual: without, .. } = self;
        let quantised = bits.map(|bits| format!(" ({bits} bits)")).unwrap_or_default();
        format!("within {:.1e}{quantised}, without the residual within {:.1e}", with.max, without.max)
    }
}
