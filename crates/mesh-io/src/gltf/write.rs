//! Writing glTF.

use crate::base64;
use crate::error::WriteError;
use crate::single_precision::single_precision;
use gltf::binary::{Glb, Header};
use mesh_core::TriMesh;

/// The mesh as JSON with its buffer in a data URI.
pub(crate) fn write_json(mesh: &TriMesh) -> Result<Vec<u8>, WriteError> {
    let buffer = buffer(mesh)?;
    let uri = format!("\"uri\":\"data:application/octet-stream;base64,{}\",", base64::encode(&buffer));
    Ok(json(mesh, &buffer, &uri)?.into_bytes())
}

/// The mesh as glb.
pub(crate) fn write_binary(mesh: &TriMesh) -> Result<Vec<u8>, WriteError> {
    let too_large = || WriteError::TooLarge { format: "glb" };
    let buffer = buffer(mesh)?;
    let json = json(mesh, &buffer, "")?;
    // Headers and padding need less than 100 bytes.
    u32::try_from(json.len() + buffer.len() + 100).map_err(|_| too_large())?;
    // The package works the length out by itself.
    let header = Header { magic: *b"glTF", version: 2, length: 0 };
    let bin = if buffer.is_empty() { None } else { Some(buffer.into()) };
    Glb { header, json: json.into_bytes().into(), bin }.to_vec().map_err(|_| too_large())
}

/// Positions, then indices.
fn buffer(mesh: &TriMesh) -> Result<Vec<u8>, WriteError> {
    if mesh.n_faces() == 0 {
        return Ok(Vec::new());
    }
    let mut buffer: Vec<u8> = single_precision(mesh)?.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    buffer.extend(mesh.faces().iter().flatten().flat_map(|v| v.0.to_le_bytes()));
    Ok(buffer)
}

/// The document. `uri` is the member that names the buffer, with a comma, or empty. A mesh without faces gives an empty scene:
/// glTF has no empty accessors.
fn json(mesh: &TriMesh, buffer: &[u8], uri: &str) -> Result<String, WriteError> {
    let asset = r#""asset":{"version":"2.0","generator":"semireg"}"#;
    if buffer.is_empty() {
        return Ok(format!("{{{asset}}}"));
    }
    let positions = single_precision(mesh)?;
    let bound = |pick: fn(f32, f32) -> f32| {
        let [x, y, z] = positions.iter().copied().reduce(|a, b| [0, 1, 2].map(|i| pick(a[i], b[i]))).unwrap_or_default();
        format!("[{x:?},{y:?},{z:?}]")
    };
    let (n_vertices, n_indices) = (mesh.n_vertices(), 3 * mesh.n_faces());
    let (position_bytes, index_bytes) = (12 * n_vertices, 4 * n_indices);
    let accessors = format!(
        concat!(
            r#""accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":{},"max":{}}},"#,
            r#"{{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}]"#
        ),
        n_vertices,
        bound(f32::min),
        bound(f32::max),
        n_indices
    );
    let views = format!(
        concat!(
            r#""bufferViews":[{{"buffer":0,"byteLength":{0},"target":34962}},"#,
            r#"{{"buffer":0,"byteOffset":{0},"byteLength":{1},"target":34963}}]"#
        ),
        position_bytes, index_bytes
    );
    let scene = concat!(
        r#""scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"#,
        r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]"#
    );
    let buffers = format!(r#""buffers":[{{{uri}"byteLength":{}}}]"#, buffer.len());
    Ok(format!("{{{asset},{scene},{accessors},{views},{buffers}}}"))
}
