//! The relaxed domain hung on bends and minor creases, as far as its triangles bear it.

use crate::Error;
use crate::failing::Failing;
use mesh_core::Topology;
use region_map::{Network, SheetNormals, Surface};
use relax::{QuadricOptions, RelaxOptions, RelaxReport, Relaxed, ShapeOptions};
use snap::{LetGo, SnapOptions};
use std::borrow::Cow;

/// Newton steps after snapping: it moves few vertices, and from a relaxed start.
const STEPS: usize = 4;
const UNTANGLING_STEPS: usize = 8;
/// So often the domain is snapped, each time without what came out poor before. A few poor triangles of the last time are borne: they are
/// not worth all creases.
const ROUNDS: usize = 4;

/// A relaxed domain, and the network that it hangs on.
pub(crate) struct Settled<'a> {
    pub(crate) network: Cow<'a, Network>,
    pub(crate) normals: Cow<'a, SheetNormals>,
    pub(crate) relaxed: Relaxed,
    /// What the certificate would refuse of it.
    pub(crate) failing: Failing,
    /// Bends and pieces of minor creases that it was snapped to.
    pub(crate) snapped: [usize; 2],
    /// What did not go as usual.
    pub(crate) warning: Option<String>,
}

/// Snaps a domain to bends and minor creases and relaxes it again; as it was where there are none, where the certificate would refuse more
/// triangles than the `failing` ones of before, or where it fails.
pub(crate) fn settle<'a>(
    surface: &Surface<'a>,
    input: &certify::Surface,
    (relaxed, failing): (Relaxed, Failing),
    topology: &Topology,
    options: &RelaxOptions,
) -> Settled<'a> {
    let warning = match snapped(surface, input, (&relaxed, &failing), topology, options) {
        Ok(Some(settled)) if settled.failing.faces.len() <= failing.faces.len() => return settled,
        Ok(Some(_)) => Some("bends and minor creases were left as they came out: some triangles did not bear them".to_string()),
        Ok(None) => None,
        Err(e) => Some(format!("bends and minor creases were left as they came out: {e}")),
    };
    let (network, normals) = (Cow::Borrowed(surface.network), Cow::Borrowed(surface.normals));
    Settled { network, normals, relaxed, failing, snapped: [0, 0], warning }
}

fn snapped(
    surface: &Surface,
    input: &certify::Surface,
    (relaxed, before): (&Relaxed, &Failing),
    topology: &Topology,
    options: &RelaxOptions,
) -> Result<Option<Settled<'static>>, Error> {
    let few_steps = RelaxOptions {
        quadric: QuadricOptions { iterations: 0, ..options.quadric.clone() },
        shape: ShapeOptions { steps: STEPS, untangling_steps: UNTANGLING_STEPS, ..options.shape.clone() },
        ..options.clone()
    };
    let snap_options = SnapOptions::default();
    let (mut let_go, mut round) = (LetGo::default(), 1);
    loop {
        let snapped = snap::snap(surface, &relaxed.mesh, topology, &relaxed.map, &let_go, &snap_options)?;
        if snapped.is_unchanged() {
            return Ok(None);
        }
        let mut again = relax::relax(&snapped.surface(surface), &snapped.mesh, topology, &snapped.map, &few_steps)?;
        let failing = Failing::of(&again.mesh, input);
        let refused = if failing.faces.len() > before.faces.len() { failing.faces.as_slice() } else { &[] };
        let poor = snapped.poor(topology, [&relaxed.mesh, &again.mesh], refused, &snap_options);
        if poor == LetGo::default() || round == ROUNDS {
            let RelaxReport { end, shape_steps, .. } = again.report;
            again.report = RelaxReport { end, shape_steps: relaxed.report.shape_steps + shape_steps, ..relaxed.report };
            let counts = [snapped.bends.len(), snapped.tracks.len()];
            let (network, normals) = (Cow::Owned(snapped.network), Cow::Owned(snapped.normals));
            return Ok(Some(Settled { network, normals, relaxed: again, failing, snapped: counts, warning: None }));
        }
        let_go.bends.extend(poor.bends);
        let_go.minor.extend(poor.minor);
        round += 1;
    }
}
