//! Snapping on grids with creases whose places are known. `Bed::snap` checks what always holds.

use glam::DVec3;
use mesh_core::{EdgeId, IdVec, Topology, TriMesh, VertexId, walk};
use proptest::prelude::*;
use region_map::{ArcKind, ArcSpan, Attachment, Network, RegionMap, SheetNormals, Surface};
use snap::{LetGo, SnapOptions, Snapped, snap};

/// Cells of the grid along each axis.
const N: usize = 20;

/// A grid over the unit square as the surface, and as domain itself.
struct Bed {
    mesh: TriMesh,
    topology: Topology,
    network: Network,
    normals: SheetNormals,
    map: RegionMap,
}

fn vertex(x: usize, y: usize) -> VertexId {
    VertexId((y * (N + 1) + x) as u32)
}

impl Bed {
    /// A grid with these heights, a chain of marked edges and chains that were left out.
    fn new(height: impl Fn(f64, f64) -> f64, marked: &[VertexId], minor: Vec<Vec<VertexId>>) -> Self {
        let at = |i: usize| ((i % (N + 1)) as f64 / N as f64, (i / (N + 1)) as f64 / N as f64);
        let positions = (0..(N + 1) * (N + 1)).map(at).map(|(x, y)| DVec3::new(x, y, height(x, y))).collect();
        let cells = (0..N * N).map(|i| (i % N, i / N));
        let faces = cells.flat_map(|(x, y)| {
            let [a, b, c, d] = [vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)].map(|v| v.0);
            if (x + y) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
        });
        let mesh = TriMesh::new(positions, faces.collect()).unwrap();
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let border = |e| topology.is_border_edge(e).then_some(ArcKind::Border);
        let mut kinds: IdVec<EdgeId, Option<ArcKind>> = topology.edge_ids().map(border).collect();
        for w in marked.windows(2) {
            kinds[topology.find_edge(w[0], w[1]).unwrap()] = Some(ArcKind::Sharp);
        }
        let corners = [vertex(0, 0), vertex(N, 0), vertex(0, N), vertex(N, N)];
        let network = Network::trace(&mesh, &topology, &kinds, |v| corners.contains(&v), minor);
        let normals = SheetNormals::new(&mesh, &topology, &network);
        let map = RegionMap::identity(&topology, &network);
        Self { mesh, topology, network, normals, map }
    }

    fn surface(&self) -> Surface<'_> {
        Surface { mesh: &self.mesh, topology: &self.topology, network: &self.network, normals: &self.normals }
    }

    /// Moves the vertices inside sheets by up to this share of a cell.
    fn jitter(mut self, share: f64, seed: u64) -> Self {
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        for v in self.map.vertices() {
            let way = share / N as f64 * DVec3::new(random(), random(), 0.0);
            if let Attachment::Sheet(_) = self.map.attachments[v] {
                let free = |e| !self.network.is_barrier(e);
                self.map.points[v] = walk(&self.mesh, &self.topology, self.map.points[v], way, free).end;
            }
        }
        self
    }

    fn domain(&self) -> TriMesh {
        self.mesh.with_positions(self.map.points.iter().map(|p| p.position(&self.mesh)).collect()).unwrap()
    }

    /// Snaps, and checks the new map and that all points are in their sheets.
    fn snap(&self, let_go: &LetGo, options: &SnapOptions) -> Snapped {
        let snapped = snap(&self.surface(), &self.domain(), &self.topology, &self.map, let_go, options).unwrap();
        snapped.map.check(&self.topology, &snapped.network).unwrap();
        for (v, point) in snapped.map.points.enumerate() {
            if let Attachment::Sheet(sheet) = snapped.map.attachments[v] {
                assert_eq!(snapped.network.sheet_of_face[point.face], sheet, "{v}");
            }
            assert!(point.position(&self.mesh).distance(snapped.mesh.position(v)) < 1e-12);
        }
        snapped
    }
}

/// Follows minor creases that the domain does not miss, too.
fn all() -> SnapOptions {
    SnapOptions { least_depth: 0.0, ..Default::default() }
}

