//! Writing glTF.
//!
//! Nodes and meshes begin with the finest level, so that what reads only the first mesh has it.

use super::attributes::{single_normal, single_uv};
use super::looks::{EXTENSION_LISTS, GltfLooks};
use super::packer::{Packer, TARGET_VERTICES};
use super::primitive::{COPIES, OURS};
use super::tangents::{Tangents, tangents};
use crate::attributes::Attributes;
use crate::base64;
use crate::corners::{Corner, Distinct};
use crate::error::WriteError;
use crate::looks::Looks;
use crate::single_precision::single_precision;
use crate::{Labels, Level};
use gltf::binary::{Glb, Header};
use mesh_core::TriMesh;
use serde_json::{Map, Value, json};

/// The levels of a mesh, the coarsest first, as JSON with the buffer in a data URI.
pub(crate) fn write_json(levels: &[Level]) -> Result<Vec<u8>, WriteError> {
    let (mut root, buffer) = document(levels)?;
    if !buffer.is_empty() {
        let uri = format!("data:application/octet-stream;base64,{}", base64::encode(&buffer));
        root["buffers"][0]["uri"] = uri.into();
    }
    Ok(root.to_string().into_bytes())
}

/// The levels of a mesh, the coarsest first, as glb.
pub(crate) fn write_binary(levels: &[Level]) -> Result<Vec<u8>, WriteError> {
    let too_large = || WriteError::TooLarge { format: "glb" };
    let (root, buffer) = document(levels)?;
    let json = root.to_string();
    // Headers and padding need less than 100 bytes.
    u32::try_from(json.len() + buffer.len() + 100).map_err(|_| too_large())?;
    // The package works the length out by itself.
    let header = Header { magic: *b"glTF", version: 2, length: 0 };
    let bin = if buffer.is_empty() { None } else { Some(buffer.into()) };
    Glb { header, json: json.into_bytes().into(), bin }.to_vec().map_err(|_| too_large())
}

/// The document and its buffer. A mesh without faces gives an empty scene: glTF has no empty accessors.
fn document(levels: &[Level]) -> Result<(Value, Vec<u8>), WriteError> {
    let finest = finest(levels)?;
    let asset = json!({ "version": "2.0", "generator": "semireg" });
    if finest.mesh.n_faces() == 0 {
        return Ok((json!({ "asset": asset }), Vec::new()));
    }
    let mut packer = Packer::default();
    let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
    for (i, level) in levels.iter().rev().enumerate() {
        meshes.push(surface(&mut packer, level)?);
        nodes.push(json!({ "mesh": i }));
    }
    let mut of_scene = vec![0];
    let lines = finest.settings.lines;
    if !lines.is_empty() {
        let indices = packer.indices(lines.iter().flatten().copied(), finest.mesh.n_vertices());
        let lines = json!({ "attributes": { "POSITION": meshes[0]["primitives"][0]["attributes"]["POSITION"] }, "indices": indices, "mode": 1 });
        of_scene.push(nodes.len());
        nodes.push(json!({ "mesh": meshes.len(), "name": "feature curves" }));
        meshes.push(json!({ "name": "feature curves", "primitives": [lines] }));
    }
    let mut root = json!({ "asset": asset, "scene": 0, "scenes": [{ "nodes": of_scene }], "nodes": nodes, "meshes": meshes });
    name_levels(&mut root, levels.len());
    add_materials(&mut root, &mut packer, finest.settings.attributes);
    packer.end(&mut root);
    Ok((root, packer.bytes))
}

/// The last level. Fails without one, and where the vertices of a level are not the first ones of it.
fn finest<'a>(levels: &'a [Level]) -> Result<&'a Level<'a>, WriteError> {
    let Some(finest) = levels.last() else { return Err(WriteError::NoLevel { level: 0 }) };
    let is_prefix = |mesh: &TriMesh| finest.mesh.positions().as_slice().starts_with(mesh.positions().as_slice());
    let is_wrong = |level: &Level| !is_prefix(level.mesh) || (levels.len() > 1 && level.mesh.n_faces() == 0);
    levels.iter().position(is_wrong).map_or(Ok(finest), |level| Err(WriteError::NoLevel { level }))
}

