//! How many base vertices and levels are asked for where the user names none.

use crate::options::USUAL_LEVELS;
use crate::{Error, Options, Split};
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

/// Where the shape takes more than that, the base mesh is split once only, and has so many vertices: the result has no more triangles, and better
/// ones. Measured: the mean quality of a screw is .59 with 2,000 vertices split twice, .84 with 8,000 split once.
const FINE: [usize; 2] = [4_000, 8_000];
/// Even where that is more, corners and curves get this factor more vertices than they need. Measured: the mean quality of a sponge of 7,900 is
/// .69 with 8,300 and .85 with 12,000.
const SPARE: f64 = 1.5;
/// Corners and curves get so many vertices at most without being asked for: more takes minutes.
const MOST_NEEDED: usize = 12_000;

/// The size for a cleaned input: what corners and curves need, three times, and at least 1,000 base vertices; for dense scans 1.6 % of
/// their vertices; more for narrow strips; at most 2,000, split twice. Where corners, curves and strips take more, and levels are left to us, up to
/// 8,000 or what they need, split once.
pub(super) fn default_size(cleaned: &Cleaned, marked: &[[VertexId; 2]], options: &Options) -> Result<Split, Error> {
    let Cleaned { mesh, topology, .. } = cleaned;
    let demand = |base_vertices: usize| {
        let base_edge_length = equilateral_edge_length(mesh.total_area(), base_vertices);
        let network = features::detect(mesh, topology, marked, base_edge_length, &options.feature_options(base_edge_length))?;
        let strips = SHARE_OF_STRIPS * on_strips(mesh, topology, &network, NARROW * base_edge_length);
        Ok::<_, Error>(Demand { needed: network.least_base(topology).vertices, strips: strips as usize })
    };
    let least = ((SHARE * mesh.n_vertices() as f64) as usize).clamp(LEAST, MOST);
    let wanted = demand(least)?.vertices(least);
    if wanted <= MOST || options.levels.is_some() {
        return Ok(Split { base_vertices: wanted.min(MOST), levels: options.levels() });
    }
    let [least, most] = FINE;
    // With shorter edges more of the creases are kept.
    let demand = demand(most)?;
    let needed = (SPARE * demand.needed as f64) as usize;
    let base_vertices = demand.vertices(least).min(most).max(needed.min(MOST_NEEDED));
    Ok(Split { base_vertices, levels: USUAL_LEVELS - 1 })
}

/// The base vertices that a shape takes.
struct Demand {
    /// By corners and curves.
    needed: usize,
    /// By narrow strips.
    strips: usize,
}

impl Demand {
    fn vertices(&self, least: usize) -> usize {
        (TIMES_NEEDED * self.needed).max(least) + self.strips
    }
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
            (default_size(&cleaned, &[], &Options::default()).unwrap().base_vertices, cleaned)
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
        let asked = default_size(&cleaned, &[], &Options::default()).unwrap().base_vertices;
        assert!((LEAST..=MOST).contains(&asked), "{asked}");
    }
}
