//! From what a file holds to an oriented manifold, with a report of every repair.
//!
//! The order of the steps matters and is that of [`clean`]: merge vertices, drop what is no triangle, close cracks, settle repeated
//! triangles and needles, orient, cut what is not manifold into leaves, mend triangles without area. The point set of the surface stays
//! what it was: only triangles without area and folded flaps go, only vertices at cracks move, by rounding; everything else is
//! renumbered, turned or cut apart in place.

mod cracks;
mod draft;
mod edges;
mod mend;
mod needles;
mod orient;
mod pairing;
mod repeats;
mod split;
mod weld;

use crate::{FaceId, IdVec, MeshError, Soup, Topology, TopologyError, TriMesh, VertexId};
use draft::Draft;

pub(crate) use edges::edge_groups;
pub(crate) use weld::{is_usable, merge_equal};

/// What to repair beyond what must be.
#[derive(Clone, Debug, PartialEq)]
pub struct CleanOptions {
    /// Vertices on a border that are at most this far apart are merged, as a share of the diagonal of the box; from 0 to about 1e-3.
    /// Default 1e-6, some rounding of the single precision that files have. With 0 only vertices at exactly the same position are.
    ///
    /// Of 200 models from the net 8 have cracks that 1e-7 closes; remeshed with them, each side of a crack goes its own way.
    pub weld_tolerance: f64,
}

impl Default for CleanOptions {
    fn default() -> Self {
        Self { weld_tolerance: 1e-6 }
    }
}

/// How often each repair was made. All 0 for a mesh that was clean.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CleanReport {
    /// Triangles dropped: a vertex index is out of range.
    pub bad_index: usize,
    /// Triangles dropped: a coordinate is infinite, not a number, or larger than 1e75.
    pub not_finite: usize,
    /// Vertices merged into another one at exactly the same position.
    pub merged_exactly: usize,
    /// Vertices on a border merged into another one there within the tolerance.
    pub merged_by_tolerance: usize,
    /// Triangles dropped: two corners are the same vertex, after merging.
    pub collapsed: usize,
    /// Triangles dropped: two that lie on each other, joined along an edge of their own: a fold that closes without them.
    pub flaps: usize,
    /// Triangles dropped: another one has the same three vertices. Two that face opposite ways both stay where each belongs to
    /// a part of its own, such as the common wall of two solids; of a double sheet one side stays.
    pub repeated: usize,
    /// Triangles turned over, to face the same way as their neighbours.
    pub turned: usize,
    /// Edges cut because the surface has one side only, like a Moebius strip.
    pub orientation_cuts: usize,
    /// Edges where more than two triangles meet, before the cut into leaves.
    pub non_manifold_edges: usize,
    /// Of these, edges where a leaf ends: it has no other one to go on into.
    pub leaf_cuts: usize,
    /// Edges split in their middle, because another edge has the same two ends.
    pub split_edges: usize,
    /// Copies of vertices made where leaves meet, bit for bit at the same position.
    pub vertex_copies: usize,
    /// Triangles without area mended by flipping their longest edge.
    pub zero_area_flipped: usize,
    /// Triangles without area dropped: they are at a border, or in a part without any area, or hang on an edge as needles (at most a
    /// millionth as high as long).
    pub zero_area_dropped: usize,
    /// Triangles without area dropped though that opens the surface, along a line and by no width: no flip mends them.
    pub zero_area_opened: usize,
    /// Vertices dropped: no triangle uses them.
    pub unused_vertices: usize,
}

/// A mesh ready for work, and where it came from.
#[derive(Clone, Debug)]
pub struct Cleaned {
    /// The mesh.
    pub mesh: TriMesh,
    /// Its connectivity.
    pub topology: Topology,
    /// For every face the triangle of the soup that it is or, after a flip, lies in.
    pub source_face: IdVec<FaceId, u32>,
    /// For every vertex the (first) vertex of the soup that it is; for one in the middle of a split edge, an end of this edge.
    pub source_vertex: IdVec<VertexId, u32>,
    /// What was repaired.
    pub report: CleanReport,
}

/// Why there is nothing to work on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CleanError {
    /// No triangle is left.
    #[error(
        "no face is left: the file has {triangles} triangles, {bad_index} with a vertex index out of range, {not_finite} with \
         a coordinate that is not finite, {without_area} without area; export the mesh again"
    )]
    NothingLeft {
        /// Triangles read.
        triangles: usize,
        /// Of these with an index out of range.
        bad_index: usize,
        /// Of these with a coordinate that is not finite.
        not_finite: usize,
        /// Of these without area.
        without_area: usize,
    },
    /// A fault of this program: the repaired faces are not a mesh.
    #[error("cleaning left a broken mesh, please report this: {0}")]
    BrokenMesh(#[from] MeshError),
    /// A fault of this program: the repaired faces are not an oriented manifold.
    #[error("cleaning left a mesh that is not manifold, please report this: {0}")]
    BrokenTopology(#[from] TopologyError),
}

/// Makes an oriented manifold of a soup. Keeps the order of vertices and faces; a clean mesh comes back as it was.
pub fn clean(soup: &Soup, options: &CleanOptions) -> Result<Cleaned, CleanError> {
    let mut report = CleanReport::default();
    let mut draft = weld::weld(soup, &mut report);
    cracks::close_cracks(&mut draft, options, &mut report);
    repeats::drop_second_layers(&mut draft, &mut report);
    needles::drop_hanging(&mut draft, &mut report);
    repeats::drop_flaps(&mut draft, &mut report);
    repeats::drop_same_way(&mut draft, &mut report);
    let pairing = loop {
        orient::orient(&mut draft);
        let pairing = pairing::pair(&draft);
        if !repeats::drop_double_sheets(&mut draft, &pairing.twins, &mut report) {
            break pairing;
        }
    };
    report.non_manifold_edges = pairing.non_manifold_edges;
    report.orientation_cuts = pairing.orientation_cuts;
    report.leaf_cuts = pairing.leaf_cuts;
    report.split_edges = split::split(&mut draft, &pairing.twins);
    if mend::mend_zero_area(&mut draft, &mut report) {
        let pairing = pairing::pair(&draft);
        report.split_edges += split::split(&mut draft, &pairing.twins);
    }
    finish(draft, soup, report)
}

fn finish(draft: Draft, soup: &Soup, mut report: CleanReport) -> Result<Cleaned, CleanError> {
    let draft = draft.without_unused_vertices();
    if draft.faces.is_empty() {
        return Err(CleanError::NothingLeft {
            triangles: soup.triangles.len(),
            bad_index: report.bad_index,
            not_finite: report.not_finite,
            without_area: report.collapsed + report.zero_area_dropped,
        });
    }
    // Vertices in the middle of split edges are none of the soup's.
    let stayed = |&(v, &source): &(VertexId, &u32)| draft.positions[v] == soup.positions[source as usize];
    let mut sources: Vec<u32> = draft.source_vertex.enumerate().filter(stayed).map(|(_, &source)| source).collect();
    let in_place = sources.len();
    sources.sort_unstable();
    sources.dedup();
    let kept = sources.len();
    report.vertex_copies = in_place - kept;
    report.unused_vertices = soup.positions.len() - report.merged_exactly - report.merged_by_tolerance - kept;
    report.turned = draft.turned.iter().filter(|&&t| t).count();
    let faces = draft.faces.iter().map(|f| f.map(|v| v.0)).collect();
    let mesh = TriMesh::new(draft.positions.into_vec(), faces)?;
    let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
    Ok(Cleaned { mesh, topology, source_face: draft.source_face, source_vertex: draft.source_vertex, report })
}
