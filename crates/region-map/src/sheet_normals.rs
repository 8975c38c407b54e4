//! Normals of the working mesh that are smooth inside a sheet and one-sided at arcs.

use crate::Network;
use glam::DVec3;
use mesh_core::{HalfedgeId, IdVec, SurfacePoint, Topology, TriMesh, VertexId};

/// A unit normal for every corner of every working face.
///
/// The faces round a vertex form sectors between barrier edges (edges on arcs). All corners of a sector share one normal, the
/// mean of its faces' normals weighted by their angles at the vertex. Interpolated over the faces this is continuous inside a
/// sheet, and each side of an arc has its own. Where a sector has no normal (its faces have no area, or cancel) it is zero.
#[derive(Clone, Debug)]
pub struct SheetNormals {
    at_corner: IdVec<HalfedgeId, DVec3>,
}

impl SheetNormals {
    /// Computes the normals of a working mesh.
    pub fn new(mesh: &TriMesh, topology: &Topology, network: &Network) -> Self {
        let weighted = weighted_corner_normals(mesh);
        let mut at_corner = IdVec::filled(DVec3::ZERO, weighted.len());
        for v in mesh.positions().ids() {
            for sector in sectors(topology, network, v) {
                let normal = sector.iter().map(|&h| weighted[h]).sum::<DVec3>().normalize_or_zero();
                for h in sector {
                    at_corner[h] = normal;
                }
            }
        }
        Self { at_corner }
    }

    /// The normal at the corner that a halfedge starts at, on the side of the halfedge's face.
    pub fn at_corner(&self, h: HalfedgeId) -> DVec3 {
        self.at_corner[h]
    }

    /// The unit normal at a point, seen from the point's face; zero where the corners' normals cancel.
    pub fn at(&self, point: SurfacePoint) -> DVec3 {
        point.interpolate([0, 1, 2].map(|c| self.at_corner[HalfedgeId::of(point.face, c)])).normalize_or_zero()
    }

    /// The unit normal `s` (0 to 1) of the way along a halfedge, on the side of its face.
    pub fn along(&self, h: HalfedgeId, s: f64) -> DVec3 {
        self.at_corner[h].lerp(self.at_corner[h.next()], s).normalize_or_zero()
    }
}

/// The face's normal times the angle, for every corner of every face.
fn weighted_corner_normals(mesh: &TriMesh) -> IdVec<HalfedgeId, DVec3> {
    let corners = mesh.faces().ids().flat_map(|f| {
        let triangle = mesh.triangle(f);
        let normal = mesh_core::normal(triangle);
        mesh_core::angles(triangle).map(|angle| angle * normal)
    });
    corners.collect()
}