/// A roof whose ridge fades out at both ends.
fn ridge() -> Bed {
    let height = |x: f64, y: f64| -(y - 0.5).abs() * (0.3 - (x - 0.5).abs()).max(0.0) * 4.0;
    Bed::new(height, &[], vec![(4..=16).map(|x| vertex(x, 10)).collect()])
}

/// The border of a square in the plane, as a closed chain.
fn square() -> Bed {
    let sides = [(5..15).map(|x| vertex(x, 5)).collect::<Vec<_>>(), (5..15).map(|y| vertex(15, y)).collect()];
    let back = [(6..=15).rev().map(|x| vertex(x, 15)).collect::<Vec<_>>(), (5..=15).rev().map(|y| vertex(5, y)).collect()];
    Bed::new(|_, _| 0.0, &[], vec![sides.concat().into_iter().chain(back.concat()).collect()])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_minor_crease_becomes_an_arc(seed: u64, share in 0.0..0.4) {
        let bed = ridge().jitter(share, seed);
        let snapped = bed.snap(&LetGo::default(), &all());
        let [(edges, path)] = &snapped.tracks[..] else { panic!("{:?}", snapped.tracks) };
        prop_assert_eq!(edges.len(), 12);
        prop_assert_eq!((snapped.network.arcs.len(), snapped.network.n_sheets), (bed.network.arcs.len() + 1, 1));
        prop_assert!(snapped.network.minor.is_empty());
        for &v in path {
            prop_assert!((snapped.mesh.position(v).y - 0.5).abs() < 1e-12);
        }
        let ends = [path[0], path[path.len() - 1]].map(|v| snapped.mesh.position(v).x);
        prop_assert!((ends[0].min(ends[1]) - 0.2).abs() < 1e-12 && (ends[0].max(ends[1]) - 0.8).abs() < 1e-12);
    }

    #[test]
    fn a_closed_minor_crease_cuts_off_a_sheet(seed: u64, share in 0.0..0.3) {
        let bed = square().jitter(share, seed);
        let snapped = bed.snap(&LetGo::default(), &all());
        prop_assume!(snapped.network.minor.is_empty()); // else a piece found no path
        prop_assert_eq!(snapped.network.n_sheets, 2);
        let area = |sheet| {
            let faces = snapped.network.sheet_of_face.enumerate().filter(|(_, s)| **s == sheet);
            faces.map(|(f, _)| bed.mesh.area(f)).sum::<f64>()
        };
        for (f, &sheet) in snapped.map.sheet_of_face.enumerate() {
            let inside = area(sheet) < 0.5;
            let centre = bed.mesh.centroid(f);
            // The path keeps to within a cell or two of the square.
            if (centre - DVec3::new(0.5, 0.5, 0.0)).abs().max_element() < 0.12 {
                prop_assert!(inside);
            }
        }
    }
}

#[test]
fn a_crease_that_is_not_missed_is_left() {
    assert!(ridge().snap(&LetGo::default(), &SnapOptions::default()).is_unchanged());
    assert!(!ridge().jitter(0.3, 1).snap(&LetGo::default(), &SnapOptions::default()).is_unchanged());
}

#[test]
fn what_is_let_go_or_not_worth_it_is_left() {
    let bed = ridge();
    assert!(bed.snap(&LetGo::default(), &SnapOptions { least_length: 13.0, ..all() }).is_unchanged(), "it is too short");
    let edges = &bed.snap(&LetGo::default(), &all()).tracks[0].0;
    // Without its middle both halves are followed; without every third edge none is long enough.
    let without = |step: usize, first: usize| LetGo {
        minor: edges.iter().skip(first).step_by(step).copied().collect(),
        ..LetGo::default()
    };
    let halved = bed.snap(&without(12, 5), &all());
    assert_eq!(halved.tracks.iter().map(|(edges, _)| edges.len()).collect::<Vec<_>>(), [5, 6]);
    assert_eq!(halved.network.minor.iter().map(Vec::len).collect::<Vec<_>>(), [2]);
    assert!(bed.snap(&without(3, 0), &all()).is_unchanged());
}

