//! The verb for base meshes: flips of base edges that lower the energy of the relaxed first subdivision.
//!
//! What a base mesh is good for shows only in what it can be relaxed to. So every flip is tried where that is seen first: the faces
//! around are relaxed with their border held, and the flip is good if their energy falls. The surface needs no map for that, as the
//! middles of the base edges are on it already.

mod coarse;
mod flip;
mod part;

use crate::domain::Domain;
use crate::placement::Placement;
use crate::{RelaxError, ShapeOptions};
use coarse::{Change, Coarse, FaceIndex};
use flip::flip;
use mesh_core::{Topology, VertexId};
use part::{RelaxedPart, relaxed};
use rayon::prelude::*;
use region_map::{BaseEdit, RegionMap, Surface};

/// How to search.
#[derive(Clone, Debug, PartialEq)]
pub struct ReconnectOptions {
    /// The energy, and the steps that a flip is tried with.
    pub shape: ShapeOptions,
    /// Rings of base faces round the four corners of a flip that are relaxed with it, 1 or more. Default 2.
    pub rings: usize,
    /// What a flip must gain, in energies of equilateral triangles of the first subdivision. Default 0.05.
    pub least_gain: f64,
    /// Tries at most, for each base edge. Default 4.
    pub tries: usize,
}

impl Default for ReconnectOptions {
    fn default() -> Self {
        let shape = ShapeOptions { untangling_steps: 10, steps: 6, ..ShapeOptions::default() };
        Self { shape, rings: 2, least_gain: 0.05, tries: 4 }
    }
}

/// Better connectivity for a base mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reconnected {
    /// The edits, in their order.
    pub edits: Vec<BaseEdit>,
    /// The energy of the first subdivision at the start and at the end.
    pub energy: [f64; 2],
    /// Flips that were tried.
    pub tries: usize,
}

/// Finds flips of base edges that lower the shape energy of the first subdivision of a base mesh.
///
/// `topology` and `map` are those of a base mesh that was subdivided once and relaxed.
pub fn reconnect(
    surface: &Surface,
    topology: &Topology,
    map: &RegionMap,
    options: &ReconnectOptions,
) -> Result<Reconnected, RelaxError> {
    let domain = Domain::new(surface, topology, map)?;
    let placement = Placement::of_map(&domain, map);
    let mut coarse = Coarse::new(&domain, map, placement, &options.shape)?;
    let mut found = Reconnected { energy: [coarse.costs.iter().sum(); 2], ..Default::default() };
    let mut to_try = coarse.edges();
    let most = options.tries * to_try.len();
    while !to_try.is_empty() && found.tries < most {
        found.tries += to_try.len();
        let mut gains: Vec<Gain> = to_try.par_iter().filter_map(|&e| Gain::of(&coarse, e, options)).collect();
        gains.sort_by(|a, b| b.gain.total_cmp(&a.gain).then(a.edge.cmp(&b.edge)));
        let taken = take(&mut coarse, gains);
        to_try = taken.near;
        found.energy[1] -= taken.gain;
        found.edits.extend(taken.edits);
    }
    Ok(found)
}

/// A flip that lowers the energy.
struct Gain {
    edge: [VertexId; 2],
    gain: f64,
    /// The faces that are relaxed with it, in rising order.
    region: Vec<FaceIndex>,
    change: Change,
    relaxed: RelaxedPart,
}

impl Gain {
    fn of(coarse: &Coarse, edge: [VertexId; 2], options: &ReconnectOptions) -> Option<Self> {
        let change = flip(coarse, edge)?;
        let tried = (1..=options.rings).rev().find_map(|rings| {
            let region = coarse.around(&change.corners, rings);
            Some((relaxed(coarse, &region, &change, &options.shape)?, region))
        });
        let (relaxed, region) = tried?;
        let gain = coarse.cost(&region) - relaxed.costs.iter().sum::<f64>();
        (gain > options.least_gain).then_some(Self { edge, gain, region, change, relaxed })
    }
}

/// What was done in a round, and what is to be tried in the next one.
struct Taken {
    edits: Vec<BaseEdit>,
    gain: f64,
    near: Vec<[VertexId; 2]>,
}

/// Carries out the best flips (they come best first) whose regions do not meet.
fn take(coarse: &mut Coarse, gains: Vec<Gain>) -> Taken {
    let mut taken = Taken { edits: Vec::new(), gain: 0.0, near: Vec::new() };
    let mut is_changed = vec![false; coarse.faces.len()];
    let mut corners = Vec::new();
    for g in gains {
        if g.region.iter().any(|&f| is_changed[f]) {
            taken.near.push(g.edge);
            continue;
        }
        g.region.iter().for_each(|&f| is_changed[f] = true);
        coarse.apply(&g.region, &g.change, &g.relaxed);
        corners.extend(g.change.new.iter().flat_map(|f| f.corners));
        taken.edits.push(g.change.edit.clone());
        taken.gain += g.gain;
    }
    taken.near.extend(coarse.edges_of(coarse.around(&corners, 1)));
    taken.near.sort_unstable();
    taken.near.dedup();
    taken
}
