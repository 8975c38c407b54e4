//! One level after the other.

use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, IdVec, SurfacePoint, Topology, TriMesh, VertexId};
use region_map::{ArcSpan, Attachment, Domain, RegionMap, RegionMapError};
use std::sync::Arc;

/// A base mesh, subdivided.
#[derive(Clone, Debug)]
pub struct SubdivDomain {
    /// The finest level; positions are linear in the base triangles, and attachments inherited. The points of the base vertices
    /// are theirs; a new vertex has the point of an end of its edge until it is projected.
    pub domain: Domain,
    /// How many times every face was split.
    pub level: u32,
    /// Every vertex as a point of a base face. The base vertices come first.
    pub origins: IdVec<VertexId, SurfacePoint>,
}

/// Why a base mesh cannot be subdivided.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SubdivError {
    /// The finest level would have more halfedges than ids.
    #[error("{faces} base faces at level {levels} are too many; ask for fewer levels or base vertices")]
    TooLarge {
        /// Base faces.
        faces: usize,
        /// Levels asked for.
        levels: u32,
    },
    /// The faces of the base mesh are not an oriented manifold.
    #[error("the base mesh is not an oriented manifold: {0}")]
    NotManifold(#[from] mesh_core::TopologyError),
    /// The mesh, the topology and the region map of a domain are not of the same size, or don't fit the surface.
    #[error(transparent)]
    Region(#[from] RegionMapError),
    /// Midpoints of coordinates so large that their sum is not finite.
    #[error("the base mesh is too large for its midpoints: {0}")]
    NotFinite(#[from] mesh_core::MeshError),
}

/// Splits every face of a base mesh `levels` times in four.
///
/// Fails where the finest level would have too many faces, where the parts of the base are not of the same size, or where a
/// midpoint is not finite.
pub fn subdivide(base: &Domain, levels: u32) -> Result<SubdivDomain, SubdivError> {
    let n_faces = base.topology.n_faces();
    let finest = 4u64.checked_pow(levels).and_then(|n| n.checked_mul(3 * n_faces as u64));
    if finest.is_none_or(|n| n > u64::from(u32::MAX)) {
        return Err(SubdivError::TooLarge { faces: n_faces, levels });
    }
    check_sizes(base)?;
    let mut level = Level {
        positions: base.mesh.positions().clone(),
        topology: base.topology.clone(),
        corners: IdVec::filled([DVec3::X, DVec3::Y, DVec3::Z], n_faces),
        region: base.region.clone(),
    };
    for _ in 0..levels {
        level = level.split()?;
    }
    let origins = level.origins(levels);
    let faces = level.topology.faces().iter().map(|f| f.map(|v| v.0)).collect();
    let mesh = TriMesh::new(level.positions.into_vec(), faces)?;
    let domain = Domain { mesh, topology: level.topology, region: level.region };
    Ok(SubdivDomain { domain, level: levels, origins })
}

/// Mesh, topology and region map are of the same size.
fn check_sizes(Domain { mesh, topology, region }: &Domain) -> Result<(), RegionMapError> {
    for (found, expected) in [(mesh.n_vertices(), topology.n_vertices()), (mesh.n_faces(), topology.n_faces())] {
        if found != expected {
            return Err(RegionMapError::WrongSize { what: "the mesh", found, expected });
        }
    }
    region.check_sizes(topology)
}

/// A level under way.
struct Level {
    positions: IdVec<VertexId, DVec3>,
    topology: Arc<Topology>,
    /// Barycentric coordinates of the corners of every face in its base face.
    corners: IdVec<FaceId, [DVec3; 3]>,
    region: RegionMap,
}

impl Level {
    fn split(self) -> Result<Self, SubdivError> {
        let topology = &self.topology;
        let n = self.positions.len() as u32;
        let midpoint = |h: HalfedgeId| VertexId(n + topology.edge(h).0);
        let mut positions = self.positions.clone();
        let mut region = self.region;
        region.sheet_of_face = region.sheet_of_face.iter().flat_map(|&s| [s; 4]).collect();
        let spans = std::mem::take(&mut region.spans);
        for e in topology.edge_ids() {
            let [a, b] = topology.ends(e);
            let m = positions.push(self.positions[a].midpoint(self.positions[b]));
            let (lo, hi) = (a.min(b), a.max(b));
            let attachment = match spans.get(&[lo, hi]) {
                Some(&span) => split_span(&mut region, span, lo, hi, m),
                None => Attachment::Sheet(region.sheet_of_face[FaceId(4 * topology.halfedge(e).face().0)]),
            };
            region.attachments.push(attachment);
            region.points.push(region.points[a]);
        }
        let (mut faces, mut corners) = (IdVec::<FaceId, _>::new(), IdVec::new());
        for (f, &[a, b, c]) in topology.faces().enumerate() {
            let [ab, bc, ca] = topology.halfedges(f).map(midpoint);
            let [wa, wb, wc] = self.corners[f];
            let [wab, wbc, wca] = [wa.midpoint(wb), wb.midpoint(wc), wc.midpoint(wa)];
            for (vertices, weights) in [
                ([a, ab, ca], [wa, wab, wca]),
                ([b, bc, ab], [wb, wbc, wab]),
                ([c, ca, bc], [wc, wca, wbc]),
                ([bc, ca, ab], [wbc, wca, wab]),
            ] {
                faces.push(vertices);
                corners.push(weights);
            }
        }
        let topology = Arc::new(Topology::new(&faces, positions.len())?);
        Ok(Self { positions, topology, corners, region })
    }

    fn origins(&self, levels: u32) -> IdVec<VertexId, SurfacePoint> {
        // Every vertex of a manifold has a face; an isolated base vertex keeps this default and is never looked up.
        let mut origins = IdVec::filled(SurfacePoint::at_corner(FaceId(0), 0), self.positions.len());
        for (f, vertices) in self.topology.faces().enumerate() {
            for (v, &barycentric) in vertices.iter().zip(&self.corners[f]) {
                origins[*v] = SurfacePoint { face: FaceId(f.0 >> (2 * levels)), barycentric };
            }
        }
        origins
    }
}

/// Halves a span at the midpoint `m` of its edge.
fn split_span(region: &mut RegionMap, span: ArcSpan, lo: VertexId, hi: VertexId, m: VertexId) -> Attachment {
    let t = 0.5 * (span.from + span.to);
    region.insert_span(lo, m, ArcSpan { to: t, ..span });
    region.insert_span(m, hi, ArcSpan { from: t, ..span });
    Attachment::Arc { arc: span.arc, t }
}
