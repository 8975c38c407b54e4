//! [`FaceTree`]: triangles in a tree of boxes, and the descent that every query takes.
//!
//! The tree is built by `obvhs`. It is f32, so the boxes live in a frame of unit size, are rounded outwards and padded.

use crate::measure::{Bounds, normal};
use crate::{FaceId, TriMesh};
use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::bvh2::node::Bvh2Node;
use std::ops::Range;
use std::time::Duration;

/// Boxes are grown by this share of the unit frame: f32 rounds 16 times finer, and a ray exactly in the unpadded face of a box
/// was measured to miss it (258 of 8450 rays along the borders of flat patches).
pub(crate) const PADDING: f64 = 1e-6;
/// Where boxes are equal the builder joins one pair at a time (measured: 12 s for 20 000 equal triangles, 0.05 s with spread
/// paddings). The multiples of this spread evenly over a cube (Roberts's sequence R3).
const SPREAD: DVec3 = DVec3::new(0.819_172_513_396_164, 0.671_043_606_703_789, 0.549_700_477_901_970);

/// A face with a copy of its corners.
#[derive(Clone, Copy)]
pub(crate) struct Leaf {
    pub(crate) face: FaceId,
    pub(crate) triangle: [DVec3; 3],
}

impl Leaf {
    /// Unit normal, 0 without area.
    pub(crate) fn normal(&self) -> DVec3 {
        normal(self.triangle)
    }

    /// Whether the face and something with the normal `other` face different ways.
    pub(crate) fn faces_against(&self, other: DVec3) -> bool {
        self.normal().dot(other) < 0.0
    }
}

/// Triangles in a tree of boxes.
#[derive(Clone)]
pub(crate) struct FaceTree {
    tree: Bvh2,
    /// In the order of the tree: those of each of its leaf nodes are beside each other.
    pub(crate) leaves: Vec<Leaf>,
    /// The box of each of the leaves.
    boxes: Vec<Aabb>,
    pub(crate) frame: Frame,
    /// The box of all triangles, in the units of the mesh.
    pub(crate) bounds: Option<Bounds>,
}

impl FaceTree {
    /// Some faces of a mesh. Those that it has not are left out.
    pub(crate) fn of_faces(mesh: &TriMesh, faces: impl IntoIterator<Item = FaceId>) -> Self {
        let is_there = |f: &FaceId| mesh.faces().get(*f).is_some();
        let faces = faces.into_iter().filter(is_there);
        let leaves: Vec<_> = faces.map(|face| Leaf { face, triangle: mesh.triangle(face) }).collect();
        let bounds = Bounds::of(leaves.iter().flat_map(|leaf| leaf.triangle));
        let frame = Frame::of(bounds);
        let boxes: Vec<_> = leaves.iter().enumerate().map(|(i, leaf)| frame.padded_box(leaf.triangle, i)).collect();
        let tree = build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
        let leaves = tree.primitive_indices.iter().map(|&i| leaves[i as usize]).collect();
        let boxes = tree.primitive_indices.iter().map(|&i| boxes[i as usize]).collect();
        Self { tree, leaves, boxes, frame, bounds }
    }

