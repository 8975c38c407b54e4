//! Snapping on grids with creases whose places are known. `Bed::snap` checks what always holds.

use glam::DVec3;
use mesh_core::{EdgeId, FaceId, IdVec, Topology, TriMesh, VertexId, walk};
use proptest::prelude::*;
use region_map::{ArcKind, ArcSpan, Attachment, Domain, Network, Surface};
use snap::{Bend, LetGo, SnapOptions, Snapped, Track, snap};
use std::collections::BTreeSet;

/// Cells of the grid along each axis.
const N: usize = 20;

/// A grid over the unit square as the surface, and as domain itself.
struct Bed {
    surface: Surface,
    domain: Domain,
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
        let network = Network::trace(&mesh, &topology, &kinds, |v| corners.contains(&v), minor).unwrap();
        let surface = Surface::new(mesh, topology, network).unwrap();
        Self { domain: Domain::identity(&surface), surface }
    }

    /// Moves the vertices inside sheets by up to this share of a cell.
    fn jitter(mut self, share: f64, seed: u64) -> Self {
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let Self { surface, domain } = &self;
        let mut region = domain.region.clone();
        for v in region.vertices() {
            let way = share / N as f64 * DVec3::new(random(), random(), 0.0);
            if let Attachment::Sheet(_) = region.attachments[v] {
                let free = |e| !surface.network().is_barrier(e);
                region.points[v] = walk(surface.mesh(), surface.topology(), region.points[v], way, free).end;
            }
        }
        self.domain = domain.placed(surface, region).unwrap();
        self
    }

    /// Snaps, and checks that the domain fits the new surface and that all points are in their sheets.
    fn snap(&self, let_go: &LetGo, options: &SnapOptions) -> Snapped {
        self.snap_to_seen(&[], let_go, options)
    }

    /// The same where the edges along some chains are seen as sharp.
    fn snap_to_seen(&self, seen: &[&[VertexId]], let_go: &LetGo, options: &SnapOptions) -> Snapped {
        let edge = |ends: &[VertexId]| self.surface.topology().find_edge(ends[0], ends[1]).unwrap();
        let seen: BTreeSet<EdgeId> = seen.iter().flat_map(|chain| chain.windows(2).map(edge)).collect();
        let snapped = snap(&self.surface, &self.domain, &seen, let_go, options).unwrap();
        let (network, Domain { mesh, region, .. }) = (snapped.surface.network(), &snapped.domain);
        snapped.domain.check(network).unwrap();
        for (v, point) in region.points.enumerate() {
            if let Attachment::Sheet(sheet) = region.attachments[v] {
                assert_eq!(network.sheet_of_face[point.face], sheet, "{v}");
            }
            assert!(point.position(self.surface.mesh()).distance(mesh.position(v)) < 1e-12);
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
        let [Track { edges, path, .. }] = &snapped.tracks[..] else { panic!("{:?}", snapped.tracks) };
        let (network, mesh) = (snapped.surface.network(), &snapped.domain.mesh);
        prop_assert_eq!(edges.len(), 12);
        prop_assert_eq!((network.arcs.len(), network.n_sheets), (bed.surface.network().arcs.len() + 1, 1));
        prop_assert!(network.minor.is_empty());
        for &v in path {
            prop_assert!((mesh.position(v).y - 0.5).abs() < 1e-12);
        }
        let ends = [path[0], path[path.len() - 1]].map(|v| mesh.position(v).x);
        prop_assert!((ends[0].min(ends[1]) - 0.2).abs() < 1e-12 && (ends[0].max(ends[1]) - 0.8).abs() < 1e-12);
    }

    #[test]
    fn a_closed_minor_crease_cuts_off_a_sheet(seed: u64, share in 0.0..0.3) {
        let bed = square().jitter(share, seed);
        let snapped = bed.snap(&LetGo::default(), &all());
        let (mesh, network) = (bed.surface.mesh(), snapped.surface.network());
        prop_assert!(network.minor.is_empty(), "a piece found no path");
        prop_assert_eq!(network.n_sheets, 2);
        let area = |sheet| {
            let faces = network.sheet_of_face.enumerate().filter(|(_, s)| **s == sheet);
            faces.map(|(f, _)| mesh.area(f)).sum::<f64>()
        };
        for (f, &sheet) in snapped.domain.region.sheet_of_face.enumerate() {
            let inside = area(sheet) < 0.5;
            let centre = mesh.centroid(f);
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
    let edges = &bed.snap(&LetGo::default(), &all()).tracks[0].edges;
    // Without its middle both halves are followed; without every third edge none is long enough.
    let without = |step: usize, first: usize| LetGo {
        minor: edges.iter().skip(first).step_by(step).copied().collect(),
        ..LetGo::default()
    };
    let halved = bed.snap(&without(12, 5), &all());
    assert_eq!(halved.tracks.iter().map(|track| track.edges.len()).collect::<Vec<_>>(), [5, 6]);
    assert_eq!(halved.surface.network().minor.iter().map(Vec::len).collect::<Vec<_>>(), [2]);
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
    let Bed { surface, mut domain } = Bed::new(|_, _| 0.0, &chain, Vec::new());
    let (arc, a) = surface.network().arcs.enumerate().find(|(_, a)| a.kind == ArcKind::Sharp).unwrap();
    let slide = 0.4 / N as f64;
    let slid = |t: f64| if t <= 1e-9 || t >= a.length() - 1e-9 { t } else { t - slide };
    let mut region = domain.region.clone();
    for (v, &t) in a.vertices.iter().zip(&a.lengths).filter(|&(_, &t)| slid(t) != t) {
        region.attachments[*v] = Attachment::Arc { arc, t: slid(t) };
        region.points[*v] = a.point(surface.topology(), slid(t));
    }
    for (v, t) in a.vertices.windows(2).zip(a.lengths.windows(2)) {
        region.insert_span(v[0], v[1], ArcSpan { arc, from: slid(t[0]), to: slid(t[1]) });
    }
    domain = domain.placed(&surface, region).unwrap();
    Bed { surface, domain }
}

#[test]
fn a_bend_takes_the_nearer_vertex() {
    let bed = bent();
    bed.domain.check(bed.surface.network()).unwrap();
    let snapped = bed.snap(&LetGo::default(), &all());
    let [Bend { at, vertex: v }] = snapped.bends[..] else { panic!("{:?}", snapped.bends) };
    assert_eq!((at, v), (vertex(10, 10), vertex(10, 10)));
    assert_eq!(snapped.domain.mesh.position(v), bed.surface.mesh().position(at));
    assert_eq!(snapped.surface.network().corners.len(), bed.surface.network().corners.len() + 1);
    let let_go = LetGo { bends: [at].into(), ..LetGo::default() };
    assert!(bed.snap(&let_go, &all()).is_unchanged());
}

#[test]
fn poor_halves_and_bends_are_named() {
    let bed = ridge();
    let snapped = bed.snap(&LetGo::default(), &all());
    let before = &bed.domain.mesh;
    let poor = |snapped: &Snapped, after: &TriMesh, refused: &[FaceId]| snapped.poor([before, after], refused, &all()).unwrap();
    assert_eq!(poor(&snapped, before, &[]), LetGo::default());
    let Track { edges, path, .. } = &snapped.tracks[0];
    let moved = |v: VertexId| {
        let mut positions = before.positions().clone();
        positions[v] += DVec3::new(0.0, 3.0 / N as f64, 0.0);
        before.with_positions(positions.into_vec()).unwrap()
    };
    assert_eq!(poor(&snapped, &moved(path[2]), &[]).minor, edges[..6].iter().copied().collect());
    // As for a triangle there that is refused.
    let beside = bed.domain.topology.fan(path[2]).next().unwrap().face();
    let refused = poor(&snapped, before, &[beside, FaceId(99_999)]);
    assert!(!refused.minor.is_empty() && edges[..6].iter().all(|e| refused.minor.contains(e)), "{refused:?}");
    let snapped = bent().snap(&LetGo::default(), &all());
    assert_eq!(poor(&snapped, &moved(vertex(10, 10)), &[]).bends, [vertex(10, 10)].into());
}

#[test]
fn a_domain_of_another_size_is_refused() {
    let Bed { surface, domain } = ridge();
    let other = TriMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]]).unwrap();
    let snapped = snap(&surface, &domain, &BTreeSet::new(), &LetGo::default(), &all()).unwrap();
    assert!(snapped.poor([&domain.mesh, &other], &[], &all()).is_err());
    let mut region = domain.region.clone();
    region.points = IdVec::new();
    for wrong in [Domain { region, ..domain.clone() }, Domain { mesh: other, ..domain }] {
        assert!(snap(&surface, &wrong, &BTreeSet::new(), &LetGo::default(), &all()).is_err());
    }
}

