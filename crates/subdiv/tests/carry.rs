//! Domains carried over to a base mesh with more vertices. Each surface is its own base mesh, so middles of its flat faces are
//! known.

use mesh_core::{FaceId, Id as _, IdVec, TriMesh, VertexId};
use region_map::{ArcSpan, Attachment, Domain, Surface};
use subdiv::{SubdivError, carried_over, subdivide};

/// The base mesh with a vertex in the middle of an edge. Its points are not asked for.
fn cut(base: &Domain, [a, b]: [VertexId; 2]) -> Domain {
    let (mesh, mut region) = (&base.mesh, base.region.clone());
    let m = VertexId::new(mesh.n_vertices());
    let positions = mesh.positions().iter().copied().chain([mesh.position(a).midpoint(mesh.position(b))]).collect();
    let (mut faces, mut sheets) = (Vec::new(), IdVec::new());
    for (f, corners) in mesh.faces().enumerate() {
        let with = |old: VertexId| corners.map(|v| if v == old { m.0 } else { v.0 });
        let parts = if corners.contains(&a) && corners.contains(&b) { vec![with(b), with(a)] } else { vec![with(m)] };
        for part in parts {
            faces.push(part);
            sheets.push(region.sheet_of_face[f]);
        }
    }
    let attachment = match region.span(a, b) {
        Some(span) => {
            let t = 0.5 * (span.from + span.to);
            region.spans.remove(&[a.min(b), a.max(b)]);
            region.insert_span(a, m, ArcSpan { to: t, ..span });
            region.insert_span(m, b, ArcSpan { from: t, ..span });
            Attachment::Arc { arc: span.arc, t }
        }
        None => Attachment::Sheet(base.region.sheet_of_face[base.topology.find_halfedge(a, b).unwrap().face()]),
    };
    region.attachments.push(attachment);
    region.points.push(region.points[a]);
    region.sheet_of_face = sheets;
    Domain::new(TriMesh::new(positions, faces).unwrap(), region).unwrap()
}

/// A surface as its own base mesh, its finest level with all vertices placed, and the base mesh with some edges bisected.
struct Bed {
    surface: Surface,
    base: Domain,
    before: Domain,
    base_after: Domain,
    bisections: Vec<[VertexId; 2]>,
}

impl Bed {
    fn new(mesh: TriMesh, levels: u32) -> Self {
        let surface = Surface::with_creases(mesh, 40.0).unwrap();
        let base = Domain::identity(&surface);
        let finest = subdivide(&base, levels).unwrap();
        let mut region = finest.domain.region.clone();
        region.points = finest.origins;
        let before = finest.domain.placed(&surface, region).unwrap();
        let (mut base_after, mut bisections) = (base.clone(), Vec::new());
        for i in 0..5usize {
            // The last ones cut what the first ones have made.
            let faces = base_after.mesh.faces();
            let face = faces[FaceId::new(if i < 2 { 3 * i % faces.len() } else { faces.len() - 1 - i % 2 })];
            let edge = [face[i % 3], face[(i + 1) % 3]];
            base_after = cut(&base_after, edge);
            bisections.push(edge);
        }
        Self { surface, base, before, base_after, bisections }
    }
}

#[test]
fn vertices_stay_and_new_ones_are_in_the_middle_of_their_edges() {
    let meshes = [
        fixtures::plane(),
        fixtures::cube(1),
        fixtures::l_block(1),
        fixtures::icosphere(2),
        fixtures::cylinder(1.0, 1.0, 8),
        fixtures::crossing_boxes(1),
    ];
    for (mesh, levels) in meshes.iter().flat_map(|mesh| (1..4).map(move |levels| (mesh, levels))) {
        let Bed { surface, base, before, base_after, bisections } = Bed::new(mesh.clone(), levels);
        let carried = carried_over(&surface, &before, &base.mesh, &base_after, &bisections).unwrap();
        let carried = carried.unwrap_or_else(|| panic!("{} faces at level {levels}", mesh.n_faces()));
        carried.domain.check(surface.network()).unwrap();
        let expected = subdivide(&base_after, levels).unwrap().domain.mesh;
        assert_eq!(carried.domain.mesh.faces(), expected.faces());
        for (v, p) in carried.domain.mesh.positions().enumerate() {
            assert!(p.distance(expected.position(v)) < 1e-9 * mesh.diagonal(), "{v} at level {levels}");
        }
        let is_old = |v: VertexId| before.mesh.positions().iter().any(|p| p.distance(expected.position(v)) < 1e-9);
        let at_new = |f: &FaceId| !expected.face(*f).into_iter().all(is_old);
        assert_eq!(carried.new_faces, expected.faces().ids().filter(at_new).collect::<Vec<_>>());
    }
}

#[test]
fn without_a_neighbour_inside_its_sheet_a_new_vertex_has_no_place() {
    // A square of two triangles: all its vertices are on the border, and the middle of the diagonal is not.
    let surface = Surface::smooth(fixtures::plane()).unwrap();
    let base = Domain::identity(&surface);
    let diagonal = base.topology.edge_ids().find(|&e| !base.topology.is_border_edge(e)).unwrap();
    let ends = base.topology.ends(diagonal);
    assert!(carried_over(&surface, &base, &base.mesh, &cut(&base, ends), &[ends]).unwrap().is_none());
}

#[test]
fn what_the_bisections_do_not_make_is_none() {
    let Bed { surface, base, before, base_after, bisections } = Bed::new(fixtures::cube(2), 2);
    let carried = |before: &Domain, base: &TriMesh, after: &Domain, bisections: &[[VertexId; 2]]| {
        carried_over(&surface, before, base, after, bisections).unwrap().is_some()
    };
    assert!(carried(&before, &base.mesh, &base_after, &bisections));
    assert!(!carried(&before, &base.mesh, &base_after, &bisections[1..]));
    assert!(!carried(&before, &base.mesh, &base_after, &[[VertexId(999), VertexId(7)]; 5]));
    assert!(!carried(&before, &fixtures::cube(1), &base_after, &bisections));
    assert!(!carried(&before, &base_after.mesh, &base_after, &bisections));
}

#[test]
fn domains_that_do_not_fit_are_refused() {
    let Bed { surface, base, before, base_after, bisections } = Bed::new(fixtures::cube(2), 1);
    let mut foreign = before.clone();
    foreign.region.points[VertexId(3)].face = FaceId(99_999);
    let refused = carried_over(&surface, &foreign, &base.mesh, &base_after, &bisections).unwrap_err();
    assert!(matches!(refused, SubdivError::Region(_)), "{refused}");
    let other = Domain { mesh: fixtures::cube(1), ..base_after };
    let refused = carried_over(&surface, &before, &base.mesh, &other, &bisections).unwrap_err();
    assert!(matches!(refused, SubdivError::Region(_)), "{refused}");
}
