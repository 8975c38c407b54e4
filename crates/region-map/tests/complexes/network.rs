//! Corners, arcs and sheets.

use crate::{crease_network, marked_network, shapes, sphere_with_dart, topology};
use glam::DVec3;
use mesh_core::{EdgeId, IdVec, Topology, TriMesh, VertexId};
use region_map::{ArcKind, CreaseLengths, LeastBase, Network, NetworkError, SheetId, spokes};

/// Corners, arcs, loops among the arcs, sheets.
fn counts(network: &Network) -> [usize; 4] {
    let loops = network.arcs.iter().filter(|a| a.is_loop()).count();
    [network.corners.len(), network.arcs.len(), loops, network.n_sheets]
}

fn traced(mesh: &TriMesh) -> Network {
    crease_network(mesh, &topology(mesh))
}

#[test]
fn counts_of_known_shapes() {
    assert_eq!(counts(&traced(&fixtures::cube(1))), [8, 12, 0, 6]);
    assert_eq!(counts(&traced(&fixtures::cube(4))), [8, 12, 0, 6]);
    assert_eq!(counts(&traced(&fixtures::l_block(2))), [12, 18, 0, 8]);
    assert_eq!(counts(&traced(&fixtures::cylinder(1.0, 2.0, 24))), [0, 2, 2, 3]);
    assert_eq!(counts(&traced(&fixtures::cone(1.0, 1.0, 24))), [0, 1, 1, 2]);
    assert_eq!(counts(&traced(&fixtures::torus(1.0, 0.4, 24, 12))), [0, 0, 0, 1]);
    assert_eq!(counts(&traced(&fixtures::shell(16))), [0, 4, 4, 1]);
    assert_eq!(counts(&traced(&fixtures::crossing_boxes(2))), [16, 24, 0, 12]);
}

#[test]
fn arcs_cover_the_feature_edges_and_no_others() {
    for (name, mesh, topology, network) in shapes() {
        let mut length = 0.0f64;
        for (id, arc) in network.arcs.enumerate() {
            assert_eq!(arc.vertices.len(), arc.halfedges.len() + 1, "{name}");
            for (i, &h) in arc.halfedges.iter().enumerate() {
                let mut ends = [topology.from(h), topology.to(h)];
                ends.sort();
                let mut expected = [arc.vertices[i], arc.vertices[i + 1]];
                expected.sort();
                assert_eq!(ends, expected, "{name}");
                assert_eq!(network.arc_of_edge[topology.edge(h)], Some(id), "{name}");
                length += mesh.distance(ends[0], ends[1]);
            }
            match arc.corners {
                Some(ends) => assert_eq!(ends.map(|c| network.corners[c]), [arc.vertices[0], *arc.vertices.last().unwrap()]),
                None => assert_eq!(arc.vertices.first(), arc.vertices.last(), "{name}"),
            }
            assert!(arc.vertices[1..arc.vertices.len() - 1].iter().all(|&v| network.corner_of_vertex[v].is_none()), "{name}");
        }
        let n_edges: usize = network.arcs.iter().map(|a| a.halfedges.len()).sum();
        assert_eq!(n_edges, topology.edge_ids().filter(|&e| network.is_barrier(e)).count(), "{name}");
        assert!((length - network.total_length()).abs() < 1e-12 * (1.0 + length), "{name}");
    }
}

#[test]
fn sheets_change_only_across_arcs_and_an_arc_knows_both() {
    for (name, _, topology, network) in shapes() {
        for e in topology.edge_ids().filter(|&e| !network.is_barrier(e)) {
            let (f, g) = topology.edge_faces(e);
            assert_eq!(Some(network.sheet_of_face[f]), g.map(|g| network.sheet_of_face[g]), "{name}");
        }
        for arc in &network.arcs {
            for middle in arc.lengths.windows(2).map(|l| 0.5 * (l[0] + l[1])) {
                let sheets = arc.sides(&topology, middle).map(|h| Some(network.sheet_of_face[h?.face()]));
                assert_eq!(sheets, arc.sheets, "{name}");
            }
        }
    }
}

