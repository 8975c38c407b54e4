//! Charts of patches whose shape is known, and arguments that are wrong.

use chart::{ArcVertex, BorderVertices, PatchChart, PieceMesh, chart_patch, lay_flat};
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, Id as _, IdVec, VertexId};
use proptest::prelude::*;
use region_map::{CellArcId, CellCornerId, Cells, PatchId, Segmentation, Surface};

/// A surface cut at its creases and, if it is round, into octants.
fn cells(surface: &Surface, octants: bool) -> Cells {
    let (mesh, topology) = (surface.mesh(), surface.topology());
    let octant = |f: FaceId| if octants { mesh.centroid(f).cmpgt(DVec3::ZERO).bitmask() } else { 0 };
    let same = |e| topology.edge_faces(e).1.is_some_and(|g| octant(g) == octant(topology.edge_faces(e).0));
    let (patches, n_patches) = topology.regions(|e| !surface.network().is_barrier(e) && same(e));
    let patch_of_face = patches.iter().map(|&p| PatchId(p)).collect();
    Cells::trace(surface, &Segmentation { patch_of_face, n_patches }).unwrap()
}

/// Base vertices at the corners, and so many more along every arc.
fn border(cells: &Cells, on_each_arc: usize) -> BorderVertices {
    let mut next = cells.corners.len();
    let mut vertex = || {
        next += 1;
        VertexId::new(next - 1)
    };
    let mut along = |length: f64| -> Vec<ArcVertex> {
        let step = length / (on_each_arc + 1) as f64;
        (1..=on_each_arc).map(|i| ArcVertex { t: step * i as f64, vertex: vertex() }).collect()
    };
    let on_arcs = cells.arcs.iter().map(|a| along(a.length())).collect();
    BorderVertices { at_corners: cells.corners.ids().map(|c| VertexId(c.0)).collect(), on_arcs }
}

fn flat_area(corners: &[DVec2]) -> f64 {
    let n = corners.len();
    0.5 * (0..n).map(|i| corners[i].perp_dot(corners[(i + 1) % n])).sum::<f64>()
}

#[test]
fn a_square_is_charted_onto_a_square() {
    let surface = Surface::with_creases(fixtures::cube(6), 40.0).unwrap();
    let cells = cells(&surface, false);
    for patch in cells.patches.ids() {
        let PatchChart { chart, polygon } = chart_patch(surface.mesh(), &cells, patch, &border(&cells, 0), 0.05).unwrap();
        let corners: Vec<DVec2> = polygon.iter().map(|c| c.at).collect();
        let side = corners[0].distance(corners[1]);
        assert!((1..4).all(|i| (corners[i].distance(corners[(i + 1) % 4]) / side - 1.0).abs() < 1e-9));
        // About one scale all over: the side of the cube is 1 long. (Weights that are kept positive are not quite harmonic.)
        for piece in chart.faces() {
            let flat = flat_area(&piece.vertices.map(|v| chart.uv()[v as usize]));
            let corners = piece.barycentric.map(|b| region_map::SurfacePoint { face: piece.source, barycentric: b });
            let area = mesh_core::area(corners.map(|p| p.position(surface.mesh())));
            let scale = flat / (side * side * area);
            assert!((scale - 1.0).abs() < 0.1, "{scale}");
        }
    }
}

#[test]
fn a_chart_covers_its_polygon_once() {
    let surface = Surface::smooth(fixtures::icosphere(6)).unwrap();
    let cells = cells(&surface, true);
    for n in [0, 1, 5] {
        let border = border(&cells, n);
        for patch in cells.patches.ids() {
            let PatchChart { chart, polygon } = chart_patch(surface.mesh(), &cells, patch, &border, 0.05).unwrap();
            assert!(polygon.len() >= 3 * (n + 1));
            let corners: Vec<DVec2> = polygon.iter().map(|c| c.at).collect();
            let covered: f64 = chart.faces().iter().map(|f| flat_area(&f.vertices.map(|v| chart.uv()[v as usize]))).sum();
            assert!((covered / flat_area(&corners) - 1.0).abs() < 1e-9);
            // Every base vertex of the arcs is at its corner of the polygon.
            for &(arc, _) in &cells.patches[patch].border {
                for on_arc in &border.on_arcs[arc] {
                    let corner = polygon.iter().find(|c| c.vertex == on_arc.vertex).unwrap();
                    let there = chart.locate(corner.at).position(surface.mesh());
                    assert!(there.distance(cells.arcs[arc].position(surface.mesh(), on_arc.t)) < 1e-9);
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn arguments_that_do_not_belong_together_give_no_chart(what in 0..9usize, id in prop_oneof![0..30u32, Just(u32::MAX)], number in prop_oneof![Just(f64::NAN), Just(-1.0), Just(1e300), 0.0..2.0f64]) {
        let surface = Surface::with_creases(fixtures::cube(3), 40.0).unwrap();
        let mut cells = cells(&surface, false);
        let mut border = border(&cells, 2);
        let (mut patch, mut max_shrunk) = (PatchId(0), 0.05);
        let arc = cells.patches[patch].border[0].0;
        match what {
            0 => patch = PatchId(id),
            1 => max_shrunk = number,
            2 => border.on_arcs[arc][0].t = number,
            3 => border.on_arcs = IdVec::new(),
            4 => border.at_corners = IdVec::new(),
            5 => cells.arcs[arc].corners = [CellCornerId(id); 2],
            6 => cells.arcs[arc].vertices[1] = VertexId(id),
            7 => cells.patches[patch].border[1].0 = CellArcId(id),
            _ => cells.patches[patch].faces[0] = FaceId(id),
        }
        if let Some(found) = chart_patch(surface.mesh(), &cells, patch, &border, max_shrunk) {
            prop_assert!(found.chart.uv().iter().all(|p| p.is_finite()));
        }
    }

    #[test]
    fn tables_that_are_too_short_lay_nothing_flat(missing in 1..5usize, of_positions: bool) {
        let pieces = PieceMesh::of_mesh(&fixtures::plane());
        let n = pieces.positions().len();
        let fixed = vec![Some(DVec2::ZERO); n - if of_positions { 0 } else { missing.min(n) }];
        let positions = &pieces.positions()[..n - if of_positions { missing.min(n) } else { 0 }];
        prop_assert!(lay_flat(positions, pieces.pieces().to_vec(), &fixed).is_none());
    }
}
