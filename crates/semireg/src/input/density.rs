//! A density of the user's, as factors on the lengths of base edges.

use crate::Error;
use mesh_core::{Cleaned, FaceId, IdVec, TriMesh, VertexId, barycentric};

/// Edges get at most this factor longer or shorter by a density: where it is greater, base vertices would be missing everywhere else.
const MOST: f64 = 10.0;

/// Factors on edge lengths at the vertices of the working mesh, for densities at the vertices of the soup, whose vertices per area they are
/// proportional to. They leave the mean number of vertices per area as it is.
pub(super) fn length_factors(
    density: &[f64],
    n_soup_vertices: usize,
    cleaned: &Cleaned,
    working: &TriMesh,
    source_face: &IdVec<FaceId, FaceId>,
) -> Result<IdVec<VertexId, f64>, Error> {
    if density.len() != n_soup_vertices {
        return Err(Error::DensityCount { values: density.len(), vertices: n_soup_vertices });
    }
    if let Some(vertex) = density.iter().position(|d| !(d.is_finite() && *d > 0.0)) {
        return Err(Error::Density { vertex, value: density[vertex] });
    }
    let at = |v: VertexId| density[cleaned.source_vertex[v] as usize];
    let mut of_vertex = IdVec::filled(0.0, working.n_vertices());
    let (mut sum, mut area) = (0.0, 0.0);
    for (f, corners) in working.faces().enumerate() {
        let source = source_face[f];
        let values = cleaned.mesh.face(source).map(at);
        for &v in corners {
            let weights = barycentric(working.position(v), cleaned.mesh.triangle(source));
            // Beside the triangle, after flips in a plane, values go on as they are at its rim.
            let weights = weights.max(glam::DVec3::ZERO) / weights.max(glam::DVec3::ZERO).element_sum();
            of_vertex[v] = weights.dot(values.into());
        }
        let mean = corners.iter().map(|&v| of_vertex[v]).sum::<f64>() / 3.0;
        (sum, area) = (sum + mean * working.area(f), area + working.area(f));
    }
    let mean = sum / area;
    Ok(of_vertex.iter().map(|d| (mean / d).sqrt().clamp(1.0 / MOST, MOST)).collect())
}

#[cfg(test)]
mod tests {
    use crate::{Error, Options, remesh};
    use mesh_core::TriMesh;

    /// The share of the triangles on one half of a ball.
    fn share_above(mesh: &TriMesh) -> f64 {
        let above = mesh.faces().ids().filter(|&f| mesh.centroid(f).z > 0.0).count();
        above as f64 / mesh.n_faces() as f64
    }

    /// With four times the density on one half, four fifths of the triangles are there where lengths may change at once, and fewer where they
    /// change gradually.
    #[test]
    fn triangles_are_where_the_density_is() {
        let ball = fixtures::icosphere(30);
        let density = ball.positions().iter().map(|p| if p.z > 0.0 { 4.0 } else { 1.0 }).collect();
        let options = Options { base_vertices: Some(300), levels: Some(1), density: Some(density), ..Options::default() };
        let share = |options: &Options| share_above(&remesh(&ball.to_soup(), options).unwrap().mesh);
        let shares = [0.3, 10.0].map(|gradation| share(&Options { gradation, ..options.clone() }));
        assert!(shares[0] > 0.62 && shares[1] > shares[0] && (0.68..0.83).contains(&shares[1]), "{shares:?}");
        assert!((share(&Options { density: None, ..options }) - 0.5).abs() < 0.03);
    }

    #[test]
    fn densities_that_say_nothing_are_refused() {
        let soup = fixtures::cube(2).to_soup();
        let error = |density| remesh(&soup, &Options { density: Some(density), ..Options::default() }).unwrap_err();
        assert!(matches!(error(vec![1.0; 3]), Error::DensityCount { values: 3, .. }));
        let mut with_zero = vec![1.0; soup.positions.len()];
        with_zero[5] = 0.0;
        assert!(matches!(error(with_zero), Error::Density { vertex: 5, .. }));
    }
}