#[test]
fn point_position_and_sides_agree_all_along_every_arc() {
    for (name, mesh, topology, network) in shapes() {
        for arc in &network.arcs {
            let at_vertices = arc.lengths.iter().copied();
            let between = (0..=50).map(|i| arc.length() * f64::from(i) / 50.0);
            for t in at_vertices.chain(between) {
                let position = arc.position(&mesh, t);
                assert!(arc.point(&topology, t).position(&mesh).distance(position) < 1e-12 * mesh.diagonal(), "{name} {t}");
                let (i, s) = arc.segment(t);
                let [a, b] = [arc.vertices[i], arc.vertices[i + 1]];
                assert!(mesh.position(a).lerp(mesh.position(b), s).distance(position) < 1e-12 * mesh.diagonal(), "{name} {t}");
                let [with, against] = arc.sides(&topology, t);
                assert!(with.is_some() || against.is_some());
                assert!(with.is_none_or(|h| [topology.from(h), topology.to(h)] == [a, b]), "{name} {t}");
                assert!(against.is_none_or(|h| [topology.from(h), topology.to(h)] == [b, a]), "{name} {t}");
            }
            for (&v, &t) in arc.vertices.iter().zip(&arc.lengths) {
                assert!(arc.position(&mesh, t).distance(mesh.position(v)) < 1e-12 * mesh.diagonal(), "{name}");
            }
        }
    }
}

#[test]
fn arc_lengths_wrap_on_loops_and_are_clamped_elsewhere() {
    let mesh = fixtures::cylinder(1.0, 2.0, 24);
    for arc in &traced(&mesh).arcs {
        let length = arc.length();
        assert!((length - 24.0 * 2.0 * (std::f64::consts::PI / 24.0).sin()).abs() < 1e-12);
        for t in [0.0, 0.1, 0.5 * length, length - 0.1] {
            for turns in [-2.0, -1.0, 1.0, 3.0] {
                assert!(arc.position(&mesh, t).distance(arc.position(&mesh, t + turns * length)) < 1e-12);
            }
        }
        assert!((0.0..=length).contains(&arc.normalise(-1e-300)));
    }
    let cube = fixtures::cube(2);
    let network = traced(&cube);
    for arc in &network.arcs {
        assert_eq!([arc.normalise(-0.5), arc.normalise(0.25), arc.normalise(7.0)], [0.0, 0.25, 1.0]);
    }
}

#[test]
fn borders_and_marked_edges_are_no_crease_length() {
    // Of the 24 halves of a cube's edges one is marked and one was not kept. A shell has borders only.
    let mesh = fixtures::cube(2);
    let topology = topology(&mesh);
    let mut kinds = ArcKind::by_angle(&mesh, &topology, 40.0);
    let sharp: Vec<_> = topology.edge_ids().filter(|&e| kinds[e].is_some()).collect();
    assert_eq!(sharp.len(), 24);
    kinds[sharp[0]] = Some(ArcKind::Marked);
    kinds[sharp[1]] = None;
    let network = Network::trace(&mesh, &topology, &kinds, |_| false, vec![topology.ends(sharp[1]).to_vec()]).unwrap();
    assert_eq!(network.crease_lengths(&mesh), CreaseLengths { kept: 11.0, minor: 0.5 });
    let shell = fixtures::shell(8);
    assert_eq!(traced(&shell).crease_lengths(&shell), CreaseLengths::default());
}

#[test]
fn a_corner_on_a_rim_opens_its_loop() {
    let mesh = fixtures::cylinder(1.0, 2.0, 24);
    let topology = topology(&mesh);
    let rim = crease_network(&mesh, &topology).arcs.iter().next().unwrap().vertices[5];
    let network = marked_network(&mesh, &topology, |_| false, |v| v == rim);
    assert_eq!(counts(&network), [1, 2, 1, 3]);
    let open = network.arcs.iter().find(|a| !a.is_loop()).unwrap();
    assert_eq!(open.corners.map(|c| c.map(|c| network.corners[c])), Some([rim, rim]));
    assert_eq!(open.vertices.len(), 25);
    assert_eq!(open.normalise(open.length() + 1.0), open.length());
}

#[test]
fn no_base_mesh_is_smaller_than_corners_arcs_and_topology_ask() {
    let least = |mesh: &TriMesh| {
        let LeastBase { vertices, triangles } = traced(mesh).least_base(&topology(mesh));
        (vertices, triangles)
    };
    assert_eq!(least(&fixtures::cube(4)), (8, 12));
    assert_eq!(least(&fixtures::l_block(2)), (12, 20));
    // Two rims of three vertices; with borders alone there are the same vertices and fewer triangles.
    assert_eq!(least(&fixtures::cylinder(1.0, 2.0, 24)), (6, 8));
    let shell = fixtures::shell(16);
    assert_eq!(least(&shell), (12, (12 - 2 * topology(&shell).euler()) as usize));
    // Nothing is asked for, and a torus has as many edges as vertices and faces together.
    assert_eq!(least(&fixtures::torus(1.0, 0.4, 24, 12)), (0, 0));
}

#[test]
fn borders_have_one_side() {
    let mesh = fixtures::shell(16);
    for arc in &traced(&mesh).arcs {
        assert_eq!(arc.kind, ArcKind::Border);
        assert!([[Some(SheetId(0)), None], [None, Some(SheetId(0))]].contains(&arc.sheets));
    }
}