/// The mesh of a level.
fn surface(packer: &mut Packer, Level { mesh, settings }: &Level) -> Result<Value, WriteError> {
    let tangents = tangents(mesh, settings.attributes);
    let vertices = Vertices::new(mesh, settings.attributes, tangents.as_ref());
    let mut of_vertices = vertex_accessors(packer, mesh, settings.attributes, &vertices)?;
    if let Some(tangents) = tangents {
        let tangents = vertices.by_corners(|(f, c)| tangents[f][c], || [1.0, 0.0, 0.0, 1.0]);
        of_vertices.insert("TANGENT".to_owned(), packer.floats(&tangents, TARGET_VERTICES).into());
    }
    let mut surface = json!({ "primitives": primitives(packer, settings.attributes, &vertices, &of_vertices) });
    if !vertices.copies.is_empty() {
        surface["extras"] = json!({ OURS: { COPIES: vertices.copies } });
    }
    Ok(surface)
}

/// Several levels have names, and the node of the finest one names the others as its levels of detail.
fn name_levels(root: &mut Value, n: usize) {
    if n < 2 {
        return;
    }
    for i in 0..n {
        let name = Value::from(format!("level {}", n - 1 - i));
        root["nodes"][i]["name"] = name.clone();
        root["meshes"][i]["name"] = name;
    }
    root["nodes"][0]["extensions"] = json!({ LEVELS: { "ids": (1..n).collect::<Vec<_>>() } });
    root["extensionsUsed"] = json!([LEVELS]);
}

/// The extension that names coarser levels of a node.
const LEVELS: &str = "MSFT_lod";

/// The vertices of the file: those of the mesh, then copies of those that have several normals, texture coordinates or tangents.
struct Vertices {
    /// Those of each triangle.
    triangles: Vec<[u32; 3]>,
    /// The corner that each vertex has its attributes from; `None` for a vertex without faces.
    corners: Vec<Option<Corner>>,
    /// The vertices of the mesh that the last ones are copies of.
    copies: Vec<u32>,
}

impl Vertices {
    fn new(mesh: &TriMesh, attributes: &Attributes, tangents: Option<&Tangents>) -> Self {
        let normal = |(f, c): Corner| attributes.normals.get(f).map(|t| t[c].as_vec3().to_array().map(f32::to_bits));
        let same_uv = |a: Corner, b: Corner| {
            let bits = |layer: &Vec<[glam::DVec2; 3]>, (f, c): Corner| layer[f][c].as_vec2().to_array().map(f32::to_bits);
            attributes.uvs.iter().all(|layer| bits(layer, a) == bits(layer, b))
        };
        let tangent = |(f, c): Corner| tangents.map(|of| of[f][c].map(f32::to_bits));
        let distinct = Distinct::new(mesh, |a, b| normal(a) == normal(b) && same_uv(a, b) && tangent(a) == tangent(b));
        let n = mesh.n_vertices();
        let (mut corners, mut copies) = (vec![None; n], Vec::new());
        let mut place = |i: usize| {
            let corner = distinct.first[i];
            let vertex = mesh.faces().as_slice()[corner.0][corner.1].0;
            if distinct.leads[i] {
                corners[vertex as usize] = Some(corner);
                return vertex;
            }
            corners.push(Some(corner));
            copies.push(vertex);
            (corners.len() - 1) as u32
        };
        let places: Vec<u32> = (0..distinct.len()).map(&mut place).collect();
        let triangles = distinct.of_corner.iter().map(|t| t.map(|i| places[i as usize])).collect();
        Self { triangles, corners, copies }
    }

    fn len(&self) -> usize {
        self.corners.len()
    }

    /// What the vertices have from their corners; `without` for one without faces.
    fn by_corners<T>(&self, value: impl Fn(Corner) -> T, without: impl Fn() -> T) -> Vec<T> {
        self.corners.iter().map(|corner| corner.map_or_else(&without, &value)).collect()
    }

    /// What the vertices have from those of the mesh.
    fn by_vertices<T: Copy>(&self, values: &[T]) -> Vec<T> {
        values.iter().copied().chain(self.copies.iter().map(|&v| values[v as usize])).collect()
    }
}

