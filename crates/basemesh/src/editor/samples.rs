//! Which part of the surface every base face covers: samples of the working mesh, one in the middle of each of its faces.
//!
//! To ask the map where a point lies takes long where there were many edits. So each edit moves the samples of the few faces that it
//! replaces to the new ones (Lee et al., *MAPS*, 1998), and a base face always knows the normals of the surface that it covers.

use super::layout::deepest;
use glam::{DVec2, DVec3};
use mesh_core::{IdVec, SurfacePoint};
use region_map::{BaseMap, MapFaceId, Surface};
use std::sync::Arc;

/// A base face may face against at most this share of the surface that it covers: with more, its subdivisions fold there.
pub(crate) const MOST_TURNED: f64 = 0.1;
/// A face counts as facing against the surface where the normals are more than 75 degrees apart: the cosine of that angle.
const TURNED_COSINE: f64 = 0.26;

/// A sample in a base face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    sample: u32,
    /// Barycentric coordinates in the face of the map.
    at: DVec3,
}

/// A sample for each working face, at its middle: unit normal and area.
#[derive(Clone, Debug)]
pub(crate) struct Samples(Arc<Vec<(DVec3, f64)>>);

impl Samples {
    /// The samples of a working mesh, and those in each face of the map.
    pub(crate) fn new(surface: &Surface, map: &BaseMap, n_map_faces: usize) -> (Self, IdVec<MapFaceId, Vec<Placed>>) {
        let mesh = surface.mesh();
        let mut content = IdVec::filled(Vec::new(), n_map_faces);
        let mut samples = Vec::with_capacity(mesh.n_faces());
        for f in mesh.faces().ids() {
            let middle = SurfacePoint::new(f, DVec3::splat(1.0 / 3.0));
            if let Some((face, at)) = map.find(middle) {
                content[face].push(Placed { sample: f.0, at });
            }
            samples.push((surface.normals().at(middle), mesh.area(f)));
        }
        (Self(Arc::new(samples)), content)
    }

    /// The mean normal of what a face covers, `None` where it covers no sample.
    pub(crate) fn mean_normal(&self, covered: &[Placed]) -> Option<DVec3> {
        let sum: DVec3 = covered.iter().map(|p| self.0[p.sample as usize]).map(|(normal, area)| area * normal).sum();
        sum.try_normalize()
    }

    /// The share of what a face covers that a face with this normal faces against.
    pub(crate) fn turned_share(&self, covered: &[Placed], normal: DVec3) -> f64 {
        let (mut all, mut turned) = (0.0, 0.0);
        for (there, area) in covered.iter().map(|p| self.0[p.sample as usize]) {
            all += area;
            turned += if there.dot(normal) < TURNED_COSINE { area } else { 0.0 };
        }
        if all > 0.0 { turned / all } else { 0.0 }
    }
}

/// Moves samples from flat triangles to others that fill the same polygon.
pub(crate) fn moved<'p>(old: impl Iterator<Item = (&'p [Placed], [DVec2; 3])>, new: &[[DVec2; 3]]) -> Vec<Vec<Placed>> {
    let mut moved = vec![Vec::new(); new.len()];
    for (covered, layout) in old {
        for p in covered {
            let place = p.at.x * layout[0] + p.at.y * layout[1] + p.at.z * layout[2];
            let Some((i, at)) = deepest(new, place) else { continue };
            let at = at.max(DVec3::ZERO);
            moved[i].push(Placed { sample: p.sample, at: at / at.element_sum() });
        }
    }
    moved
}
