//! The triangles of a glTF mesh.

use super::accessor;
use super::attributes;
use super::buffers::Buffers;
use super::scene::Instance;
use crate::document::{Builder, fan, strip_triangles};
use crate::error::Fault;
use glam::{DMat4, DVec3};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Mesh};
use serde_json::Value;
use std::collections::btree_map::{BTreeMap, Entry};

/// A primitive that has triangles.
pub(super) struct Surface<'a> {
    pub(super) primitive: &'a Primitive,
    pub(super) mode: Mode,
    pub(super) positions: Index<Accessor>,
}

/// The primitives of a mesh that have triangles; points, lines and primitives without positions are passed over.
pub(super) fn surfaces(mesh: &Mesh) -> impl Iterator<Item = Surface<'_>> {
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

/// Which vertices of a mesh that we wrote are copies, from the last ones back: the name that the writer gives them.
pub(super) const COPIES: &str = "copy_of";
/// The member of `extras` that is ours.
pub(super) const OURS: &str = "semireg";

/// The vertices that the last ones of a mesh are copies of. Empty for a mesh of another program.
pub(super) fn copies(mesh: &Value) -> Vec<usize> {
    let list = mesh["extras"][OURS][COPIES].as_array();
    list.map(|list| list.iter().map(|v| v.as_u64().unwrap_or(u64::MAX) as usize).collect()).unwrap_or_default()
}

/// Appends a mesh of the scene.
pub(super) fn push_mesh(builder: &mut Builder, buffers: &Buffers, instance: &Instance, copies: &[usize]) -> Result<(), Fault> {
    let is_mirrored = instance.transform.determinant() < 0.0;
    // Primitives (one for each material) that share positions share vertices.
    let mut vertices = BTreeMap::new();
    for Surface { primitive, mode, positions } in surfaces(instance.mesh) {
        let vertices = match vertices.entry(positions) {
            Entry::Occupied(there) => there.into_mut(),
            Entry::Vacant(place) => place.insert(push_positions(builder, buffers, positions, instance.transform, copies)?),
        };
        let first = builder.n_triangles();
        let corners = corners(buffers, primitive, vertices.len())?;
        // Under a transform that mirrors, triangles are turned round (glTF 2.0, section 3.7.4).
        let turn = |[a, b, c]: [usize; 3]| if is_mirrored { [a, c, b] } else { [a, b, c] };
        let triangles: Vec<[usize; 3]> = triangles(mode, &corners)?.into_iter().map(turn).collect();
        for triangle in &triangles {
            builder.polygon(&triangle.map(|i| vertices.get(i).copied().unwrap_or(u32::MAX)));
        }
        attributes::push(builder, buffers, instance, primitive, attributes::Place { vertices, triangles: &triangles, first });
    }
    Ok(())
}

/// Appends the positions of an accessor, those of copies left out; returns the vertex of the document for each.
fn push_positions(
    builder: &mut Builder,
    buffers: &Buffers,
    accessor: Index<Accessor>,
    transform: DMat4,
    copies: &[usize],
) -> Result<Vec<u32>, Fault> {
    let first = builder.n_vertices() as u32;
    let positions = accessor::numbers::<3>(buffers, accessor)?;
    let copies = if are_copies(&positions, copies) { copies } else { &[] };
    let originals = positions.len() - copies.len();
    for p in &positions[..originals] {
        let p = DVec3::from_array(*p);
        // The identity must not touch a bit, not even a negative zero.
        builder.vertex(if transform == DMat4::IDENTITY { p } else { transform.transform_point3(p) });
    }
    Ok((0..originals as u32).chain(copies.iter().map(|&v| v as u32)).map(|v| first + v).collect())
}

/// Whether the last vertices are where those are that they are said to be copies of: another program may have changed their order.
fn are_copies(positions: &[[f64; 3]], copies: &[usize]) -> bool {
    let Some(originals) = positions.len().checked_sub(copies.len()) else { return false };
    positions[originals..].iter().zip(copies).all(|(p, &v)| v < originals && *p == positions[v])
}

/// The corners of a primitive as indices of its vertices. Those past them stay out of range.
fn corners(buffers: &Buffers, primitive: &Primitive, n_vertices: usize) -> Result<Vec<usize>, Fault> {
    match primitive.indices {
        Some(accessor) => Ok(accessor::numbers::<1>(buffers, accessor)?.iter().map(|[i]| *i as usize).collect()),
        None => Ok((0..n_vertices).collect()),
    }
}

/// The triangles that corners mean in a mode that has triangles.
fn triangles(mode: Mode, corners: &[usize]) -> Result<Vec<[usize; 3]>, Fault> {
    match mode {
        Mode::TriangleStrip => Ok(strip_triangles(corners).collect()),
        Mode::TriangleFan => Ok(fan(corners).collect()),
        _ => match corners.as_chunks::<3>() {
            (triangles, []) => Ok(triangles.to_vec()),
            _ => Err(Fault::data(format!("gltf: triangles of {} corners, not a multiple of 3", corners.len()))),
        },
    }
}
