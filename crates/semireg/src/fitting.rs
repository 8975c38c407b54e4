//! The fit and the certificate: what the fit has spoilt is left out of it.

use crate::{Error, Options, StageSeconds};
use certify::Certificate;
use fit::{FitReport, Fitted};
use mesh_core::{IdVec, Topology, TriMesh, VertexId};
use region_map::{RegionMap, Surface};

/// So often the fit is tried, each time with the triangles left alone that it turned over before.
const TRIES: usize = 3;

/// A certified mesh.
pub(crate) struct Certified {
    pub(crate) mesh: TriMesh,
    pub(crate) map: RegionMap,
    pub(crate) offsets: IdVec<VertexId, f64>,
    /// `None` where no fit was asked for.
    pub(crate) fit: Option<FitReport>,
    pub(crate) certificate: Certificate,
    /// What did not go as usual.
    pub(crate) warning: Option<String>,
}

/// Fits the domain, where the options ask for it, and certifies it against the cleaned input.
pub(crate) fn fit_and_certify(
    surface: &Surface,
    cleaned: &TriMesh,
    (mesh, map): (TriMesh, RegionMap),
    topology: &Topology,
    options: &Options,
    seconds: &mut StageSeconds,
) -> Result<Certified, Error> {
    let mut warning = None;
    if let Some(fit_options) = &options.fit {
        let mut fit_options = fit_options.clone();
        for _ in 0..TRIES {
            let fitted = seconds.time("fit", || fit::fit(surface, &mesh, topology, &map, &fit_options))?;
            let certificate = certificate(cleaned, &fitted.mesh, options, seconds)?;
            let Fitted { mesh: fitted_mesh, map: fitted_map, offsets, report } = fitted;
            match certificate.failures().first() {
                Some(failure) if report.used => warning = Some(format!("the fit was left out: with it, {failure}")),
                _ => {
                    let (mesh, map, fit) = (fitted_mesh, fitted_map, Some(report));
                    return passed(Certified { mesh, map, offsets, fit, certificate, warning: None });
                }
            }
            match certificate.measures.flipped {
                Some(flipped) if !flipped.is_empty() => fit_options.still.extend(flipped),
                _ => break,
            }
        }
    }
    let certificate = certificate(cleaned, &mesh, options, seconds)?;
    let fit = options.fit.as_ref().map(|_| FitReport::default());
    let offsets = IdVec::filled(0.0, mesh.n_vertices());
    passed(Certified { mesh, map, offsets, fit, certificate, warning })
}

fn certificate(cleaned: &TriMesh, mesh: &TriMesh, options: &Options, seconds: &mut StageSeconds) -> Result<Certificate, Error> {
    Ok(seconds.time("certify", || certify::certify(cleaned, mesh, options.levels, &Default::default()))?)
}

fn passed(certified: Certified) -> Result<Certified, Error> {
    match certified.certificate.failures().first() {
        Some(failure) => Err(Error::NotCertified(failure.to_string())),
        None => Ok(certified),
    }
}
