//! Results with so many vertices or triangles, or edges of a length.

use super::search::{Search, can_size_help};
use crate::Error;
use crate::remeshed::Remeshed;

/// Tries at most. The first one is right where corners and curves take no more base vertices than it has.
const TRIES: usize = 4;

/// What a result has an amount of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    Vertices,
    Triangles,
    /// The mean, in the units of the input.
    EdgeLength,
}

/// An amount that a result shall have.
pub(super) struct Wanted {
    pub(super) measure: Measure,
    pub(super) amount: f64,
}

impl Wanted {
    /// What a result has over what it shall have.
    fn ratio(&self, remeshed: &Remeshed) -> f64 {
        let mesh = &remeshed.mesh;
        let has = match self.measure {
            Measure::Vertices => mesh.n_vertices() as f64,
            Measure::Triangles => mesh.n_faces() as f64,
            Measure::EdgeLength => certify::mean_edge(mesh),
        };
        has / self.amount
    }

    /// What a result has of triangles over what it shall have, from the ratio of the measure.
    fn of_triangles(&self, ratio: f64) -> f64 {
        if self.measure == Measure::EdgeLength { ratio.powi(-2) } else { ratio }
    }

    /// What is promised: results are as large as they shall be to within this share.
    fn promised(&self) -> f64 {
        if self.measure == Measure::EdgeLength { 0.05 } else { 0.03 }
    }

    /// Within this share no further try is made.
    fn near(&self) -> f64 {
        0.4 * self.promised()
    }

    /// A warning where a result is not as large as it shall be.
    fn missed(&self, ratio: f64, levels_given: bool) -> Option<String> {
        let Self { measure, amount } = self;
        let asked = match measure {
            Measure::Vertices => format!("{amount} vertices"),
            Measure::Triangles => format!("{amount} triangles"),
            Measure::EdgeLength => format!("a mean edge length of {amount}"),
        };
        let remedy = if levels_given { "; fewer levels would meet it more closely" } else { "" };
        let missed = || format!("asked for {asked}, made {ratio:.3} times that, as corners, curves and shape take it{remedy}");
        (ratio.ln().abs() > (1.0 + self.promised()).ln()).then(missed)
    }
}

impl Search<'_> {
    /// The result whose size comes nearest to what is wanted.
    pub(super) fn sized(&mut self, wanted: &Wanted) -> Result<Remeshed, Error> {
        let first = match wanted.measure {
            Measure::Vertices => self.extent.triangles(wanted.amount),
            Measure::Triangles => wanted.amount,
            Measure::EdgeLength => self.extent.triangles_of_edge(wanted.amount),
        };
        let (mut triangles, mut levels) = (first, self.levels(first));
        let mut nearest: Option<(f64, Remeshed)> = None;
        let mut failure = None;
        for _ in 0..TRIES {
            let split = self.extent.split(triangles, levels);
            if self.was_tried(split) {
                break;
            }
            let is_base_too_small = match self.made(split, None) {
                Ok(remeshed) => {
                    let ratio = wanted.ratio(&remeshed);
                    let took_more = remeshed.report.base.made > split.base_vertices;
                    triangles /= wanted.of_triangles(ratio);
                    if nearest.as_ref().is_none_or(|(other, _)| ratio.ln().abs() < other.ln().abs()) {
                        nearest = Some((ratio, remeshed));
                    }
                    if ratio.ln().abs() <= wanted.near() {
                        break;
                    }
                    took_more
                }
                Err(error) if can_size_help(&error) => {
                    failure = Some(error);
                    true
                }
                Err(error) => return Err(error),
            };
            // With fewer splits the base mesh has more vertices: as many as corners, curves and shape take.
            if is_base_too_small && self.levels.is_none() && levels > 0 {
                (triangles, levels) = (first, levels - 1);
            }
        }
        let Some((ratio, mut remeshed)) = nearest else {
            return Err(failure.unwrap_or(Error::NotCertified("nothing was tried".into())));
        };
        remeshed.report.warnings.extend(wanted.missed(ratio, self.levels.is_some()));
        Ok(remeshed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Goal, Options, Target, remesh_to};
    use mesh_core::TriMesh;
    use std::ops::ControlFlow;

    fn reached(mesh: &TriMesh, target: Target, levels: Option<u32>) -> Remeshed {
        remesh_to(&mesh.to_soup(), &Goal { target, levels }, &Options::default(), &mut |_| ControlFlow::Continue(())).unwrap()
    }

    /// Closed and open surfaces, with and without creases: numbers within 3 %, lengths within 5 %.
    #[test]
    fn results_are_as_large_as_they_shall_be() {
        for mesh in [fixtures::torus(1.0, 0.4, 40, 20), fixtures::cube(6), fixtures::cylinder(0.5, 1.0, 32)] {
            let vertices = reached(&mesh, Target::Vertices(1_500), None).mesh.n_vertices() as f64;
            assert!((vertices / 1_500.0 - 1.0).abs() < 0.03, "{vertices}");
            let triangles = reached(&mesh, Target::Triangles(1_500), Some(2)).mesh.n_faces() as f64;
            assert!((triangles / 1_500.0 - 1.0).abs() < 0.03, "{triangles}");
            let wanted = 0.03 * mesh.diagonal();
            let edge = certify::mean_edge(&reached(&mesh, Target::EdgeLength(wanted), None).mesh);
            assert!((edge / wanted - 1.0).abs() < 0.05, "{edge} {wanted}");
        }
    }

    /// A brick with many holes takes hundreds of base vertices for its rims: two splits of fewer are not to be had, and one split is taken.
    #[test]
    fn curves_that_take_more_base_vertices_get_fewer_levels() {
        let mesh = fixtures::brick(12);
        let remeshed = reached(&mesh, Target::Vertices(1_200), None);
        assert!(!remeshed.report.sizes.is_empty());
        let off = remeshed.mesh.n_vertices() as f64 / 1_200.0;
        let is_told = remeshed.report.warnings.iter().any(|w| w.contains("asked for 1200 vertices"));
        assert!((off - 1.0).abs() < 0.03 || is_told, "{off} {:?}", remeshed.report.sizes);
    }
}
