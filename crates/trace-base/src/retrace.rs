//! The other verb: a base mesh that is one of the surface already gets a new map.

use crate::Untraced;
use crate::stops::Stop;
use crate::tracer::Tied;
use glam::DVec3;
use mesh_core::{EdgeId, Id as _, IdVec, TriMesh, VertexId};
use rayon::prelude::*;
use region_map::{ArcId, Attachment, BaseMesh, CornerId, Domain, MapFaceId, Network, RegionMap, Surface};

/// So many steps are made along a base edge to see where the present map has it.
const SAMPLES: usize = 12;

/// Gives a base mesh a new map: its edges traced as short paths that do not cross, near to where its present map has them, and a
/// chart for every face.
///
/// Each edit of a base mesh lays a few faces flat, and the next one distorts what it has distorted. The new map has no edits, so its
/// round trips are exact to rounding. Vertices, edges and faces stay what and where they are, but for a vertex inside a sheet that is
/// very near to a working vertex or edge: it is put there.
///
/// Fails where the base mesh does not fit the surface, where an edge is shut out by others, and where a face cannot be laid flat; the
/// present map is still good then.
pub fn retrace(surface: &Surface, base: &BaseMesh) -> Result<BaseMesh, Untraced> {
    let Domain { mesh, topology, region } = &base.domain;
    base.check(surface).map_err(|_| Untraced::OtherSurface)?;
    let tied = Tied {
        surface,
        base: mesh,
        topology,
        corners: &corners(surface.network(), region).ok_or(Untraced::OtherSurface)?,
        chains: &chains(surface.network(), region),
        via: via(surface.mesh(), base),
    };
    let mut region = region.clone();
    let map = tied.map(&mut region)?;
    let domain = base.domain.placed(surface, region).map_err(|_| Untraced::NotFinite)?;
    let map_faces = (0..mesh.n_faces()).map(MapFaceId::new).collect();
    Ok(BaseMesh { domain, map, map_faces })
}

/// The base vertex at every corner; `None` where a corner has none.
fn corners(network: &Network, region: &RegionMap) -> Option<IdVec<CornerId, VertexId>> {
    let mut corners = IdVec::filled(None, network.corners.len());
    for (v, attachment) in region.attachments.enumerate() {
        if let Attachment::Corner(c) = *attachment {
            corners[c] = Some(v);
        }
    }
    corners.iter().copied().collect::<Option<Vec<_>>>().map(IdVec::from_vec)
}

/// The base vertices along every arc.
fn chains(network: &Network, region: &RegionMap) -> IdVec<ArcId, Vec<Stop>> {
    let mut steps: IdVec<ArcId, Vec<[Stop; 2]>> = IdVec::filled(Vec::new(), network.arcs.len());
    for (&[v, w], span) in &region.spans {
        let mut step = [Stop { vertex: v, t: span.from }, Stop { vertex: w, t: span.to }];
        step.sort_by(|a, b| a.t.total_cmp(&b.t));
        let arc = &network.arcs[span.arc];
        if arc.is_loop() {
            let round = (step[0].t / arc.length()).floor() * arc.length();
            step.iter_mut().for_each(|s| s.t -= round);
        }
        steps[span.arc].push(step);
    }
    let chain = |steps: &mut Vec<[Stop; 2]>| {
        steps.sort_by(|a, b| a[0].t.total_cmp(&b[0].t));
        steps.first().map(|s| s[0]).into_iter().chain(steps.iter().map(|s| s[1])).collect()
    };
    steps.iter_mut().map(chain).collect()
}

/// Points along every edge that is on no arc, where the present map has them.
fn via(mesh: &TriMesh, base: &BaseMesh) -> IdVec<EdgeId, Vec<DVec3>> {
    let Domain { topology, region, .. } = &base.domain;
    let along = |e: EdgeId| {
        let [a, b] = topology.ends(e);
        if region.span(a, b).is_some() {
            return Vec::new();
        }
        let h = topology.halfedge(e);
        let [mut from, mut to] = [DVec3::ZERO; 2];
        from[h.corner()] = 1.0;
        to[(h.corner() + 1) % 3] = 1.0;
        let at = |i| base.locate(h.face(), from.lerp(to, i as f64 / SAMPLES as f64)).position(mesh);
        (1..SAMPLES).map(at).collect()
    };
    let edges: Vec<EdgeId> = topology.edge_ids().collect();
    IdVec::from_vec(edges.into_par_iter().map(along).collect())
}