/// Packs everything that vertices have; returns the accessors by name.
fn vertex_accessors(
    packer: &mut Packer,
    mesh: &TriMesh,
    attributes: &Attributes,
    vertices: &Vertices,
) -> Result<Map<String, Value>, WriteError> {
    let mut names = Map::new();
    let positions = vertices.by_vertices(&single_precision(mesh)?);
    let accessor = packer.floats(&positions, TARGET_VERTICES);
    packer.bound(accessor, &positions);
    names.insert("POSITION".to_owned(), accessor.into());
    if !attributes.normals.is_empty() {
        let normals = vertices.by_corners(|(f, c)| single_normal(attributes.normals[f][c]), || [0.0, 0.0, 1.0]);
        names.insert("NORMAL".to_owned(), packer.floats(&normals, TARGET_VERTICES).into());
    }
    for (i, layer) in attributes.uvs.iter().enumerate() {
        let uvs = vertices.by_corners(|(f, c)| single_uv(layer[f][c]), || [0.0; 2]);
        names.insert(format!("TEXCOORD_{i}"), packer.floats(&uvs, TARGET_VERTICES).into());
    }
    if !attributes.colors.is_empty() {
        let single: Vec<[f32; 4]> = attributes.colors.iter().map(|c| c.map(|x| x.clamp(0.0, 1.0) as f32)).collect();
        names.insert("COLOR_0".to_owned(), packer.floats(&vertices.by_vertices(&single), TARGET_VERTICES).into());
    }
    for values in &attributes.vertex_values {
        let single: Vec<[f32; 1]> = values.values.iter().map(|&x| [x as f32]).collect();
        if single.iter().all(|x| x[0].is_finite()) {
            let accessor = packer.floats(&vertices.by_vertices(&single), TARGET_VERTICES);
            names.insert(format!("_{}", values.name.to_uppercase()), accessor.into());
        }
    }
    Ok(names)
}

/// One primitive for each run of triangles of the same material, so that the triangles keep their order.
fn primitives(packer: &mut Packer, attributes: &Attributes, vertices: &Vertices, names: &Map<String, Value>) -> Vec<Value> {
    let indices = packer.index_view(vertices.triangles.iter().flatten().copied(), vertices.len());
    let n = vertices.triangles.len();
    let material = |f: usize| attributes.materials.of_face.get(f).copied().unwrap_or(Labels::NONE);
    let (mut primitives, mut start) = (Vec::new(), 0);
    for end in (1..=n).filter(|&end| end == n || material(end) != material(end - 1)) {
        let mut primitive = json!({ "attributes": names, "indices": packer.some_indices(indices, 3 * start..3 * end) });
        if material(start) != Labels::NONE {
            primitive["material"] = material(start).into();
        }
        primitives.push(primitive);
        start = end;
    }
    primitives
}

/// Adds what the materials look like, or their names alone.
fn add_materials(root: &mut Value, packer: &mut Packer, attributes: &Attributes) {
    match &attributes.looks {
        Looks::Gltf(looks) => looks.write(root, packer),
        _ if !attributes.materials.is_empty() => {
            let names = attributes.materials.names.iter().map(|name| json!({ "name": name }));
            root["materials"] = names.collect();
        }
        _ => {}
    }
}

impl GltfLooks {
    fn write(&self, root: &mut Value, packer: &mut Packer) {
        for (name, array) in &self.arrays {
            root[name] = array.clone();
        }
        let image = |image: &super::looks::Image| {
            let mut json = image.json.clone();
            if let Some(bytes) = &image.bytes {
                json.insert("bufferView".to_owned(), packer.view(bytes.iter().copied(), None).into());
            }
            Value::Object(json)
        };
        let images: Vec<Value> = self.images.iter().map(image).collect();
        if !images.is_empty() {
            root["images"] = images.into();
        }
        for (list, names) in EXTENSION_LISTS.iter().zip(&self.extensions) {
            // Ours may be there already.
            let there = root[*list].as_array().cloned().unwrap_or_default();
            let all: Vec<Value> = there.into_iter().chain(names.iter().cloned().map(Value::from)).collect();
            if !all.is_empty() {
                root[*list] = all.into();
            }
        }
    }
}