#[test]
fn a_dart_ends_inside_its_sheet() {
    let (mesh, _, network) = sphere_with_dart();
    assert_eq!(counts(&network), [2, 1, 0, 1]);
    let arc = network.arcs.iter().next().unwrap();
    assert_eq!((arc.kind, arc.sheets), (ArcKind::Marked, [Some(SheetId(0)); 2]));
    let ends = arc.corners.unwrap().map(|c| mesh.position(network.corners[c]));
    assert!(ends.iter().any(|p| p.distance(DVec3::X) < 1e-9) && ends.iter().any(|p| p.distance(DVec3::Y) < 1e-9));
}

#[test]
fn corners_are_where_kinds_meet_and_where_asked_even_without_arcs() {
    let mesh = fixtures::uv_sphere(16);
    let topology = topology(&mesh);
    let on_equator = |e| topology.ends(e).into_iter().all(|v| mesh.position(v).z.abs() < 1e-9);
    let kind = |e| {
        let east = topology.ends(e).map(|v| mesh.position(v).x).iter().sum::<f64>() > 0.0;
        on_equator(e).then_some(if east { ArcKind::Sharp } else { ArcKind::Marked })
    };
    let kinds: IdVec<_, _> = topology.edge_ids().map(kind).collect();
    let network = Network::trace(&mesh, &topology, &kinds, |v| mesh.position(v).z > 0.999, Vec::new()).unwrap();
    assert_eq!(counts(&network), [3, 2, 0, 2]);
    let ring: Vec<_> = network.arcs.iter().map(|a| (a.kind, a.halfedges.len())).collect();
    assert!(ring.contains(&(ArcKind::Sharp, 8)) && ring.contains(&(ArcKind::Marked, 8)));
}

#[test]
fn a_vertex_without_faces_is_no_corner() {
    let plane = fixtures::plane();
    let mut positions = plane.positions().as_slice().to_vec();
    positions.push(DVec3::Z);
    let mesh = TriMesh::new(positions, plane.faces().iter().map(|f| f.map(|v| v.0)).collect()).unwrap();
    let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
    let network = marked_network(&mesh, &topology, |_| false, |_| true);
    assert_eq!(counts(&network), [4, 4, 0, 1]);
}

#[test]
fn tables_of_another_mesh_are_refused() {
    let (mesh, other) = (fixtures::cube(1), fixtures::cube(2));
    let [own, foreign] = [&mesh, &other].map(topology);
    let none = |n: usize| IdVec::<EdgeId, Option<ArcKind>>::filled(None, n);
    let error = |topology: &Topology, kinds: &IdVec<EdgeId, Option<ArcKind>>, minor: Vec<Vec<VertexId>>| {
        Network::trace(&mesh, topology, kinds, |_| false, minor).unwrap_err()
    };
    let wrong = |what, found, expected| NetworkError::WrongSize { what, found, expected };
    assert_eq!(error(&foreign, &none(foreign.n_edges()), vec![]), wrong("the topology's list of vertices", 26, 8));
    assert_eq!(error(&own, &none(17), vec![]), wrong("the list of kinds", 17, 18));
    assert_eq!(error(&own, &none(0), vec![]), wrong("the list of kinds", 0, 18));
    let chain = |v| vec![vec![VertexId(0), VertexId(v)]];
    assert_eq!(error(&own, &none(18), chain(8)), NetworkError::NoSuchVertex(VertexId(8)));
    assert_eq!(Network::trace(&mesh, &own, &none(18), |_| false, chain(7)).unwrap().minor, chain(7));
    // The same vertices in fewer faces.
    let half = TriMesh::new(mesh.positions().as_slice().to_vec(), mesh.to_soup().triangles[..6].to_vec()).unwrap();
    assert_eq!(error(&topology(&half), &none(topology(&half).n_edges()), vec![]), wrong("the topology's list of faces", 6, 12));
}

#[test]
fn there_is_a_spoke_for_every_edge_at_a_vertex() {
    for (name, _, topology, _) in shapes() {
        for v in (0..topology.n_vertices() as u32).map(VertexId) {
            let edges: Vec<EdgeId> = spokes(&topology, v).map(|h| topology.edge(h)).collect();
            // In the order of the neighbours round the vertex.
            let ends = edges.iter().map(|&e| topology.ends(e)).map(|[a, b]| if a == v { b } else { a });
            assert!(ends.eq(topology.one_ring(v)), "{name} {v}");
            assert_eq!(edges.len(), topology.valence(v), "{name} {v}");
        }
    }
}
