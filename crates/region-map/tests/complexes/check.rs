//! The check of a region map: what it lets pass, and every single corruption that it finds.

use crate::{crease_network, shapes, topology};
use glam::DVec3;
use mesh_core::{FaceId, Id, IdVec, SurfacePoint, Topology, VertexId};
use region_map::{ArcId, ArcSpan, Attachment, ClassCounts, CornerId, Network, RegionMap, RegionMapError, SheetId};

#[test]
fn every_mesh_maps_onto_itself() {
    for (name, mesh, topology, network) in shapes() {
        let map = RegionMap::identity(&topology, &network);
        map.check(&topology, &network).unwrap_or_else(|e| panic!("{name}: {e}"));
        let ClassCounts { at_corners: corners, on_arcs, in_sheets: inner } = map.class_counts();
        assert_eq!(corners, network.corners.len(), "{name}");
        assert_eq!(on_arcs, network.arcs.iter().map(|a| a.halfedges.len() - usize::from(!a.is_loop())).sum(), "{name}");
        assert_eq!(corners + on_arcs + inner, mesh.n_vertices(), "{name}");
        assert_eq!(map.vertices().count(), mesh.n_vertices(), "{name}");
        assert!(map.points.enumerate().all(|(v, p)| p.position(&mesh) == mesh.position(v)), "{name}");
    }
}

/// Other places than the one that a vertex is attached to.
fn elsewhere(network: &Network, right: Attachment) -> Vec<Attachment> {
    let corners = (0..=network.corners.len()).map(|c| Attachment::Corner(CornerId::new(c)));
    let on_arcs = (0..=network.arcs.len()).flat_map(|a| {
        let arc = ArcId::new(a);
        [0.0, 0.4, f64::NAN].map(|t| Attachment::Arc { arc, t })
    });
    let sheets = (0..=network.n_sheets).map(|s| Attachment::Sheet(SheetId::new(s)));
    let mut places: Vec<_> = corners.chain(on_arcs).chain(sheets).filter(|&a| a != right).collect();
    if let Attachment::Arc { arc, t } = right {
        // The start of a loop is also its end.
        places.retain(|&a| !matches!(a, Attachment::Arc { arc: other, t: s } if other == arc && s == t));
        places.push(Attachment::Arc { arc, t: t + 1e-6 * network.arcs[arc].length() });
    }
    places
}

/// Other spans than the right one; `None` for no span.
fn other_spans(network: &Network, right: ArcSpan) -> Vec<Option<ArcSpan>> {
    let length = network.arcs[right.arc].length();
    let mut spans = vec![
        None,
        Some(ArcSpan { from: right.to, to: right.from, ..right }),
        Some(ArcSpan { to: right.from, ..right }),
        Some(ArcSpan { from: f64::NAN, ..right }),
        Some(ArcSpan { to: right.to + 1e-6 * length, ..right }),
        // On a loop the ends agree, but this is the other way round.
        Some(ArcSpan { to: right.to + length, ..right }),
        Some(ArcSpan { to: right.to - length, ..right }),
    ];
    let others = (0..=network.arcs.len()).map(ArcId::new).filter(|&a| a != right.arc);
    spans.extend(others.map(|arc| Some(ArcSpan { arc, ..right })));
    spans
}

#[test]
fn every_single_corruption_is_found() {
    for (name, mesh, topology, network) in shapes() {
        if mesh.n_faces() > 600 {
            continue;
        }
        let right = RegionMap::identity(&topology, &network);
        for v in right.vertices() {
            for place in elsewhere(&network, right.attachments[v]) {
                let mut map = right.clone();
                map.attachments[v] = place;
                assert!(map.check(&topology, &network).is_err(), "{name}: vertex {v} at {place:?}");
            }
        }
        for (&ends, &span) in &right.spans {
            for other in other_spans(&network, span) {
                let mut map = right.clone();
                match other {
                    Some(other) => map.spans.insert(ends, other),
                    None => map.spans.remove(&ends),
                };
                assert!(map.check(&topology, &network).is_err(), "{name}: {ends:?} has {other:?}, should have {span:?}");
            }
        }
        for f in mesh.faces().ids() {
            for sheet in (0..=network.n_sheets).map(SheetId::new).filter(|&s| s != right.sheet_of_face[f]) {
                let mut map = right.clone();
                map.sheet_of_face[f] = sheet;
                assert!(map.check(&topology, &network).is_err(), "{name}: face {f} in sheet {sheet}");
            }
        }
    }
}

#[test]
fn points_must_be_on_faces_that_exist() {
    let mesh = fixtures::cube(1);
    let topology = topology(&mesh);
    let network = crease_network(&mesh, &topology);
    let right = RegionMap::identity(&topology, &network);
    for point in [SurfacePoint::at_corner(FaceId(12), 0), SurfacePoint { face: FaceId(0), barycentric: DVec3::NAN }] {
        let mut map = right.clone();
        map.points[VertexId(3)] = point;
        assert_eq!(map.check(&topology, &network), Err(RegionMapError::Misattached(VertexId(3))));
    }
}

