//! The verb for base meshes: edits that lower the energy of the relaxed first subdivision.
//!
//! What a base mesh is good for shows only in what it can be relaxed to. So every edit is tried where that shows first: in the first
//! subdivision the faces around are relaxed with their border held, and the edit is good if their energy falls. No map is needed for
//! that, as the middles of the base edges are on the surface already.

mod coarse;
mod exchange;
mod flip;
mod part;
mod remove;
mod search;
mod split;

use crate::movable_domain::MovableDomain;
use crate::placement::Placement;
use crate::{RelaxError, ShapeOptions};
use coarse::Coarse;
use region_map::{BaseEdit, Domain, Sizing, Surface};
use search::Search;

/// How to search.
#[derive(Clone, Debug, PartialEq)]
pub struct ReconnectOptions {
    /// The energy, and the steps that an edit is tried with.
    pub shape: ShapeOptions,
    /// Rings of base faces round the vertices of an edit that are relaxed with it, 1 or more. Default 2: with 1 fandisk ends at a mean AR
    /// lower by .005, with 3 higher by .002.
    pub rings: usize,
    /// What a flip must gain, in energies of equilateral triangles of the first subdivision. Default 0.05.
    pub least_gain: f64,
    /// What taking a vertex away and putting one in elsewhere must gain. Default 1: below it casting began to lose parts that the
    /// first subdivision does not show (with 0.5 and more tries it failed); fandisk gains .004 of mean AR with 0.2.
    pub least_exchange_gain: f64,
    /// Tries at most, for each base edge. Default 8.
    pub tries: usize,
}

impl Default for ReconnectOptions {
    fn default() -> Self {
        let shape = ShapeOptions { untangling_steps: 10, steps: 4, ..ShapeOptions::default() };
        Self { shape, rings: 2, least_gain: 0.05, least_exchange_gain: 1.0, tries: 8 }
    }
}

/// Better connectivity for a base mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reconnected {
    /// The edits, in their order.
    pub edits: Vec<BaseEdit>,
    /// By how much the energy of the first subdivision exceeds that of equilateral triangles, at the start and at the end.
    pub energy: [f64; 2],
    /// Edits that were tried.
    pub tries: usize,
}

/// Edits a base mesh so that the shape energy of its first subdivision falls: edges are flipped, and vertices taken away while as many
/// are put in elsewhere.
///
/// `domain` is the base mesh subdivided once and relaxed. `carry_out` does each edit that is chosen in the base mesh
/// itself; where it cannot and returns false, the edit is not done. Vertices are taken away only where the sizing field asks for nothing.
/// The energy never grows.
///
/// Fails when the map does not fit the domain or the surface, and for a domain that was not subdivided once.
pub fn reconnect(
    surface: &Surface,
    domain: &Domain,
    sizing: &Sizing,
    options: &ReconnectOptions,
    carry_out: impl FnMut(&BaseEdit) -> bool + Sync,
) -> Result<Reconnected, RelaxError> {
    options.shape.check()?;
    let movable = MovableDomain::new(surface, domain)?;
    let placement = Placement::of_region(&movable, &domain.region);
    let coarse = Coarse::new(&movable, &domain.region, placement, &options.shape)?;
    let mut search = Search::new(coarse, sizing, options, carry_out);
    let mut near = search.coarse.edges();
    while !near.is_empty() && !search.is_tired() {
        search.flip_all(near);
        near = search.exchange();
    }
    Ok(search.found)
}
