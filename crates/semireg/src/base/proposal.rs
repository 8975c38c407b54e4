//! [`Proposal`]: a base mesh whose turn may come.

use super::search::{Found, Search};
use super::stages::{Base, BaseStages};
use crate::run::Run;
use crate::{Error, Options};
use std::sync::Arc;

/// A base mesh with all before it. The search for better connectivity, the dearest stage on the way to it, waits until its turn comes: on 9
/// of 9 models the order of ratings before the search was that after it.
pub(crate) struct Proposal {
    stages: BaseStages,
    /// `None` for a base mesh that stays as it is.
    search: Option<Search>,
}

impl Proposal {
    pub(super) fn new(stages: BaseStages, search: Option<Search>) -> Self {
        Self { stages, search }
    }

    /// The base mesh as it is before the search, which keeps its numbers of vertices and faces.
    pub(crate) fn stages(&self) -> &BaseStages {
        &self.stages
    }

    /// The base mesh after the search.
    pub(crate) fn searched(self, options: &Options, run: &mut Run) -> Result<BaseStages, Error> {
        let Self { mut stages, search } = self;
        let (Some(search), Some(base)) = (search, stages.base.mapped()) else { return Ok(stages) };
        let (surface, asked) = (&stages.surface, stages.counts.asked);
        let Found { base, faults } = run.stage("search", || Ok::<_, Error>(search.run(surface, base, asked, options)))?;
        stages.warnings.extend(faults);
        if let Some(base) = base {
            stages.base = Arc::new(Base::Mapped(base));
        }
        Ok(stages)
    }
}
