//! From what a file holds to an oriented manifold, with a report of every repair.
//!
//! The order of the steps matters and is that of [`clean`]: merge vertices, drop what is no triangle, close cracks, settle repeated
//! triangles and needles, orient, cut what is not manifold into leaves, mend triangles without area. The point set of the surface stays
//! what it was: only triangles without area and folded flaps go, only vertices at cracks move, by rounding; everything else is
//! renumbered, turned or cut apart in place.

mod cracks;
mod edges;
mod editable_mesh;
mod mend;
mod needles;
mod orient;
mod pairing;
mod provenance;
mod repeats;
mod report;
mod split;
mod t_vertices;
mod weld;

use crate::limits::{MOST_FACES, MOST_VERTICES};
use crate::{FaceId, IdVec, Interrupt, MeshError, Soup, Topology, TopologyError, TriMesh, VertexId};
use editable_mesh::EditableMesh;

pub use report::{CleanOptions, CleanReport};

pub(crate) use edges::edge_groups;
pub(crate) use weld::{is_usable, merge_equal};

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
    /// For every triangle of the soup the (first) face that it is or that lies in it; `None` where a repair took it away.
    pub face_of: Vec<Option<FaceId>>,
    /// For every vertex of the soup the vertex that it is or was merged into; `None` where no face is left that uses it. Of several copies,
    /// made where leaves meet, it is one of a face that lies in a triangle of this vertex.
    pub vertex_of: Vec<Option<VertexId>>,
    /// What was repaired.
    pub report: CleanReport,
}

/// The most triangles that can be cleaned.
const MOST_TRIANGLES: usize = MOST_FACES / 4;

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
    /// There are more vertices or triangles than cleaning can number: a split may make four of one triangle.
    #[error(
        "{vertices} vertices and {triangles} triangles are more than can be cleaned ({MOST_VERTICES} and {MOST_TRIANGLES}); simplify the mesh"
    )]
    TooLarge {
        /// Vertices read.
        vertices: usize,
        /// Triangles read.
        triangles: usize,
    },
    /// The caller has ended it ([`clean_until`]).
    #[error("cleaning was interrupted")]
    Interrupted,
    /// A fault of this program: the repaired faces are not a mesh.
    #[error("cleaning left a broken mesh, please report this: {0}")]
    BrokenMesh(#[from] MeshError),
    /// A fault of this program: the repaired faces are not an oriented manifold.
    #[error("cleaning left a mesh that is not manifold, please report this: {0}")]
    BrokenTopology(#[from] TopologyError),
}

/// Makes an oriented manifold of a soup. Keeps the order of vertices and faces; a clean mesh comes back as it was.
pub fn clean(soup: &Soup, options: &CleanOptions) -> Result<Cleaned, CleanError> {
    clean_until(soup, options, &Interrupt::default())
}

/// The same, which fails with [`CleanError::Interrupted`] soon after `interrupt` is set.
pub fn clean_until(soup: &Soup, options: &CleanOptions, interrupt: &Interrupt) -> Result<Cleaned, CleanError> {
    let (vertices, triangles) = (soup.positions.len(), soup.triangles.len());
    if vertices > MOST_VERTICES || triangles > MOST_TRIANGLES {
        return Err(CleanError::TooLarge { vertices, triangles });
    }
    let go_on = || if interrupt.is_set() { Err(CleanError::Interrupted) } else { Ok(()) };
    let mut report = CleanReport::default();
    let mut mesh = weld::weld(soup, &mut report);
    go_on()?;
    cracks::close_cracks(&mut mesh, options, &mut report);
    go_on()?;
    t_vertices::close_t_vertices(&mut mesh, options, &mut report);
    go_on()?;
    repeats::drop_second_layers(&mut mesh, &mut report);
    go_on()?;
    needles::drop_hanging(&mut mesh, &mut report);
    go_on()?;
    repeats::drop_flaps(&mut mesh, &mut report);
    go_on()?;
    repeats::drop_same_way(&mut mesh, &mut report);
    let pairing = loop {
        go_on()?;
        orient::orient(&mut mesh);
        go_on()?;
        let pairing = pairing::pair(&mesh);
        go_on()?;
        if !repeats::drop_double_sheets(&mut mesh, &pairing.twins, &mut report) {
            break pairing;
        }
    };
    report.non_manifold_edges = pairing.non_manifold_edges;
    report.orientation_cuts = pairing.orientation_cuts;
    report.leaf_cuts = pairing.leaf_cuts;
    report.split_edges = split::split(&mut mesh, &pairing.twins);
    go_on()?;
    if mend::mend_zero_area(&mut mesh, &mut report) {
        let pairing = pairing::pair(&mesh);
        report.split_edges += split::split(&mut mesh, &pairing.twins);
    }
    go_on()?;
    finish(mesh, soup, report)
}

fn finish(edited: EditableMesh, soup: &Soup, mut report: CleanReport) -> Result<Cleaned, CleanError> {
    let edited = edited.without_unused_vertices();
    if edited.faces.is_empty() {
        return Err(CleanError::NothingLeft {
            triangles: soup.triangles.len(),
            bad_index: report.bad_index,
            not_finite: report.not_finite,
            without_area: report.collapsed + report.zero_area_dropped,
        });
    }
    let stayed = provenance::stayed(&edited, soup);
    let mut sources: Vec<u32> = edited.source_vertex.enumerate().filter(|&(v, _)| stayed[v]).map(|(_, &source)| source).collect();
    let in_place = sources.len();
    sources.sort_unstable();
    sources.dedup();
    let kept = sources.len();
    report.vertex_copies = in_place - kept;
    report.unused_vertices = soup.positions.len() - report.merged_exactly - report.merged_by_tolerance - kept;
    report.turned = edited.turned.iter().filter(|&&t| t).count();
    let face_of = provenance::face_of(&edited, soup);
    let vertex_of = provenance::vertex_of(&edited, soup, &stayed);
    let faces = edited.faces.iter().map(|f| f.map(|v| v.0)).collect();
    let mesh = TriMesh::new(edited.positions.into_vec(), faces)?;
    let topology = Topology::new(mesh.faces(), mesh.n_vertices())?;
    let EditableMesh { source_face, source_vertex, .. } = edited;
    Ok(Cleaned { mesh, topology, source_face, source_vertex, face_of, vertex_of, report })
}
