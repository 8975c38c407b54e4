//! Arcs become minor creases again: the way back.

use crate::SnapError;
use crate::assignment::Assignment;
use crate::retarget::{attach, sheets, with_moved_spans};
use mesh_core::{IdVec, VertexId};
use region_map::{ArcId, ArcKind, Attachment, CornerId, Domain, Network, Surface};
use std::collections::BTreeSet;

/// Makes minor creases of some arcs. The vertices of the domain that were on them, and at corners where no other arc ends, are inside
/// a sheet from then on; nothing moves. Sheets that met along such an arc are one.
///
/// For creases that a domain cannot follow: its triangles may turn over beside noise that was taken for a crease. Afterwards [`snap`](crate::snap)
/// may follow them in part. Borders stay: a domain ends there.
///
/// Fails where the domain does not fit the surface.
pub fn release(surface: &Surface, domain: &Domain, arcs: &BTreeSet<ArcId>) -> Result<(Surface, Domain), SnapError> {
    domain.check(surface.network())?;
    let network = coarser_network(surface, arcs)?;
    let assignment = Assignment::new(surface, domain);
    let mut region = with_moved_spans(&assignment, &network);
    region.sheet_of_face = sheets(&domain.topology, &network, &region);
    for v in region.vertices() {
        if let Some(f) = domain.topology.faces_at(v).next() {
            region.attachments[v] = Attachment::Sheet(region.sheet_of_face[f]);
        }
    }
    attach(&network, &assignment, &mut region);
    region.check(&domain.topology, &network)?;
    Ok((surface.with_network(network)?, Domain { region, ..domain.clone() }))
}

fn coarser_network(surface: &Surface, arcs: &BTreeSet<ArcId>) -> Result<Network, SnapError> {
    let network = surface.network();
    let is_released = |a: &ArcId| arcs.contains(a) && network.arcs[*a].kind != ArcKind::Border;
    let (released, kept): (Vec<ArcId>, Vec<ArcId>) = network.arcs.ids().partition(is_released);
    let ends =
        |arcs: &[ArcId]| -> BTreeSet<CornerId> { arcs.iter().filter_map(|&a| network.arcs[a].corners).flatten().collect() };
    let (ends_of_released, ends_of_kept) = (ends(&released), ends(&kept));
    let is_left = |c: CornerId| ends_of_kept.contains(&c) || !ends_of_released.contains(&c);
    let is_corner = |v: VertexId| network.corner_of_vertex[v].is_some_and(is_left);
    let kind = |a: ArcId| (!is_released(&a)).then_some(network.arcs[a].kind);
    let kinds: IdVec<_, Option<ArcKind>> = network.arc_of_edge.iter().map(|arc| arc.and_then(kind)).collect();
    let chains = released.iter().map(|&a| network.arcs[a].vertices.clone());
    let minor = network.minor.iter().cloned().chain(chains).collect();
    Ok(Network::trace(surface.mesh(), surface.topology(), &kinds, is_corner, minor)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(surface: &Surface) -> [usize; 4] {
        let network = surface.network();
        [network.corners.len(), network.arcs.len(), network.n_sheets, network.minor.len()]
    }

    /// A cube over itself: an edge whose ends have other arcs leaves its corners, all edges leave none.
    #[test]
    fn sheets_along_a_released_arc_are_one_and_corners_without_arcs_go() {
        let surface = Surface::with_creases(fixtures::cube(4), 40.0).unwrap();
        let domain = Domain::identity(&surface);
        assert_eq!(counts(&surface), [8, 12, 6, 0]);
        for n in 0..=12 {
            let arcs: BTreeSet<ArcId> = surface.network().arcs.ids().take(n).collect();
            let (released, after) = release(&surface, &domain, &arcs).unwrap();
            after.check(released.network()).unwrap();
            assert_eq!(after.mesh.positions().as_slice(), domain.mesh.positions().as_slice());
            let [corners, n_arcs, n_sheets, n_minor] = counts(&released);
            assert_eq!((n_arcs, n_minor), (12 - n, n));
            match n {
                0 => assert_eq!((corners, n_sheets), (8, 6)),
                1 => assert_eq!((corners, n_sheets), (8, 5)),
                12 => assert_eq!((corners, n_sheets), (0, 1)),
                _ => {}
            }
        }
    }

    /// The rims of a cylinder are closed arcs without a corner. What was released can be snapped to.
    #[test]
    fn a_released_rim_can_be_followed_again() {
        let surface = Surface::with_creases(fixtures::cylinder(0.5, 1.5, 48), 40.0).unwrap();
        let domain = Domain::identity(&surface);
        let rim = surface.network().arcs.ids().take(1).collect();
        let (released, after) = release(&surface, &domain, &rim).unwrap();
        assert_eq!(counts(&released), [0, 1, 2, 1]);
        let options = crate::SnapOptions { least_depth: 0.0, ..Default::default() };
        let again = crate::snap(&released, &after, &BTreeSet::new(), &crate::LetGo::default(), &options).unwrap();
        assert!(!again.tracks.is_empty());
    }

    /// A square of 4 x 4 cells has a border and nothing else.
    #[test]
    fn borders_are_kept() {
        let positions = (0..25).map(|i| [f64::from(i % 5), f64::from(i / 5), 0.0].into()).collect();
        let cells = (0..16).map(|i| i / 4 * 5 + i % 4);
        let faces = cells.flat_map(|a| [[a, a + 1, a + 6], [a, a + 6, a + 5]]).collect();
        let surface = Surface::smooth(mesh_core::TriMesh::new(positions, faces).unwrap()).unwrap();
        let arcs: BTreeSet<ArcId> = surface.network().arcs.ids().collect();
        let (released, _) = release(&surface, &Domain::identity(&surface), &arcs).unwrap();
        assert!(!arcs.is_empty());
        assert_eq!(counts(&released), counts(&surface));
    }
}