#[test]
fn errors_name_what_is_wrong() {
    let mesh = fixtures::cube(2);
    let topology = topology(&mesh);
    let network = crease_network(&mesh, &topology);
    let right = RegionMap::identity(&topology, &network);
    let corrupted = |change: &dyn Fn(&mut RegionMap)| {
        let mut map = right.clone();
        change(&mut map);
        map.check(&topology, &network).unwrap_err()
    };
    let too_short = corrupted(&|m| m.points = IdVec::from_vec(m.points.as_slice()[1..].to_vec()));
    assert_eq!(too_short, RegionMapError::WrongSize { what: "points", found: 25, expected: 26 });
    let [a, b] = unjoined(&topology);
    let span = *right.spans.values().next().unwrap();
    assert_eq!(corrupted(&|m| m.insert_span(a, b, span)), RegionMapError::NoSuchEdge(a, b));
    assert_eq!(corrupted(&|m| m.sheet_of_face[FaceId(0)] = SheetId(99)), RegionMapError::Misattached(first_inner(&right)));
    let (&ends, _) = right.spans.iter().next().unwrap();
    let on_arc = *ends.iter().find(|&&v| matches!(right.attachments[v], Attachment::Arc { .. })).unwrap();
    let lost = corrupted(&|m| m.spans.retain(|e, _| *e != ends));
    assert!(matches!(lost, RegionMapError::Misattached(v) if v == on_arc || ends.contains(&v)), "{lost}");
}

#[test]
fn spans_between_vertices_that_are_not_there_are_found() {
    let mesh = fixtures::cube(1);
    let topology = topology(&mesh);
    let network = crease_network(&mesh, &topology);
    let right = RegionMap::identity(&topology, &network);
    let span = *right.spans.values().next().unwrap();
    // In rising order, as a map must have them, and not.
    for ends in [[0, 8], [0, u32::MAX], [8, 9], [1, 0], [0, 0]].map(|e| e.map(VertexId)) {
        let mut map = right.clone();
        map.spans.insert(ends, span);
        assert_eq!(map.check(&topology, &network), Err(RegionMapError::NoSuchEdge(ends[0], ends[1])));
    }
}

/// Two vertices that no edge joins.
fn unjoined(topology: &Topology) -> [VertexId; 2] {
    let far = (1..topology.n_vertices()).map(VertexId::new).find(|&v| topology.find_edge(VertexId(0), v).is_none());
    [VertexId(0), far.unwrap()]
}

/// The first vertex inside the sheet of face 0.
fn first_inner(map: &RegionMap) -> VertexId {
    let is_inner = |a: &Attachment| *a == Attachment::Sheet(map.sheet_of_face[FaceId(0)]);
    map.attachments.enumerate().find(|(_, a)| is_inner(a)).unwrap().0
}

#[test]
fn a_border_must_lie_on_an_arc() {
    let mesh = fixtures::plane();
    let topology = topology(&mesh);
    let bare = Network::trace(&mesh, &topology, &IdVec::filled(None, topology.n_edges()), |_| false, Vec::new()).unwrap();
    let map = RegionMap::identity(&topology, &bare);
    assert!(matches!(map.check(&topology, &bare), Err(RegionMapError::BareBorder(..))));
}

#[test]
fn an_uncovered_loop_and_an_empty_corner_are_found() {
    let mesh = fixtures::uv_sphere(16);
    let topology = topology(&mesh);
    let smooth = crease_network(&mesh, &topology);
    let map = RegionMap::identity(&topology, &smooth);
    map.check(&topology, &smooth).unwrap();
    let with_pole = crate::marked_network(&mesh, &topology, |_| false, |v| mesh.position(v).z > 0.999);
    assert_eq!(map.check(&topology, &with_pole), Err(RegionMapError::EmptyCorner(CornerId(0))));
    // The equator as an arc that the domain knows nothing of, with one sheet on both sides.
    let equator = crate::marked_network(&mesh, &topology, |p| p.z.abs() < 1e-9, |_| false);
    let blind = Network { arcs: equator.arcs.clone(), ..smooth };
    assert_eq!(map.check(&topology, &blind), Err(RegionMapError::ArcNotCovered(ArcId(0))));
}

#[test]
fn spans_are_seen_from_both_ends() {
    let mesh = fixtures::plane();
    let topology = topology(&mesh);
    let network = crease_network(&mesh, &topology);
    let mut map = RegionMap::identity(&topology, &network);
    map.spans.clear();
    let span = ArcSpan { arc: ArcId(1), from: 2.0, to: 5.0 };
    let turned = ArcSpan { arc: ArcId(1), from: 5.0, to: 2.0 };
    let [low, high] = [VertexId(2), VertexId(7)];
    for (a, b, inserted) in [(low, high, span), (high, low, turned)] {
        map.spans.clear();
        map.insert_span(a, b, inserted);
        assert_eq!(map.spans[&[low, high]], span);
        assert_eq!((map.span(low, high), map.span(high, low)), (Some(span), Some(turned)));
    }
    assert_eq!(map.span(low, VertexId(3)), None);
}
