//! Parts of a domain, relaxed by themselves.

mod common;

use common::{icosahedron, on_sphere};
use mesh_core::{FaceId, HalfedgeId, VertexId};
use relax::ShapeOptions;
use relax::parts::{Freedom, OnArc, Part, PartFace, PlacedVertex, Whole};
use std::collections::BTreeMap;

/// All faces of a domain as one part, with the target areas given.
fn all<'a>(whole: &Whole<'a>, bed: &common::Bed, target: impl Fn(FaceId) -> f64) -> Part<'a> {
    let normals = |f| [0, 1, 2].map(|c| whole.normals()[HalfedgeId::of(f, c)]);
    let face = |(f, &corners): (FaceId, &[VertexId; 3])| PartFace { corners, normals: normals(f), target_area: target(f) };
    let faces: Vec<PartFace> = bed.domain.topology.faces().enumerate().map(face).collect();
    whole.part(&faces, |v| whole.freedoms()[v]).unwrap()
}

/// Small triangles wanted on one half of a sphere become smaller than those on the other.
#[test]
fn given_target_areas_are_sought() {
    let (positions, faces) = icosahedron();
    let bed = on_sphere(positions, &faces, 3);
    let mesh = &bed.domain.mesh;
    let whole = Whole::new(&bed.surface, &bed.domain).unwrap();
    let upper = |f: FaceId| mesh.centroid(f).z > 0.0;
    let part = all(&whole, &bed, |f| if upper(f) { 0.005 } else { 0.02 });
    let relaxed = part.relaxed(|v| whole.placed()[v], &ShapeOptions { size_weight: 1.0, ..Default::default() });
    let places: BTreeMap<VertexId, PlacedVertex> = relaxed.moved.into_iter().collect();
    let area = |f| mesh_core::area(mesh.face(f).map(|v| places[&v].position()));
    let sum = |up: bool| mesh.faces().ids().filter(|&f| upper(f) == up).map(area).sum::<f64>();
    assert!(sum(false) > 2.0 * sum(true), "{} {}", sum(false), sum(true));
}

/// With the mean areas as targets, what all triangles cost is what the whole costs, where nothing moves.
#[test]
fn a_part_costs_what_the_whole_costs() {
    let bed = common::cube(4, 2);
    let whole = Whole::new(&bed.surface, &bed.domain).unwrap();
    let options = ShapeOptions { untangling_steps: 0, steps: 0, ..Default::default() };
    let part = all(&whole, &bed, |f| whole.mean_area(bed.domain.region.sheet_of_face[f]));
    let relaxed = part.relaxed(|v| whole.placed()[v], &options);
    assert_eq!(relaxed.costs, whole.costs(&options));
    assert!(relaxed.moved.iter().all(|(v, placed)| placed.position() == whole.placed()[*v].position()));
    assert!(relaxed.moved.len() < bed.domain.mesh.n_vertices(), "corners don't move");
}

/// What comes from another surface is refused or stays, and faces that are no manifold are no part.
#[test]
fn what_does_not_belong_is_refused() {
    let (cube, sphere) = (common::cube(4, 1), on_sphere(icosahedron().0, &icosahedron().1, 0));
    let of_cube = Whole::new(&cube.surface, &cube.domain).unwrap();
    let of_sphere = Whole::new(&sphere.surface, &sphere.domain).unwrap();
    let mut on_arc: OnArc =
        of_cube.freedoms().iter().find_map(|f| if let Freedom::Arc(a) = f { Some(*a) } else { None }).unwrap();
    assert!(of_cube.placed_on_arc(&on_arc, 0.1).is_some() && of_sphere.placed_on_arc(&on_arc, 0.1).is_none());

    let normals = [of_sphere.normals()[HalfedgeId(0)]; 3];
    let face = |corners: [u32; 3]| PartFace { corners: corners.map(VertexId), normals, target_area: 1.0 };
    assert!(of_sphere.part(&[face([7, 8, 9])], |_| Freedom::Arc(on_arc)).is_some(), "neighbours outside: it stays");
    on_arc.behind.vertex = VertexId(7);
    on_arc.ahead.vertex = VertexId(8);
    assert!(of_sphere.part(&[face([7, 8, 9])], |_| Freedom::Arc(on_arc)).is_none());
    assert!(of_sphere.part(&[face([7, 8, 9]), face([7, 8, 10])], |_| Freedom::Sheet).is_none());
    assert!(of_sphere.part(&[face([7, 7, 9])], |_| Freedom::Sheet).is_none());

    let last = sphere.surface.mesh().n_faces() - 1;
    let far = of_sphere.placed().iter().max_by_key(|p| p.point().face).unwrap();
    assert!(last > cube.surface.mesh().n_faces());
    assert_eq!(of_cube.walked(far, glam::DVec3::X).point(), far.point());
}