/// Edges that a person sees as sharp are followed where others are too short, and where the domain is as near as anywhere. Of two creases beside refused
/// triangles they are let go of first.
#[test]
fn short_edges_are_followed_where_they_are_seen() {
    let [long, short]: [Vec<VertexId>; 2] = [(4..=16).map(|x| vertex(x, 8)).collect(), (8..=10).map(|x| vertex(x, 14)).collect()];
    let bed = Bed::new(|_, _| 0.0, &[], vec![long.clone(), short.clone()]);
    assert_eq!(bed.snap(&LetGo::default(), &all()).tracks.len(), 1);
    let snapped = bed.snap_to_seen(&[&short], &LetGo::default(), &all());
    assert_eq!(snapped.tracks.iter().map(|track| track.only_seen).collect::<Vec<_>>(), [false, true]);
    let near = bed.snap_to_seen(&[&long, &short], &LetGo::default(), &SnapOptions { least_depth: 1.0, ..all() });
    assert_eq!(near.tracks.iter().map(|track| track.only_seen).collect::<Vec<_>>(), [true, true]);
    // All triangles get poor.
    let flat =
        |mesh: &TriMesh| mesh.with_positions(mesh.positions().iter().map(|p| *p * DVec3::new(1.0, 0.01, 1.0)).collect()).unwrap();
    let poor = |snapped: &Snapped, refused: &[FaceId]| {
        let mesh = &snapped.domain.mesh;
        snapped.poor([mesh, &flat(mesh)], refused, &all()).unwrap()
    };
    let edges_of = |track: &Track| track.edges.iter().copied().collect::<BTreeSet<EdgeId>>();
    let [ordinary, seen] = [0, 1].map(|i| edges_of(&snapped.tracks[i]));
    let let_go = poor(&snapped, &[]);
    assert_eq!(let_go.minor, seen);
    assert_eq!(poor(&bed.snap_to_seen(&[&short], &let_go, &all()), &[]).minor, ordinary);
    // What is refused leaves no time for that.
    assert_eq!(poor(&snapped, &[FaceId(0)]).minor, &ordinary | &seen);
}

/// The fourth side of a square closes a ring, which the paths of short pieces may turn inside out: it is left.
#[test]
fn seen_edges_close_no_ring() {
    let side =
        |from: [usize; 2], step: [usize; 2]| (0..=2).map(|i| vertex(from[0] + i * step[0], from[1] + i * step[1])).collect();
    let sides: [Vec<VertexId>; 4] = [side([8, 8], [1, 0]), side([10, 8], [0, 1]), side([8, 10], [1, 0]), side([8, 8], [0, 1])];
    let bed = Bed::new(|_, _| 0.0, &[], sides.to_vec());
    let seen: Vec<&[VertexId]> = sides.iter().map(Vec::as_slice).collect();
    let tracks = bed.snap_to_seen(&seen, &LetGo::default(), &all()).tracks;
    assert_eq!(tracks.len(), 3);
}
