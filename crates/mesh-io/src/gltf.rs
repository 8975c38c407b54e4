//! glTF 2.0, as JSON and as glb.
//!
//! Containers and JSON by the packages gltf and gltf-json. Accessors are read by our own code with checked bounds: those of gltf
//! (1.4.1) panic on an accessor without elements or with a stride that is too small, and its validation refuses files for faults
//! that are no matter here.

mod accessor;
mod attributes;
mod buffers;
mod looks;
mod packer;
mod primitive;
mod scene;
mod tangents;
mod unread;
mod write;

pub(crate) use looks::GltfLooks;
pub(crate) use write::{write_binary, write_json};

use crate::Labels;
use crate::attributes::Names;
use crate::document::{Builder, Document};
use crate::error::Fault;
use crate::looks::Looks;
use buffers::Buffers;
use gltf_json::{Accessor, Index, Root};
use primitive::surfaces;
use scene::Instance;
use serde_json::Value;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::Path;

/// Extensions without which the geometry cannot be read.
const UNREADABLE: [&str; 4] =
    ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression", "EXT_mesh_gpu_instancing"];

/// Vertices and corners that a scene may have when each mesh is counted as often as it is used: some 2 GB. Without a limit a
/// small file could ask for any amount of memory.
const MAX_UNFOLDED: u64 = 1 << 27;

/// Reads gltf or glb, told apart by their first bytes. Buffers in other files are looked for in `directory`, refused without it.
///
/// Every mesh of the scene is put in place by the transforms of its nodes, once for each use. Points and lines are noted and skipped. Vertices
/// that only our own files have because glTF wants one for each normal are the ones that they are copies of.
pub(crate) fn read(bytes: &[u8], directory: Option<&Path>) -> Result<Document, Fault> {
    let (json, blob) = split(bytes)?;
    let fault = |e: serde_json::Error| Fault::data(format!("gltf: {e}"));
    let root = Root::from_slice(&json).map_err(fault)?;
    // As it is: the typed one drops what it does not know.
    let value: Value = serde_json::from_slice(&json).map_err(fault)?;
    if let Some(name) = root.extensions_required.iter().find(|e| UNREADABLE.contains(&e.as_str())) {
        return Err(Fault::unsupported(format!("the extension {name} is not supported"), "export without it"));
    }
    let mut instances = scene::instances(&root)?;
    check_size(&root, &instances)?;
    let buffers = Buffers::load(&root, blob, directory)?;
    let mut builder = Builder::default();
    unread::note(&root, &instances, &mut builder.extras);
    let mut objects = Names::default();
    for instance in &mut instances {
        instance.object = instance.name.map_or(Labels::NONE, |name| objects.index_of(name.to_owned()));
        let copies = primitive::copies(&value["meshes"][instance.number]);
        primitive::push_mesh(&mut builder, &buffers, instance, &copies)?;
    }
    let names = root.materials.iter().map(|material| material.name.clone().unwrap_or_default());
    builder.attributes.materials.names = names.collect();
    builder.attributes.objects.names = objects.into_names();
    builder.attributes.looks = Looks::Gltf(Box::new(GltfLooks::read(&value, &buffers)));
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

/// Fails when the meshes, each as often as it is used, claim more vertices and corners than we take.
fn check_size(root: &Root, instances: &[Instance<'_>]) -> Result<(), Fault> {
    let claimed = |accessor: &Index<Accessor>| root.get(*accessor).map_or(0, |a| a.count.0);
    let mut total = 0u64;
    for Instance { mesh, .. } in instances {
        let positions: BTreeSet<_> = surfaces(mesh).map(|s| s.positions).collect();
        let indices = surfaces(mesh).filter_map(|s| s.primitive.indices);
        total = positions.iter().copied().chain(indices).map(|a| claimed(&a)).fold(total, u64::saturating_add);
    }
    if total <= MAX_UNFOLDED {
        return Ok(());
    }
    Err(Fault::unsupported(format!("its scene unfolds to {total} vertices and corners"), "export fewer copies of its meshes"))
}
