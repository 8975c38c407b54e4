//! Points spread evenly over a patch by area: what the Voronoi cells are made of.
//!
//! The paper clusters the vertices of the input. Cells then depend on where the scanner put more of them, and a plane of two triangles has
//! no vertex inside that could be a site. Points spread by area have neither fault.

use glam::{DVec2, DVec3};
use mesh_core::{FaceId, SurfacePoint, TriMesh};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use region_map::Sizing;

/// A point that a site may sit at, with its weight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) point: SurfacePoint,
    pub(crate) position: DVec3,
    /// The density function of eq. 5, `h^-4` at relative edge length `h`. Edges of length `h` want `h^-2` sites to an area, and in the
    /// plane those of a centroidal Voronoi tessellation are as dense as the root of its density function (Du, Faber and Gunzburger,
    /// *Centroidal Voronoi tessellations*, 1999).
    pub(crate) weight: f64,
}

/// The generators of the R2 sequence (powers of the inverse plastic number): well spread in the unit square.
const R2: DVec2 = DVec2::new(0.754_877_666_246_692_8, 0.569_840_290_998_053_2);

/// `n` points, one in each of `n` parts of equal area along the faces in order.
pub(crate) fn spread(mesh: &TriMesh, faces: &[FaceId], sizing: &Sizing, n: usize, seed: u64) -> Vec<Candidate> {
    let areas: Vec<f64> = faces.iter().map(|&f| mesh.area(f)).collect();
    let step = areas.iter().sum::<f64>() / n as f64;
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut shift = DVec2::new(unit(&mut random), unit(&mut random));
    let mut candidates = Vec::with_capacity(n);
    let mut next = 0.5 * step;
    let mut before = 0.0;
    for (&face, area) in faces.iter().zip(areas) {
        while next <= before + area && candidates.len() < n && area > 0.0 {
            shift = (shift + R2).fract();
            candidates.push(candidate(mesh, face, shift, sizing));
            next += step;
        }
        before += area;
    }
    candidates
}

fn unit(random: &mut impl Rng) -> f64 {
    random.random::<f64>()
}

/// The unit square onto a face, evenly.
fn candidate(mesh: &TriMesh, face: FaceId, at: DVec2, sizing: &Sizing) -> Candidate {
    let s = at.x.sqrt();
    let point = SurfacePoint::new(face, DVec3::new(1.0 - s, s * (1.0 - at.y), s * at.y));
    Candidate { point, position: point.position(mesh), weight: sizing.at(mesh, point).powi(-4) }
}
