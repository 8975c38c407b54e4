//! [`Search`]: results of different sizes, and what came of each.

use super::split::{Extent, SizeTry, Split};
use crate::remeshed::Remeshed;
use crate::{Error, Options};

/// Makes a result with some options.
pub(crate) type Make<'a> = dyn FnMut(&Options) -> Result<Remeshed, Error> + 'a;

/// A search for the right size under way.
pub(super) struct Search<'a> {
    pub(super) extent: Extent,
    /// `None` where they are left to us.
    pub(super) levels: Option<u32>,
    options: &'a Options,
    make: &'a mut Make<'a>,
    tries: Vec<SizeTry>,
}

impl<'a> Search<'a> {
    pub(super) fn new(extent: Extent, levels: Option<u32>, options: &'a Options, make: &'a mut Make<'a>) -> Self {
        Self { extent, levels, options, make, tries: Vec::new() }
    }

    /// What was tried.
    pub(super) fn end(self) -> Vec<SizeTry> {
        self.tries
    }

    /// A result on a base mesh of this size, refined where it is farther away than `max_distance`, a share of the diagonal.
    pub(super) fn made(&mut self, split: Split, max_distance: Option<f64>) -> Result<Remeshed, Error> {
        let Split { base_vertices, levels } = split;
        let sized = Options { base_vertices: Some(base_vertices), levels: Some(levels), max_distance, ..self.options.clone() };
        let made = (self.make)(&sized);
        let of_made = made.as_ref().ok();
        let (triangles, error) = (of_made.map(|r| r.mesh.n_faces()), of_made.map(greatest_error));
        self.tries.push(SizeTry { split, triangles, error });
        made
    }

    /// Levels for so many triangles.
    pub(super) fn levels(&self, triangles: f64) -> u32 {
        self.levels.unwrap_or_else(|| self.extent.levels(triangles))
    }

    pub(super) fn was_tried(&self, split: Split) -> bool {
        self.tries.iter().any(|earlier| earlier.split == split)
    }
}

/// The greatest distance from the input, either way, as a share of its diagonal.
pub(super) fn greatest_error(remeshed: &Remeshed) -> f64 {
    remeshed.report.certificate.measures.distance.worse().max
}

/// Whether another size may lead to a result where this error came of one.
pub(super) fn can_size_help(error: &Error) -> bool {
    matches!(error, Error::NotCertified(_) | Error::Folded { .. } | Error::Base(_) | Error::TooLarge { .. })
}
