//! How many base vertices are asked for where the user gives no number.

use crate::{Error, Options};
use mesh_core::{Cleaned, VertexId, equilateral_edge_length};

/// With fewer base vertices, fillets and rims of parts come out ragged, and narrow strips in long triangles. More takes longer. Measured at two
/// levels on 41 parts and small inputs: 23 are right with 500 base vertices, 31 with 1,000.
const LEAST: usize = 1_000;
/// Share of the input's vertices, for dense scans.
const SHARE: f64 = 0.016;
/// Corners and curves take one base vertex in so many.
const TIMES_NEEDED: usize = 3;
/// More is asked for only on request: time and size grow with it.
const MOST: usize = 2_000;

/// The number of base vertices for a cleaned input: what corners and curves need, three times, and at least 1,000; for dense scans 1.6 % of
/// their vertices; at most 2,000.
pub(super) fn default_base_vertices(cleaned: &Cleaned, marked: &[[VertexId; 2]], options: &Options) -> Result<usize, Error> {
    let Cleaned { mesh, topology, .. } = cleaned;
    let least = ((SHARE * mesh.n_vertices() as f64) as usize).clamp(LEAST, MOST);
    let base_edge_length = equilateral_edge_length(mesh.total_area(), least);
    let network = features::detect(mesh, topology, marked, base_edge_length, &options.features)?;
    let needed = network.least_base(topology).vertices;
    Ok((TIMES_NEEDED * needed).clamp(least, MOST))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh_core::{CleanOptions, clean};

    /// A box takes the least there is; a block with many cylindrical holes three times what its rims take; a dense sphere its share.
    #[test]
    fn the_default_follows_curves_and_scans() {
        let default = |mesh: &mesh_core::TriMesh| {
            let cleaned = clean(&mesh.to_soup(), &CleanOptions::default()).unwrap();
            (default_base_vertices(&cleaned, &[], &Options::default()).unwrap(), cleaned)
        };
        assert_eq!(default(&fixtures::cube(2)).0, LEAST);
        let (asked, cleaned) = default(&fixtures::brick(24));
        let network = features::detect(&cleaned.mesh, &cleaned.topology, &[], 0.1, &Default::default()).unwrap();
        assert!(asked >= LEAST.max(2 * network.corners.len()) && asked <= MOST, "{asked}");
        let dense = fixtures::icosphere(96);
        assert_eq!(default(&dense).0, (SHARE * dense.n_vertices() as f64) as usize);
    }
}
