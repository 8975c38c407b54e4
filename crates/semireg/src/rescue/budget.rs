//! [`Budget`]: how much a run may spend before it is given up.

use super::plan::Growth;
use crate::Error;

/// Triangles of a result beyond which it is refused: it would take hours and tens of gigabytes.
pub const MAX_TRIANGLES: u64 = 50_000_000;
/// The same where the base mesh has more than so many times the vertices that were asked for: nobody expects to wait for that.
const MOST_UNASKED: u64 = 500_000;
/// How many times the vertices asked for a base mesh of such a large result may have: more lets people wait for what they did not ask for.
const MOST_TIMES: usize = 4;
/// A base face takes as long as so many triangles of the finest level. Measured at one thread: 2.3 ms for a base face of a part (decimation,
/// patches, search), .25 ms for a triangle of the finest level.
const OF_A_BASE_FACE: u64 = 9;
/// Once results that took so much work in all have failed, no other base mesh is tried. In triangles of the finest level, of which a processor
/// makes about 5,000 in a second.
const MOST_FAILED: u64 = 300_000;
/// Work on all results of a run at most, with the one that is made finer for its shape: no answer shall take minutes.
const MOST_ON_SHAPE: u64 = 450_000;

/// What a candidate may have at most to be worth the next stage, as a share of its triangles: of folded ones before it is relaxed and mended, of those
/// that the certificate would refuse after it. Small results may have more, as they cost little: the bound falls with a power of the number of
/// triangles, without a step.
struct Bound {
    /// Of results of `SMALL` triangles and fewer.
    small: f64,
    /// Of results of `LARGE` triangles and more.
    large: f64,
}

/// Triangles of a result that is tried to the end: it takes seconds.
const SMALL: f64 = 20_000.0;
/// Triangles of a result of which a stage takes tens of seconds, so that hope must be well founded.
const LARGE: f64 = 50_000.0;

/// Before the relaxation. Measured on large results: those that were certified had .0003 to .0045, those that never were .014 to .03.
const TO_RELAX: Bound = Bound { small: 0.5, large: 0.01 };
/// Before places are mended.
const TO_MEND: Bound = Bound { small: 0.04, large: 0.04 };
/// Before snapping, which mended up to .032 of small results (brick_small), and of large ones nothing in 15 to 160 s (DamagedHelmet, crank_cse,
/// 2CylinderEngine).
const TO_SNAP: Bound = Bound { small: 0.04, large: 1e-3 };

impl Bound {
    fn at(&self, triangles: usize) -> f64 {
        let share = ((triangles as f64 / SMALL).ln() / (LARGE / SMALL).ln()).clamp(0.0, 1.0);
        self.small * (self.large / self.small).powf(share)
    }
}

/// What a run may spend, and what it has spent.
#[derive(Clone, Copy)]
pub(crate) struct Budget {
    asked: usize,
    levels: u32,
    /// What all results took so far, in triangles of the finest level.
    work: u64,
}

impl Budget {
    /// The budget of a run that asks for so many base vertices and levels.
    pub(crate) fn new(asked: usize, levels: u32) -> Self {
        Self { asked, levels, work: 0 }
    }

    /// Refuses a base mesh whose finest level would be too large.
    pub(crate) fn admits(&self, base_vertices: usize, base_faces: usize) -> Result<(), Error> {
        let triangles = finest(base_faces, self.levels);
        let is_unasked = triangles > MOST_UNASKED && base_vertices > MOST_TIMES * self.asked;
        if triangles > MAX_TRIANGLES || is_unasked {
            return Err(Error::TooLarge { base_vertices, triangles });
        }
        Ok(())
    }

    /// Whether so much has been tried that no other base mesh shall be.
    pub(crate) fn is_spent(&self) -> bool {
        self.work > MOST_FAILED
    }

    /// Whether a result with more base vertices may be tried for its shape.
    pub(crate) fn bears(&self, step: Growth) -> bool {
        let vertices = (step.times * self.asked as f64) as usize;
        // A closed surface has about two faces for each vertex.
        self.work + work_on(2 * vertices, step.levels) <= MOST_ON_SHAPE
    }

    /// Takes what a base mesh of so many faces costs, split so many times.
    pub(crate) fn spend(&mut self, base_faces: usize, levels: u32) {
        self.work = self.work.saturating_add(work_on(base_faces, levels));
    }
}

/// The work on a result on so many base faces.
fn work_on(base_faces: usize, levels: u32) -> u64 {
    finest(base_faces, levels).saturating_add(OF_A_BASE_FACE * base_faces as u64)
}

/// Triangles of the finest level on so many base faces.
fn finest(base_faces: usize, levels: u32) -> u64 {
    4u64.saturating_pow(levels).saturating_mul(base_faces as u64)
}

/// The stage that a candidate comes to, and may not be worth.
#[derive(Clone, Copy)]
pub(crate) enum NextStage {
    /// The relaxation of the finest level.
    Relax,
    /// The mending of places.
    Mend,
    /// Snapping to bends and minor creases.
    Snap,
}

impl NextStage {
    /// Fails where so many of the triangles are folded that the stages to come can't mend them.
    pub(crate) fn is_worth(self, folded: usize, triangles: usize) -> Result<(), Error> {
        let bound = match self {
            Self::Relax => TO_RELAX,
            Self::Mend => TO_MEND,
            Self::Snap => TO_SNAP,
        };
        let most = bound.at(triangles);
        if folded as f64 > most * triangles as f64 { Err(Error::Folded { folded, triangles }) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A result with fewer folded triangles is never given up where one with more goes on, and no bound jumps with the size.
    #[test]
    fn hope_falls_steadily_with_folds_and_with_size() {
        for stage in [NextStage::Relax, NextStage::Mend, NextStage::Snap] {
            for triangles in [1_000, 20_000, 49_999, 50_000, 50_001, 400_000] {
                let goes_on: Vec<bool> = (0..triangles / 10).step_by(7).map(|n| stage.is_worth(n, triangles).is_ok()).collect();
                assert!(goes_on[0] && goes_on.windows(2).all(|pair| pair[0] >= pair[1]));
            }
        }
        for bound in [TO_RELAX, TO_MEND, TO_SNAP] {
            let at: Vec<f64> = (10..80_000).step_by(10).map(|n| bound.at(n)).collect();
            assert!(at.windows(2).all(|pair| pair[1] <= pair[0] && pair[1] > 0.99 * pair[0]));
        }
    }
}
