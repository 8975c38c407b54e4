//! How many base vertices are asked for where the user gives no number.

use crate::{Error, Options};
use mesh_core::{Cleaned, Id as _, Topology, TriMesh, VertexId, equilateral_edge_length};
use region_map::Network;

/// With fewer base vertices, fillets and rims of parts come out ragged, and narrow strips in long triangles. More takes longer. Measured at two
/// levels on 41 parts and small inputs: 23 are right with 500 base vertices, 31 with 1,000.
const LEAST: usize = 1_000;
/// Share of the input's vertices, for dense scans.
const SHARE: f64 = 0.016;
/// Corners and curves take one base vertex in so many.
const TIMES_NEEDED: usize = 3;
/// A sheet narrower than this share of a base edge is a strip. Its triangles are poor with edges of that length.
const NARROW: f64 = 0.5;
/// Strips get this share of the vertices that triangles as high as they are wide would have on their rims. More gives better triangles in
/// them, and everywhere takes longer.
const SHARE_OF_STRIPS: f64 = 0.6;
/// More is asked for only on request: time and size grow with it.
const MOST: usize = 2_000;

/// The number of base vertices for a cleaned input: what corners and curves need, three times, and at least 1,000; for dense scans 1.6 % of
/// their vertices; more for narrow strips; at most 2,000.
pub(super) fn default_base_vertices(cleaned: &Cleaned, marked: &[[VertexId; 2]], options: &Options) -> Result<usize, Error> {
    let Cleaned { mesh, topology, .. } = cleaned;
    let least = ((SHARE * mesh.n_vertices() as f64) as usize).clamp(LEAST, MOST);
    let base_edge_length = equilateral_edge_length(mesh.total_area(), least);
    let network = features::detect(mesh, topology, marked, base_edge_length, &options.features)?;
    let needed = network.least_base(topology).vertices;
    let of_strips = SHARE_OF_STRIPS * on_strips(mesh, topology, &network, NARROW * base_edge_length);
    Ok(((TIMES_NEEDED * needed).max(least) + of_strips as usize).min(MOST))
}

/// How many vertices the rims of strips have where they are as far apart as the strip is wide: of all sheets that are narrower than `narrow`.
fn on_strips(mesh: &TriMesh, topology: &Topology, network: &Network, narrow: f64) -> f64 {
    let mut areas = vec![0.0; network.n_sheets];
    let mut rims = vec![0.0; network.n_sheets];
    for (f, sheet) in network.sheet_of_face.enumerate() {
        areas[sheet.index()] += mesh.area(f);
        let on_rim = topology.halfedges(f).into_iter().filter(|&h| network.is_barrier(topology.edge(h)));
        rims[sheet.index()] += on_rim.map(|h| mesh.distance(topology.from(h), topology.to(h))).sum::<f64>();
    }
    // A strip of width w and length l has the area w l, and rims of 2 l together.
    let widths = areas.iter().zip(&rims).map(|(area, &rim)| (2.0 * area / rim, rim));
    widths.filter(|(width, rim)| *rim > 0.0 && *width > 0.0 && *width < narrow).map(|(width, rim)| rim / width).sum()
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

    /// The four narrow sides of a board of 1 by 1 by .1 are strips .1 wide or a little less, with rims of 2.2 each.
    #[test]
    fn narrow_sides_of_a_board_are_strips() {
        let board = fixtures::cuboid(glam::DVec3::new(1.0, 1.0, 0.1), 4);
        let topology = Topology::new(board.faces(), board.n_vertices()).unwrap();
        let network = features::detect(&board, &topology, &[], 0.01, &Default::default()).unwrap();
        let on_strips = |narrow| on_strips(&board, &topology, &network, narrow);
        let width = 2.0 * 0.1 / 2.2;
        assert!((on_strips(0.2) - 4.0 * 2.2 / width).abs() < 1e-9, "{}", on_strips(0.2));
        assert_eq!(on_strips(0.05), 0.0);
        let cleaned = clean(&board.to_soup(), &CleanOptions::default()).unwrap();
        let asked = default_base_vertices(&cleaned, &[], &Options::default()).unwrap();
        assert!((LEAST..=MOST).contains(&asked), "{asked}");
    }
}
