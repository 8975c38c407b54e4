//! Closest points of a mesh, found from a face that is known to be near: from face to face, as long as the distance falls, and
//! never across a barrier. So a point that is followed from place to place cannot jump to another sheet, to the far side of a
//! thin plate, or to a component that passes through this one.

use glam::DVec3;
use mesh_core::{EdgeId, FaceId, HalfedgeId, IdVec, SurfacePoint, Topology, TriMesh, closest_on_triangle};

/// A mesh with edges that may not be crossed.
#[derive(Clone, Copy)]
pub(crate) struct Terrain<'a> {
    pub(crate) mesh: &'a TriMesh,
    pub(crate) topology: &'a Topology,
    /// True for edges that may not be crossed.
    pub(crate) barriers: &'a IdVec<EdgeId, bool>,
}

/// The point of a face that is closest to some point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    pub(crate) point: SurfacePoint,
    pub(crate) squared_distance: f64,
}

impl Terrain<'_> {
    /// The point closest to `p` among those that can be reached from `start` over ever closer ones.
    pub(crate) fn closest_from(&self, start: FaceId, p: DVec3) -> Foot {
        let mut foot = self.foot(start, p);
        while let Some(lower) =
            self.lower_neighbour(&foot.point, p).filter(|lower| lower.squared_distance < foot.squared_distance)
        {
            foot = lower;
        }
        foot
    }

    /// The closest point of one face.
    pub(crate) fn foot(&self, face: FaceId, p: DVec3) -> Foot {
        let triangle = self.mesh.triangle(face);
        let point = SurfacePoint { face, barycentric: closest_on_triangle(p, triangle) };
        Foot { point, squared_distance: point.interpolate(triangle).distance_squared(p) }
    }

    fn lower_neighbour(&self, point: &SurfacePoint, p: DVec3) -> Option<Foot> {
        let mut best: Option<Foot> = None;
        self.visit_neighbours(point, |f| {
            let foot = self.foot(f, p);
            if best.is_none_or(|b| foot.squared_distance < b.squared_distance) {
                best = Some(foot);
            }
        });
        best
    }

    /// Visits the other faces that a point on an edge or at a vertex belongs to.
    fn visit_neighbours(&self, point: &SurfacePoint, mut visit: impl FnMut(FaceId)) {
        let inside = point.barycentric.to_array().map(|w| w > 0.0);
        match inside {
            [true, true, true] | [false, false, false] => {}
            [true, false, false] | [false, true, false] | [false, false, true] => {
                let corner = inside.iter().position(|&w| w).unwrap_or(0);
                self.visit_fan(HalfedgeId::of(point.face, corner), visit);
            }
            _ => {
                let opposite = inside.iter().position(|&w| !w).unwrap_or(0);
                if let Some(twin) = self.across(HalfedgeId::of(point.face, (opposite + 1) % 3)) {
                    visit(twin.face());
                }
            }
        }
    }

    /// Visits the faces around the start of `h` on both sides of its face, up to barriers.
    fn visit_fan(&self, h: HalfedgeId, mut visit: impl FnMut(FaceId)) {
        let mut at = h;
        while let Some(next) = self.across(at.prev()) {
            if next == h {
                return;
            }
            at = next;
            visit(at.face());
        }
        at = h;
        while let Some(twin) = self.across(at) {
            at = twin.next();
            visit(at.face());
        }
    }

    /// The halfedge on the other side, where there is one and no barrier.
    pub(crate) fn across(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        self.topology.twin(h).filter(|_| !self.barriers[self.topology.edge(h)])
    }
}