#[test]
fn a_zigzag_is_left() {
    let chain = (0..13).map(|i| vertex(4 + i / 2 + i % 2, 5 + i / 2)).collect();
    let bed = Bed::new(|_, _| 0.0, &[], vec![chain]);
    assert!(bed.snap(&LetGo::default(), &all()).is_unchanged());
}

/// A crease with a right angle between two corners, and the domain's vertices on it half a cell beside the surface's.
fn bent() -> Bed {
    let chain: Vec<VertexId> = (0..=10).map(|x| vertex(x, 10)).chain((0..10).rev().map(|y| vertex(10, y))).collect();
    let mut bed = Bed::new(|_, _| 0.0, &chain, Vec::new());
    let (arc, a) = bed.network.arcs.enumerate().find(|(_, a)| a.kind == ArcKind::Sharp).unwrap();
    let slide = 0.4 / N as f64;
    let slid = |t: f64| if t <= 1e-9 || t >= a.length() - 1e-9 { t } else { t - slide };
    for (v, &t) in a.vertices.iter().zip(&a.lengths).filter(|&(_, &t)| slid(t) != t) {
        bed.map.attachments[*v] = Attachment::Arc { arc, t: slid(t) };
        bed.map.points[*v] = a.point(&bed.topology, slid(t));
    }
    for (v, t) in a.vertices.windows(2).zip(a.lengths.windows(2)) {
        bed.map.insert_span(v[0], v[1], ArcSpan { arc, from: slid(t[0]), to: slid(t[1]) });
    }
    bed
}

#[test]
fn a_bend_takes_the_nearer_vertex() {
    let bed = bent();
    bed.map.check(&bed.topology, &bed.network).unwrap();
    let snapped = bed.snap(&LetGo::default(), &all());
    let [(bend, v)] = snapped.bends[..] else { panic!("{:?}", snapped.bends) };
    assert_eq!((bend, v), (vertex(10, 10), vertex(10, 10)));
    assert_eq!(snapped.mesh.position(v), bed.mesh.position(bend));
    assert_eq!(snapped.network.corners.len(), bed.network.corners.len() + 1);
    let let_go = LetGo { bends: [bend].into(), ..LetGo::default() };
    assert!(bed.snap(&let_go, &all()).is_unchanged());
}

#[test]
fn poor_halves_and_bends_are_named() {
    let bed = ridge();
    let snapped = bed.snap(&LetGo::default(), &all());
    let before = bed.domain();
    assert_eq!(snapped.poor(&bed.topology, [&before; 2], &[], &all()), LetGo::default());
    let (edges, path) = &snapped.tracks[0];
    let moved = |v: VertexId| {
        let mut positions = before.positions().clone();
        positions[v] += DVec3::new(0.0, 3.0 / N as f64, 0.0);
        before.with_positions(positions.into_vec()).unwrap()
    };
    let poor = snapped.poor(&bed.topology, [&before, &moved(path[2])], &[], &all());
    assert_eq!(poor.minor, edges[..6].iter().copied().collect());
    // As for a triangle there that is refused.
    let beside = bed.topology.fan(path[2]).next().unwrap().face();
    let poor = snapped.poor(&bed.topology, [&before; 2], &[beside], &all());
    assert!(!poor.minor.is_empty() && edges[..6].iter().all(|e| poor.minor.contains(e)), "{poor:?}");
    let snapped = bent().snap(&LetGo::default(), &all());
    let poor = snapped.poor(&bed.topology, [&before, &moved(vertex(10, 10))], &[], &all());
    assert_eq!(poor.bends, [vertex(10, 10)].into());
}

#[test]
fn a_map_of_another_mesh_is_refused() {
    let mut bed = ridge();
    bed.map.points = IdVec::new();
    let domain = bed.mesh.clone();
    assert!(snap(&bed.surface(), &domain, &bed.topology, &bed.map, &LetGo::default(), &all()).is_err());
}
