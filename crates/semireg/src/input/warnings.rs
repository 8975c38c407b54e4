//! What cleaning did, or left, that a person sees.

use super::Input;
use certify::accepted_distance;
use mesh_core::Cleaned;

impl Input {
    /// What is to be told of the input beside its repairs.
    pub(crate) fn warnings(&self) -> impl Iterator<Item = String> + use<> {
        wide_flaps(&self.cleaned).into_iter().chain(open_t_vertices(&self.cleaned))
    }
}

/// Where what was dropped as a fold without inside is large enough to be seen in a picture of the whole.
fn wide_flaps(cleaned: &Cleaned) -> Option<String> {
    let (n, width, diagonal) = (cleaned.report.flaps, cleaned.report.flap_width, cleaned.mesh.diagonal());
    (width > accepted_distance(diagonal, 0.0)).then(|| {
        let percent = 100.0 * width / diagonal;
        format!("{n} triangles that lie on each other were dropped, up to {percent:.1} % of the diagonal wide: give them a thickness if they shall stay")
    })
}

/// Where the surface is open at vertices that have none opposite.
fn open_t_vertices(cleaned: &Cleaned) -> Option<String> {
    let n = cleaned.report.open_t_vertices;
    (n > 0).then(|| format!("{n} vertices lie on the edge of a triangle that has none there: the surface is open along it (--close-t-vertices closes it)"))
}
