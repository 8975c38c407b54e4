//! [`Candidate`]: what is tried, judged and mended.

use crate::Error;
use crate::base::{Base, BaseCounts, BaseStages};
use crate::nudged::{nudged, welded};
use crate::raised::Raised;
use crate::report::SnapCounts;
use crate::verdict::Verdict;
use certify::{Faults, Reference, faulty_faces};
use region_map::{Domain, Surface};
use relax::Relaxed;
use std::sync::Arc;

/// A base mesh with its finest level, and what the certificate would refuse of that.
#[derive(Clone)]
pub(crate) struct Candidate {
    /// The base mesh.
    pub(crate) base: Arc<Base>,
    /// Its vertices: asked, needed and made.
    pub(crate) counts: BaseCounts,
    /// The surface that the base mesh is over.
    pub(crate) base_surface: Surface,
    /// The surface with the network that the finest level hangs on.
    pub(crate) surface: Surface,
    /// The finest level, relaxed.
    pub(crate) relaxed: Relaxed,
    /// Its triangles that the certificate would refuse, raised as they are.
    pub(crate) faults: Faults,
    /// Vertices that stand off the surface in the end, where some of the triangles have no area on it.
    pub(crate) raised: Raised,
    /// Whether creases of the network were let go of for the finest level. The base mesh keeps them, and can't be refined any more.
    pub(crate) is_released: bool,
    /// Whether vertices were nudged, as nothing else freed some triangles.
    pub(crate) is_nudged: bool,
    /// What the finest level was snapped to.
    pub(crate) snapped: SnapCounts,
    /// Why it was not, though there is something to snap to.
    pub(crate) unsnapped: Option<String>,
}

impl Candidate {
    /// The base mesh of some stages with its finest level relaxed, judged.
    pub(crate) fn new(input: &Reference, stages: &BaseStages, relaxed: Relaxed) -> Self {
        let BaseStages { surface, base, counts, .. } = stages;
        let (raised, faults) = judged(input, surface, &relaxed.domain);
        Self {
            base: base.clone(),
            counts: counts.clone(),
            base_surface: stages.base_surface().clone(),
            surface: surface.clone(),
            relaxed,
            faults,
            raised,
            is_released: false,
            is_nudged: false,
            snapped: SnapCounts::default(),
            unsnapped: None,
        }
    }

    /// The same base mesh with another finest level over `surface`, judged.
    pub(crate) fn with(self, input: &Reference, surface: Surface, relaxed: Relaxed) -> Self {
        let (raised, faults) = judged(input, &surface, &relaxed.domain);
        Self { surface, relaxed, faults, raised, ..self }
    }

    /// The same with vertices nudged, where the certificate refuses less of it then.
    pub(crate) fn nudged(&self, input: &Reference) -> Option<Self> {
        let domain = nudged(input, &self.surface, &self.relaxed.domain, self.faults.faces())?;
        let nudged = Self { is_nudged: true, ..self.clone() };
        let after = nudged.with(input, self.surface.clone(), Relaxed { domain, ..self.relaxed.clone() });
        let refused = |c: &Self| (c.n_faults(), welded(&c.surface, &c.relaxed.domain).len());
        (refused(&after) < refused(self)).then_some(after)
    }

    /// How many triangles the certificate would refuse.
    pub(crate) fn n_faults(&self) -> usize {
        self.faults.faces().len()
    }

    /// Triangles of the finest level.
    pub(crate) fn n_triangles(&self) -> usize {
        self.relaxed.domain.mesh.n_faces()
    }

    /// Fails where the certificate would refuse triangles of it: no stage after this mends any.
    pub(crate) fn check(&self) -> Result<(), Error> {
        match self.n_faults() {
            0 => Ok(()),
            folded => Err(Error::Folded { folded, triangles: self.n_triangles() }),
        }
    }

    /// What it comes to before it is certified.
    pub(crate) fn verdict(&self) -> Verdict {
        Verdict::Faulty { faults: self.n_faults(), triangles: self.n_triangles() }
    }
}

/// What the certificate would refuse of a finest level, once the vertices are raised that had better be.
fn judged(input: &Reference, surface: &Surface, domain: &Domain) -> (Raised, Faults) {
    Raised::new(input, surface, domain, faulty_faces(input, &domain.mesh))
}