    /// Shows the query the triangles that may be of interest to it.
    pub(crate) fn descend<'a>(&'a self, query: &mut impl Query<'a>) {
        if let Some(root) = self.tree.nodes.first() {
            self.descend_into(root, query);
        }
    }

    fn descend_into<'a>(&'a self, mut node: &'a Bvh2Node, query: &mut impl Query<'a>) {
        while !node.is_leaf() {
            let first = node.first_index as usize;
            let children = [&self.tree.nodes[first], &self.tree.nodes[first + 1]];
            let bounds = children.map(|child| query.lower_bound(child.aabb()));
            let near = usize::from(bounds[1] < bounds[0]);
            if bounds[near] <= query.limit() {
                self.descend_into(children[near], query);
            }
            if bounds[1 - near] <= query.limit() {
                node = children[1 - near];
            } else {
                return;
            }
        }
        let range = range(node);
        for (leaf, unit_box) in self.leaves[range.clone()].iter().zip(&self.boxes[range]) {
            if query.lower_bound(unit_box) <= query.limit() {
                query.visit(leaf);
            }
        }
    }

    /// The leaf nodes of the tree: where in `leaves` their triangles are, and a box that holds them.
    pub(crate) fn leaf_nodes(&self) -> Vec<(Range<usize>, Aabb)> {
        self.tree.nodes.iter().filter(|node| node.is_leaf()).map(|node| (range(node), *node.aabb())).collect()
    }

    /// Shows the triangles of the leaf nodes whose boxes meet `unit_box`, node by node, as long as `visit` wants more.
    pub(crate) fn for_each_meeting<'a>(&'a self, unit_box: &Aabb, mut visit: impl FnMut(&'a [Leaf]) -> bool) {
        if let Some(root) = self.tree.nodes.first() {
            self.for_each_meeting_in(root, unit_box, &mut visit);
        }
    }

    /// False once `visit` wants no more.
    fn for_each_meeting_in<'a>(
        &'a self,
        mut node: &'a Bvh2Node,
        unit_box: &Aabb,
        visit: &mut impl FnMut(&'a [Leaf]) -> bool,
    ) -> bool {
        while node.aabb().intersect_aabb(unit_box) {
            if node.is_leaf() {
                return visit(&self.leaves[range(node)]);
            }
            let first = node.first_index as usize;
            if !self.for_each_meeting_in(&self.tree.nodes[first], unit_box, visit) {
                return false;
            }
            node = &self.tree.nodes[first + 1];
        }
        true
    }
}

/// Where the triangles of a leaf node are.
fn range(node: &Bvh2Node) -> Range<usize> {
    let first = node.first_index as usize;
    first..first + node.prim_count as usize
}

/// A search for the triangle with the least value of something.
pub(crate) trait Query<'a> {
    /// How values are compared with boxes: the values themselves, or anything that rises with them.
    type Bound: PartialOrd + Copy;
    /// No triangle in the box has a lower value. Greater than any [`Self::limit`] where none counts.
    fn lower_bound(&self, unit_box: &Aabb) -> Self::Bound;
    /// Values above this are of no interest any more.
    fn limit(&self) -> Self::Bound;
    /// Looks at one triangle.
    fn visit(&mut self, leaf: &'a Leaf);
}

/// The frame in which the triangles fit a box of size 1 around the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    centre: DVec3,
    pub(crate) size: f64,
}

impl Frame {
    fn of(bounds: Option<Bounds>) -> Self {
        let Some(bounds) = bounds else {
            return Self { centre: DVec3::ZERO, size: 1.0 };
        };
        let size = (bounds.max - bounds.min).max_element();
        if !size.is_finite() {
            // A box from one end of the numbers to the other.
            return Self { centre: DVec3::ZERO, size: f64::MAX };
        }
        Self { centre: bounds.centre(), size: if size > 0.0 { size } else { 1.0 } }
    }

    pub(crate) fn to_unit(self, p: DVec3) -> DVec3 {
        (p - self.centre) / self.size
    }

    /// The box of a triangle, with one to two paddings on each side: no two boxes are quite equal, even of equal triangles.
    fn padded_box(self, triangle: [DVec3; 3], index: usize) -> Aabb {
        let [a, b, c] = triangle.map(|p| self.to_unit(p));
        let spread = (index as f64 * SPREAD).fract();
        let min = (a.min(b).min(c) - PADDING * (1.0 + spread)).to_array().map(|x| (x as f32).next_down());
        let max = (a.max(b).max(c) + PADDING * (2.0 - spread)).to_array().map(|x| (x as f32).next_up());
        Aabb::new(Vec3A::from_array(min), Vec3A::from_array(max))
    }
}
