//! The field on shapes whose curvature is known.

use glam::DVec3;
use mesh_core::{TriMesh, VertexId};
use proptest::prelude::*;
use region_map::{ArcKind, Network, Sizing, Surface};
use sizing::{SizingOptions, sizing};

/// A mesh with its creases and borders.
struct Shape {
    surface: Surface,
}

impl Shape {
    fn new(mesh: TriMesh) -> Self {
        Self { surface: Surface::with_creases(mesh, 40.0).unwrap() }
    }

    /// The field, and what it promises anywhere: the range, and the gradation along every edge.
    fn field(&self, options: &SizingOptions) -> Sizing {
        let (mesh, topology) = (self.surface.mesh(), self.surface.topology());
        let field = sizing(&self.surface, options).unwrap();
        assert_eq!(field.relative.len(), mesh.n_vertices());
        let range = options.least..=options.range;
        assert!(field.relative.iter().all(|h| range.contains(h)), "range {range:?}");
        for e in topology.edge_ids() {
            let [a, b] = topology.ends(e);
            let growth = (field.relative[a] - field.relative[b]).abs();
            let most = options.gradation / options.edge_length * mesh.distance(a, b);
            assert!(growth <= most * (1.0 + 1e-12) + 1e-15, "edge {a} {b}: {growth} > {most}");
        }
        field
    }

    fn nearest(&self, to: DVec3) -> VertexId {
        let mesh = self.surface.mesh();
        let distance = |v: &VertexId| mesh.position(*v).distance(to);
        mesh.positions().ids().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
    }
}

fn mapped(mesh: &TriMesh, f: impl Fn(DVec3) -> DVec3) -> TriMesh {
    mesh.with_positions(mesh.positions().iter().map(|&p| f(p)).collect()).unwrap()
}

/// A unit sphere with a limb that reaches up to `1 + length`, its side about `width` from the z axis.
fn sphere_with_limb(length: f64, width: f64) -> TriMesh {
    // More vertices towards the pole, or the limb would be a few needles.
    let gathered = |d: DVec3| (d + 0.8 * (-(1.0 - d.z) / 0.3).exp() * DVec3::Z).normalize();
    mapped(&fixtures::icosphere(24), |d| {
        let d = gathered(d);
        let angle = d.z.clamp(-1.0, 1.0).acos();
        d * (1.0 + length * (-(angle / width).powi(2)).exp())
    })
}

/// A rectangle: its border is four arcs between corners, or it would bend there.
fn rectangle() -> Shape {
    let smooth = Surface::smooth(fixtures::plane()).unwrap();
    let (mesh, topology) = (smooth.mesh(), smooth.topology());
    let kinds = ArcKind::by_angle(mesh, topology, 40.0);
    let network = Network::trace(mesh, topology, &kinds, |_| true, Vec::new()).unwrap();
    Shape { surface: smooth.with_network(network).unwrap() }
}

#[test]
fn flat_sides_have_the_greatest_length_everywhere() {
    let with_creases = [fixtures::cube(1), fixtures::cube(6), fixtures::l_block(3)].map(Shape::new);
    for shape in with_creases.into_iter().chain([rectangle()]) {
        for share in [0.01, 0.1, 0.5] {
            let options = SizingOptions::new(share * shape.surface.mesh().diagonal());
            assert!(shape.field(&options).relative.iter().all(|h| *h == options.range));
        }
    }
}

/// A sphere of radius 1 turns by `edge_length` radians along an edge.
#[test]
fn on_a_sphere_the_length_is_that_of_its_radius() {
    let shape = Shape::new(fixtures::icosphere(20));
    for edge_length in [0.15, 0.2, 0.3, 0.8, 1.5, 1.7, 2.0, 2.4, 4.0] {
        let options = SizingOptions::new(edge_length);
        let even = (options.neutral_turn / edge_length).powf(0.25).clamp(1.0 / options.range, options.range);
        let expected = even.min((options.turn / edge_length).max(options.least));
        let field = shape.field(&options);
        assert!(field.relative.iter().all(|h| (h / expected - 1.0).abs() < 0.05), "{edge_length}: {:?}", field.relative);
    }
}

/// A circle of radius 1 likewise; the flat lids inside it are longer, as far as the gradation allows.
#[test]
fn the_rim_of_a_cylinder_is_an_arc_that_bends() {
    let shape = Shape::new(fixtures::cylinder(1.0, 6.0, 96));
    let options = SizingOptions { gradation: 10.0, ..SizingOptions::new(2.0) };
    let field = shape.field(&options);
    let rim = shape.nearest(DVec3::new(1.0, 0.0, 6.0));
    assert!(shape.surface.network().arcs.iter().any(|a| a.vertices.contains(&rim)));
    assert!((field.relative[rim] / 0.8 - 1.0).abs() < 0.05, "{}", field.relative[rim]);
    let middle = shape.nearest(DVec3::new(0.0, 0.0, 6.0));
    assert_eq!(field.relative[middle], options.range);
}

#[test]
fn edges_are_short_on_a_thin_limb_and_long_on_the_body() {
    let shape = Shape::new(sphere_with_limb(1.5, 0.15));
    let options = SizingOptions::new(0.6);
    let field = shape.field(&options);
    let at = |p: DVec3| field.relative[shape.nearest(p)];
    assert!(at(2.5 * DVec3::Z) < 0.7, "tip: {}", at(2.5 * DVec3::Z));
    assert_eq!([at(-DVec3::Z), at(DVec3::X)], [1.0 / options.range; 2]);
}

#[test]
fn limbs_of_the_blob_ask_for_less_than_its_body() {
    let shape = Shape::new(fixtures::blob(20));
    let edge_length = 0.25 * shape.surface.mesh().diagonal();
    let field = shape.field(&SizingOptions { gradation: 1.0, ..SizingOptions::new(edge_length) });
    let tip = shape.surface.mesh().positions().enumerate().max_by(|a, b| a.1.length().total_cmp(&b.1.length())).unwrap().0;
    let mean = field.relative.iter().sum::<f64>() / field.relative.len() as f64;
    assert!(field.relative[tip] < 0.8 * mean, "tip {}, mean {mean}", field.relative[tip]);
}

/// Lengths count relative to the edge length only: a power of two changes no bit.
#[test]
fn the_field_does_not_depend_on_the_unit() {
    let mesh = sphere_with_limb(0.8, 0.3);
    let field = Shape::new(mesh.clone()).field(&SizingOptions::new(0.7));
    for unit in [2f64.powi(-20), 2f64.powi(20)] {
        let scaled = Shape::new(mapped(&mesh, |p| unit * p)).field(&SizingOptions::new(unit * 0.7));
        assert_eq!(scaled, field);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn range_and_gradation_hold_for_any_options(
        which in 0..5usize,
        share in 0.02f64..0.8,
        turn in 0.1f64..3.0,
        least in 0.05f64..1.0,
        gradation in 0.0f64..2.0,
    ) {
        let mesh = match which {
            0 => sphere_with_limb(1.0, 0.2),
            1 => fixtures::blob(6),
            2 => fixtures::part(4),
            3 => fixtures::shell(8),
            _ => fixtures::cad(16),
        };
        let shape = Shape::new(mesh);
        let edge_length = share * shape.surface.mesh().diagonal();
        shape.field(&SizingOptions { turn, least, gradation, ..SizingOptions::new(edge_length) });
    }
}