/// The outgoing halfedges of a vertex, counter-clockwise, cut where a barrier edge lies between two of them.
fn sectors(topology: &Topology, network: &Network, v: VertexId) -> Vec<Vec<HalfedgeId>> {
    let mut sectors: Vec<Vec<HalfedgeId>> = Vec::new();
    for h in topology.fan(v) {
        match sectors.last_mut() {
            Some(sector) if !network.is_barrier(topology.edge(h)) => sector.push(h),
            _ => sectors.push(vec![h]),
        }
    }
    // A closed fan may have begun in the middle of a sector.
    let begins_inside =
        topology.fan(v).next().is_some_and(|h| topology.twin(h).is_some() && !network.is_barrier(topology.edge(h)));
    if begins_inside
        && sectors.len() > 1
        && let Some(last) = sectors.pop()
    {
        sectors[0].extend(last);
    }
    sectors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ArcKind;
    use mesh_core::FaceId;

    /// Normals of a mesh whose edges are barriers where they bend by more than 40 degrees or bound.
    fn normals(mesh: &TriMesh) -> (Topology, SheetNormals) {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let network = Network::trace(mesh, &topology, &ArcKind::by_angle(mesh, &topology, 40.0), |_| false, vec![]).unwrap();
        let normals = SheetNormals::new(mesh, &topology, &network);
        (topology, normals)
    }

    fn cube() -> TriMesh {
        let p = (0..8).map(|i| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2 & 1) as f64)).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        TriMesh::new(p, quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()).unwrap()
    }

    /// A ring of `n` quads between two circles of these radii at heights 0 and 1, closed by fans where a radius is zero.
    fn frustum(n: u32, bottom: f64, top: f64) -> TriMesh {
        let at = |i: u32, r: f64, z: f64| {
            let a = std::f64::consts::TAU * f64::from(i) / f64::from(n);
            DVec3::new(r * a.cos(), r * a.sin(), z)
        };
        let mut p: Vec<_> = (0..n).map(|i| at(i, bottom, 0.0)).chain((0..n).map(|i| at(i, top, 1.0))).collect();
        p.extend([DVec3::ZERO, DVec3::Z]);
        let mut faces = Vec::new();
        for i in 0..n {
            let j = (i + 1) % n;
            faces.push([2 * n, j, i]);
            if top > 0.0 {
                faces.extend([[i, j, n + j], [i, n + j, n + i], [2 * n + 1, n + i, n + j]]);
            } else {
                faces.push([i, j, 2 * n + 1]);
            }
        }
        TriMesh::new(p, faces).unwrap()
    }

    #[test]
    fn on_a_cube_every_corner_has_its_face_normal() {
        let mesh = cube();
        let (topology, normals) = normals(&mesh);
        for f in mesh.faces().ids() {
            for h in topology.halfedges(f) {
                assert!(normals.at_corner(h).distance(mesh.normal(f)) < 1e-12);
            }
            assert!(normals.at(SurfacePoint::new(f, DVec3::ONE)).distance(mesh.normal(f)) < 1e-12);
        }
    }

    #[test]
    fn on_a_cylinder_the_side_is_smooth_and_the_lids_are_flat() {
        let n = 24;
        let mesh = frustum(n, 1.0, 1.0);
        let (topology, normals) = normals(&mesh);
        for f in mesh.faces().ids() {
            for h in topology.halfedges(f) {
                let expected = if mesh.normal(f).z.abs() > 0.5 {
                    mesh.normal(f)
                } else {
                    (mesh.position(topology.from(h)) * DVec3::new(1.0, 1.0, 0.0)).normalize()
                };
                // The weights of the side's three triangles at a vertex are not symmetric.
                assert!(normals.at_corner(h).distance(expected) < std::f64::consts::TAU / f64::from(n) / 4.0);
            }
        }
    }

    #[test]
    fn both_faces_of_an_edge_inside_a_sheet_agree_along_it() {
        let mesh = frustum(16, 1.0, 0.4);
        let (topology, normals) = normals(&mesh);
        let (mut smooth, mut sharp) = (0, 0);
        for e in topology.edge_ids() {
            let h = topology.halfedge(e);
            let twin = topology.twin(h).unwrap();
            let jump = [0.0, 0.3, 1.0].map(|s| normals.along(h, s).distance(normals.along(twin, 1.0 - s)));
            if mesh.normal(h.face()).dot(mesh.normal(twin.face())) < 40f64.to_radians().cos() {
                sharp += 1;
                assert!(jump.iter().all(|j| *j > 0.3));
            } else {
                smooth += 1;
                assert!(jump.iter().all(|j| *j < 1e-12));
            }
        }
        assert_eq!((smooth, sharp), (64, 32));
    }

    #[test]
    fn the_apex_of_a_cone_points_up_and_a_border_is_one_sided() {
        let mesh = frustum(16, 1.0, 0.0);
        let (topology, closed) = normals(&mesh);
        let apex = topology.fan(VertexId(33)).next().unwrap();
        assert!(closed.at_corner(apex).distance(DVec3::Z) < 1e-12);
        // Without its lid: the rim's normals are those of the side.
        let open = mesh.faces().iter().filter(|f| f[0] != VertexId(32)).map(|f| f.map(|v| v.0)).collect();
        let mesh = TriMesh::new(mesh.positions().as_slice().to_vec(), open).unwrap();
        let (_, open) = normals(&mesh);
        let rim = open.at_corner(HalfedgeId::of(FaceId(0), 0));
        assert!((rim.z - 0.5f64.sqrt()).abs() < 0.02, "{rim}");
    }
}
