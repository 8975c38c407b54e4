//! The file of `--map`: the arrays of a map, as docs/map.md lists them.

use crate::arrays::{floats, int64, ints};
use semireg::{Map, Prolongation};
use std::path::Path;

/// Writes a map as npz.
pub(crate) fn write(path: &Path, map: &Map) -> anyhow::Result<()> {
    let mut arrays = vec![
        ints("source_face", 1, &map.source_face),
        floats("source_barycentric", 3, map.source_barycentric.as_flattened()),
        floats("offset", 1, &map.offset),
        int64("result_face", 1, &map.result_face),
        floats("result_barycentric", 3, map.result_barycentric.as_flattened()),
        ints("base_face", 1, &map.base_face),
    ];
    for (i, (parents, faces)) in map.parents.iter().zip(&map.face_parents).enumerate() {
        arrays.push(ints(&format!("parents_{}", i + 1), 2, parents.as_flattened()));
        arrays.push(ints(&format!("face_parents_{}", i + 1), 1, faces));
    }
    for (level, Prolongation { data, indices, indptr, shape }) in map.prolongations.iter().enumerate() {
        let name = |part: &str| format!("prolongation_{level}_{part}");
        arrays.push(floats(&name("data"), 1, data));
        arrays.push(ints(&name("indices"), 1, indices));
        arrays.push(ints(&name("indptr"), 1, indptr));
        arrays.push(ints(&name("shape"), 1, &shape.map(|n| n as u32)));
    }
    Ok(mesh_io::write_arrays(path, &arrays)?)
}
