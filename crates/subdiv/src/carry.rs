//! A domain carried over to its base mesh with a few more vertices.

use crate::matching::{Matching, Subdivided, matching};
use crate::{SubdivError, subdivide};
use mesh_core::{FaceId, Id as _, TriMesh, VertexId, walk_end};
use region_map::{ArcSpan, Attachment, Domain, RegionMap, Surface};

/// A domain after edges of its base mesh were bisected.
#[derive(Clone, Debug)]
pub struct Carried {
    /// The finest level on the new base mesh, its vertices at the points of its region map.
    pub domain: Domain,
    /// Its faces at new vertices, in rising order.
    pub new_faces: Vec<FaceId>,
}

/// Carries a domain over to its base mesh with bisected edges: the vertices that were there stay where they are, and every new
/// one is put in the middle of an edge between them.
///
/// `before` is `base_before` subdivided, with its vertices anywhere on the surface. `base_after` is `base_before` after each edge
/// in `bisections` got a new vertex, in this order; the first one has the number after the last vertex of `base_before`.
///
/// `None` where `base_after` is not what the bisections make of the base, or where a new vertex has no neighbour inside its sheet
/// that it could start from. Fails where `before` does not fit the surface, or `base_after` cannot be subdivided as often.
pub fn carried_over(
    surface: &Surface,
    before: &Domain,
    base_before: &TriMesh,
    base_after: &Domain,
    bisections: &[[VertexId; 2]],
) -> Result<Option<Carried>, SubdivError> {
    before.check(surface.network())?;
    let old = Subdivided { base: base_before, finest: &before.mesh };
    let Some(levels) = old.levels() else { return Ok(None) };
    let finest = subdivide(base_after, levels)?.domain;
    let new = Subdivided { base: &base_after.mesh, finest: &finest.mesh };
    let vertex = |i: usize| VertexId::new(base_before.n_vertices() + i);
    let bisections: Vec<_> = bisections.iter().enumerate().map(|(i, &[a, b])| [a, b, vertex(i)]).collect();
    let Some(matching) = matching(old, &bisections, new) else { return Ok(None) };
    let Some(region) = carried_region(surface, &before.region, &finest.region, &matching) else { return Ok(None) };

    let is_new = |&v: &VertexId| matching.numbers[v].index() >= before.mesh.n_vertices();
    let new_faces = finest.mesh.faces().enumerate().filter(|(_, f)| f.iter().any(is_new)).map(|(f, _)| f).collect();
    Ok(Some(Carried { domain: finest.placed(surface, region)?, new_faces }))
}

/// The region map of the new domain. `finest` is its map as subdivided.
fn carried_region(surface: &Surface, before: &RegionMap, finest: &RegionMap, matching: &Matching) -> Option<RegionMap> {
    let mut classes = vec![None; before.points.len() + matching.middles.len()];
    for (v, number) in matching.numbers.enumerate() {
        *classes.get_mut(number.index())? = Some(finest.attachments[v]);
    }
    // The map of all vertices by their numbers: those from before, and then each middle.
    let mut all = before.clone();
    for middle in &matching.middles {
        let m = VertexId::new(all.points.len());
        let [a, b] = middle.ends;
        let (attachment, point) = match classes[m.index()]? {
            Attachment::Sheet(sheet) => {
                let places = middle.ends.into_iter().chain(middle.beside.into_iter().flatten());
                let start = places.into_iter().find(|&v| all.attachments[v] == Attachment::Sheet(sheet))?;
                let position = |v: VertexId| all.points[v].position(surface.mesh());
                let way = position(a).midpoint(position(b)) - position(start);
                let may_cross = |e| !surface.network().is_barrier(e);
                let end = walk_end(surface.mesh(), surface.topology(), all.points[start], way, may_cross);
                (Attachment::Sheet(sheet), end)
            }
            Attachment::Arc { .. } | Attachment::Corner(_) => {
                let span = all.span(a, b)?;
                let (arc, t) = (&surface.network().arcs[span.arc], 0.5 * (span.from + span.to));
                all.insert_span(a, m, ArcSpan { to: t, ..span });
                all.insert_span(m, b, ArcSpan { from: t, ..span });
                let t = arc.normalise(t);
                (Attachment::Arc { arc: span.arc, t }, arc.point(surface.topology(), t))
            }
        };
        all.attachments.push(attachment);
        all.points.push(point);
    }
    let number = |v: VertexId| matching.numbers[v];
    let mut region = RegionMap {
        attachments: finest.vertices().map(|v| all.attachments[number(v)]).collect(),
        points: finest.vertices().map(|v| all.points[number(v)]).collect(),
        sheet_of_face: finest.sheet_of_face.clone(),
        spans: Default::default(),
    };
    for &[a, b] in finest.spans.keys() {
        region.insert_span(a, b, all.span(number(a), number(b))?);
    }
    Some(region)
}
