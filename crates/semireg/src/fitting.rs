//! The fit and the certificate: what the fit has spoilt is certified without it.

use crate::{Error, Options, StageSeconds};
use certify::Certificate;
use fit::{FitReport, Fitted};
use mesh_core::{IdVec, Topology, TriMesh, VertexId};
use region_map::{RegionMap, Surface};

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
        let fitted = seconds.time("fit", || fit::fit(surface, &mesh, topology, &map, fit_options))?;
        let certificate = certificate(cleaned, &fitted.mesh, options, seconds)?;
        let Fitted { mesh: fitted_mesh, map: fitted_map, offsets, report } = fitted;
        match certificate.failures().first() {
            Some(failure) if report.used => warning = Some(format!("the fit was left out: with it, {failure}")),
            _ => {
                let certified =
                    Certified { mesh: fitted_mesh, map: fitted_map, offsets, fit: Some(report), certificate, warning };
                return passed(certified);
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
