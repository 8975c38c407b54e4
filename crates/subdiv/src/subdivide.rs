//! One level after the other.

use glam::DVec3;
use mesh_core::{FaceId, HalfedgeId, IdVec, SurfacePoint, Topology, TriMesh, VertexId};
use region_map::{ArcSpan, Attachment, RegionMap, RegionMapError};

/// A base mesh, subdivided.
#[derive(Clone, Debug)]
pub struct SubdivDomain {
    /// Vertices and faces of the finest level; positions are linear in the base triangles.
    pub mesh: TriMesh,
    /// Attachments of the finest level, inherited. The points of the base vertices are theirs; a new vertex has the point of an end
    /// of its edge until it is projected.
    pub region: RegionMap,
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
    /// The base mesh is not an oriented manifold.
    #[error("the base mesh is not an oriented manifold: {0}")]
    NotManifold(#[from] mesh_core::TopologyError),
    /// The region map is of another mesh.
    #[error(transparent)]
    Region(#[from] RegionMapError),
    /// Midpoints of coordinates so large that their sum is not finite.
    #[error("the base mesh is too large for its midpoints: {0}")]
    NotFinite(#[from] mesh_core::MeshError),
}

/// Splits every face `levels` times in four.
pub fn subdivide(base: &TriMesh, region: &RegionMap, levels: u32) -> Result<SubdivDomain, SubdivError> {
    let finest = 4u64.checked_pow(levels).and_then(|n| n.checked_mul(3 * base.n_faces() as u64));
    if finest.is_none_or(|n| n > u64::from(u32::MAX)) {
        return Err(SubdivError::TooLarge { faces: base.n_faces(), levels });
    }
    region.check_sizes(&Topology::new(base.faces(), base.n_vertices())?)?;
    let mut level = Level {
        positions: base.positions().clone(),
        faces: base.faces().clone(),
        corners: IdVec::filled([DVec3::X, DVec3::Y, DVec3::Z], base.n_faces()),
        region: region.clone(),
    };
    for _ in 0..levels {
        level = level.split()?;
    }
    let origins = level.origins(levels);
    let faces = level.faces.iter().map(|f| f.map(|v| v.0)).collect();
    let mesh = TriMesh::new(level.positions.into_vec(), faces)?;
    Ok(SubdivDomain { mesh, region: level.region, level: levels, origins })
}

/// A level under way.
struct Level {
    positions: IdVec<VertexId, DVec3>,
    faces: IdVec<FaceId, [VertexId; 3]>,
    /// Barycentric coordinates of the corners of every face in its base face.
    corners: IdVec<FaceId, [DVec3; 3]>,
    region: RegionMap,
}

impl Level {
    fn split(self) -> Result<Self, SubdivError> {
        let topology = Topology::new(&self.faces, self.positions.len())?;
        let n = self.positions.len() as u32;
        let midpoint = |h: HalfedgeId| VertexId(n + topology.edge(h).0);
        let mut next =
            Self { positions: self.positions.clone(), faces: IdVec::new(), corners: IdVec::new(), region: self.region };
        next.region.sheet_of_face = next.region.sheet_of_face.iter().flat_map(|&s| [s; 4]).collect();
        let spans = std::mem::take(&mut next.region.spans);
        for e in topology.edge_ids() {
            let [a, b] = topology.ends(e);
            let m = next.positions.push(self.positions[a].midpoint(self.positions[b]));
            let (lo, hi) = (a.min(b), a.max(b));
            let attachment = match spans.get(&[lo, hi]) {
                Some(&span) => next.split_span(span, lo, hi, m),
                None => Attachment::Sheet(next.region.sheet_of_face[FaceId(4 * topology.halfedge(e).face().0)]),
            };
            next.region.attachments.push(attachment);
            next.region.points.push(next.region.points[a]);
        }
        for (f, &[a, b, c]) in self.faces.enumerate() {
            let [ab, bc, ca] = topology.halfedges(f).map(midpoint);
            let [wa, wb, wc] = self.corners[f];
            let [wab, wbc, wca] = [wa.midpoint(wb), wb.midpoint(wc), wc.midpoint(wa)];
            for (vertices, weights) in [
                ([a, ab, ca], [wa, wab, wca]),
                ([b, bc, ab], [wb, wbc, wab]),
                ([c, ca, bc], [wc, wca, wbc]),
                ([bc, ca, ab], [wbc, wca, wab]),
            ] {
                next.faces.push(vertices);
                next.corners.push(weights);
            }
        }
        Ok(next)
    }

    /// Halves a span at the midpoint `m` of its edge.
    fn split_span(&mut self, span: ArcSpan, lo: VertexId, hi: VertexId, m: VertexId) -> Attachment {
        let t = 0.5 * (span.from + span.to);
        self.region.insert_span(lo, m, ArcSpan { to: t, ..span });
        self.region.insert_span(m, hi, ArcSpan { from: t, ..span });
        Attachment::Arc { arc: span.arc, t }
    }

    fn origins(&self, levels: u32) -> IdVec<VertexId, SurfacePoint> {
        // Every vertex of a manifold has a face; an isolated base vertex keeps this default and is never looked up.
        let mut origins = IdVec::filled(SurfacePoint::at_corner(FaceId(0), 0), self.positions.len());
        for (f, vertices) in self.faces.enumerate() {
            for (v, &barycentric) in vertices.iter().zip(&self.corners[f]) {
                origins[*v] = SurfacePoint { face: FaceId(f.0 >> (2 * levels)), barycentric };
            }
        }
        origins
    }
}
