//! [`Budget`]: how much a run may spend before it is given up.

use crate::Error;

/// Triangles of a result beyond which it is refused: it would take hours and tens of gigabytes.
pub const MAX_TRIANGLES: u64 = 50_000_000;
/// The same where the base mesh has more than so many times the vertices that were asked for: nobody expects to wait for that.
const MOST_UNASKED: u64 = 500_000;
const MOST_TIMES: usize = 4;
/// Once results with this many triangles in all have failed, no other base mesh is tried. Two cores make about 10,000 triangles a second.
const MOST_FAILED: u64 = 400_000;

/// A large result is not worth to be relaxed with a greater share of triangles folded before. Measured: those that were certified had .0003 to
/// .0045, those that never were .014 to .03.
const HOPELESS_AT_FIRST: f64 = 0.01;
/// A result with a greater share of folded triangles is not worth to be snapped. Snapping mended up to .032 (brick_small).
const HOPELESS: f64 = 0.04;
/// Of a result with more triangles than this, snapping is no hope: it took 15 to 45 s, and mended nothing (DamagedHelmet, crank_cse).
const LARGE: usize = 50_000;
/// A result with a greater share of folded triangles is not worth a fit and a certificate: neither mends any.
const HOPELESS_AT_LAST: f64 = 1e-3;

/// What a run may spend, and what it has spent.
pub(crate) struct Budget {
    asked: usize,
    levels: u32,
    /// Triangles of all results so far.
    triangles: u64,
}

impl Budget {
    /// The budget of a run that asks for so many base vertices and levels.
    pub(crate) fn new(asked: usize, levels: u32) -> Self {
        Self { asked, levels, triangles: 0 }
    }

    /// Refuses a base mesh whose finest level would be too large.
    pub(crate) fn admits(&self, base_vertices: usize, base_faces: usize) -> Result<(), Error> {
        let triangles = self.finest(base_faces);
        let is_unasked = triangles > MOST_UNASKED && base_vertices > MOST_TIMES * self.asked;
        if triangles > MAX_TRIANGLES || is_unasked {
            return Err(Error::TooLarge { base_vertices, triangles });
        }
        Ok(())
    }

    /// Whether so much has been tried that no other base mesh shall be.
    pub(crate) fn is_spent(&self) -> bool {
        self.triangles > MOST_FAILED
    }

    /// Takes what a base mesh of so many faces costs.
    pub(crate) fn spend(&mut self, base_faces: usize) {
        self.triangles = self.triangles.saturating_add(self.finest(base_faces));
    }

    /// Triangles of the finest level on so many base faces.
    fn finest(&self, base_faces: usize) -> u64 {
        4u64.saturating_pow(self.levels).saturating_mul(base_faces as u64)
    }
}

/// Where a candidate stands when it is asked whether it is worth more time.
#[derive(Clone, Copy)]
pub(crate) enum Hope {
    /// Projected, to be relaxed.
    BeforeRelaxing,
    /// Relaxed, its places to be mended.
    BeforeMending,
    /// Mended, to be snapped.
    BeforeSnapping,
    /// Snapped, to be fitted and certified.
    BeforeFitting,
}

impl Hope {
    /// Fails where so many of the triangles are folded that the stages to come can't mend them.
    pub(crate) fn of(self, folded: usize, triangles: usize) -> Result<(), Error> {
        let most = match self {
            Self::BeforeRelaxing if triangles > LARGE => HOPELESS_AT_FIRST,
            Self::BeforeRelaxing => 1.0,
            Self::BeforeMending => HOPELESS,
            Self::BeforeSnapping if triangles > LARGE => HOPELESS_AT_LAST,
            Self::BeforeSnapping => HOPELESS,
            Self::BeforeFitting => HOPELESS_AT_LAST,
        };
        if folded as f64 > most * triangles as f64 { Err(Error::Folded { folded, triangles }) } else { Ok(()) }
    }
}
