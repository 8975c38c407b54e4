//! glTF 2.0, as JSON and as glb.
//!
//! Containers and JSON by the packages gltf and gltf-json. Accessors are read by our own code with checked bounds: those of gltf
//! (1.4.1) panic on an accessor without elements or with a stride that is too small, and its validation refuses files for faults
//! that are no matter here.

mod accessor;
mod buffers;
mod scene;
mod unread;
mod write;

pub(crate) use write::{write_binary, write_json};

use crate::document::{Builder, Document, saturating_index, strip_triangles};
use crate::error::Fault;
use buffers::Buffers;
use glam::{DMat4, DVec3};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Mesh, Root};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;

/// Extensions without which the geometry cannot be read.
const UNREADABLE: [&str; 4] =
    ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression", "EXT_mesh_gpu_instancing"];

/// Vertices and corners that a scene may have when each mesh is counted as often as it is used: some 2 GB. Without a limit a
/// small file could ask for any amount of memory.
const MAX_UNFOLDED: u64 = 1 << 27;

/// Reads gltf or glb, told apart by their first bytes. Buffers in other files are looked for in `directory`, refused without it.
///
/// Every mesh of the scene is put in place by the transforms of its nodes, once for each use. Points and lines are noted and skipped.
pub(crate) fn read(bytes: &[u8], directory: Option<&Path>) -> Result<Document, Fault> {
    let (json, blob) = split(bytes)?;
    let root = Root::from_slice(&json).map_err(|e| Fault::data(format!("gltf: {e}")))?;
    if let Some(name) = root.extensions_required.iter().find(|e| UNREADABLE.contains(&e.as_str())) {
        return Err(Fault::unsupported(format!("the extension {name} is not supported"), "export without it"));
    }
    let instances = scene::instances(&root)?;
    check_size(&root, &instances)?;
    let buffers = Buffers::load(&root, blob, directory)?;
    let mut builder = Builder::default();
    unread::note(&root, &instances, &mut builder.extras);
    for (mesh, transform) in instances {
        push_mesh(&mut builder, &buffers, mesh, transform)?;
    }
    builder.finish()
}

type JsonAndBlob<'a> = (Cow<'a, [u8]>, Option<Cow<'a, [u8]>>);

fn split(bytes: &[u8]) -> Result<JsonAndBlob<'_>, Fault> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.into(), None));
    }
    // gltf 1.4.1 subtracts the size of the header (12) from the claimed length without a look.
    let claimed = bytes.get(8..12).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes);
    if claimed < 12 {
        return Err(Fault::data("the glb header is not complete"));
    }
    let glb = gltf::Glb::from_slice(bytes).map_err(|e| Fault::data(format!("glb: {e}")))?;
    Ok((glb.json, glb.bin))
}

/// A primitive that has triangles.
struct Surface<'a> {
    primitive: &'a Primitive,
    mode: Mode,
    positions: Index<Accessor>,
}

/// The primitives of a mesh that have triangles; points, lines and primitives without positions are passed over.
fn surfaces(mesh: &Mesh) -> impl Iterator<Item = Surface<'_>> {
    mesh.primitives.iter().filter_map(|primitive| {
        let positions = *primitive.attributes.get(&Checked::Valid(Semantic::Positions))?;
        match primitive.mode {
            Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => {
                Some(Surface { primitive, mode, positions })
            }
            _ => None,
        }
    })
}

/// Fails when the meshes, each as often as it is used, claim more vertices and corners than we take.
fn check_size(root: &Root, instances: &[(&Mesh, DMat4)]) -> Result<(), Fault> {
    let claimed = |accessor: &Index<Accessor>| root.get(*accessor).map_or(0, |a| a.count.0);
    let mut total = 0u64;
    for (mesh, _) in instances {
        let positions: BTreeSet<_> = surfaces(mesh).map(|s| s.positions).collect();
        let indices = surfaces(mesh).filter_map(|s| s.primitive.indices);
        total = positions.iter().copied().chain(indices).map(|a| claimed(&a)).fold(total, u64::saturating_add);
    }
    if total <= MAX_UNFOLDED {
        return Ok(());
    }
    Err(Fault::unsupported(format!("its scene unfolds to {total} vertices and corners"), "export fewer copies of its meshes"))
}

fn push_mesh(builder: &mut Builder, buffers: &Buffers, mesh: &Mesh, transform: DMat4) -> Result<(), Fault> {
    let is_mirrored = transform.determinant() < 0.0;
    // Primitives (one for each material) that share positions share vertices.
    let mut vertices = BTreeMap::new();
    for Surface { primitive, mode, positions } in surfaces(mesh) {
        let range = match vertices.get(&positions) {
            Some(range) => Range::clone(range),
            None => push_positions(builder, buffers, positions, transform)?,
        };
        let corners = corners(buffers, primitive, range.clone())?;
        vertices.insert(positions, range);
        for [a, b, c] in triangles(mode, &corners)? {
            // Under a transform that mirrors, triangles are turned round (glTF 2.0, section 3.7.4).
            builder.polygon(&if is_mirrored { [a, c, b] } else { [a, b, c] });
        }
    }
    Ok(())
}

/// Appends the positions of an accessor; returns their vertices.
fn push_positions(
    builder: &mut Builder,
    buffers: &Buffers,
    accessor: Index<Accessor>,
    transform: DMat4,
) -> Result<Range<usize>, Fault> {
    let first = builder.n_vertices();
    for p in accessor::numbers::<3>(buffers, accessor)? {
        let p = DVec3::from_array(p);
        // The identity must not touch a bit, not even a negative zero.
        builder.vertex(if transform == DMat4::IDENTITY { p } else { transform.transform_point3(p) });
    }
    Ok(first..builder.n_vertices())
}

/// The corners of a primitive as indices of the document. Those past its own vertices stay out of range.
fn corners(buffers: &Buffers, primitive: &Primitive, vertices: Range<usize>) -> Result<Vec<u32>, Fault> {
    let vertex = |i: usize| if i < vertices.len() { saturating_index((vertices.start + i) as i64) } else { u32::MAX };
    match primitive.indices {
        Some(accessor) => Ok(accessor::numbers::<1>(buffers, accessor)?.iter().map(|[i]| vertex(*i as usize)).collect()),
        None => Ok((0..vertices.len()).map(vertex).collect()),
    }
}

/// The triangles that corners mean in a mode that has triangles.
fn triangles(mode: Mode, corners: &[u32]) -> Result<Vec<[u32; 3]>, Fault> {
    match mode {
        Mode::TriangleStrip => Ok(strip_triangles(corners).collect()),
        Mode::TriangleFan => Ok(corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]).collect()),
        _ => match corners.as_chunks::<3>() {
            (triangles, []) => Ok(triangles.to_vec()),
            _ => Err(Fault::data(format!("gltf: triangles of {} corners, not a multiple of 3", corners.len()))),
        },
    }
}
