//! The file of `--map`: the arrays of a map, as docs/map.md lists them.

use mesh_io::{Array, Numbers};
use semireg::{Map, Prolongation};
use std::path::Path;

/// Writes a map as npz.
pub(crate) fn write(path: &Path, map: &Map) -> anyhow::Result<()> {
    let mut arrays = Arrays::default();
    arrays.ints("source_face", &map.source_face);
    arrays.floats("source_barycentric", 3, map.source_barycentric.as_flattened());
    arrays.floats("offset", 1, &map.offset);
    arrays.0.push(("result_face".into(), vec![map.result_face.len()], Owned::Int(map.result_face.clone())));
    arrays.floats("result_barycentric", 3, map.result_barycentric.as_flattened());
    arrays.ints("base_face", &map.base_face);
    for (i, (parents, faces)) in map.parents.iter().zip(&map.face_parents).enumerate() {
        arrays.pairs(&format!("parents_{}", i + 1), parents);
        arrays.ints(&format!("face_parents_{}", i + 1), faces);
    }
    for (level, Prolongation { data, indices, indptr, shape }) in map.prolongations.iter().enumerate() {
        let name = |part: &str| format!("prolongation_{level}_{part}");
        arrays.floats(&name("data"), 1, data);
        arrays.ints(&name("indices"), indices);
        arrays.ints(&name("indptr"), indptr);
        arrays.ints(&name("shape"), &shape.map(|n| n as u32));
    }
    Ok(mesh_io::write_arrays(path, &arrays.views())?)
}

/// Arrays under way.
#[derive(Default)]
struct Arrays<'a>(Vec<(String, Vec<usize>, Owned<'a>)>);

enum Owned<'a> {
    Int(Vec<i64>),
    Float(&'a [f64]),
}

impl<'a> Arrays<'a> {
    fn ints(&mut self, name: &str, values: &[u32]) {
        let values: Vec<i64> = values.iter().copied().map(i64::from).collect();
        self.0.push((name.to_owned(), vec![values.len()], Owned::Int(values)));
    }

    fn pairs(&mut self, name: &str, values: &[[u32; 2]]) {
        let numbers = values.as_flattened().iter().copied().map(i64::from).collect();
        self.0.push((name.to_owned(), vec![values.len(), 2], Owned::Int(numbers)));
    }

    /// Rows of so many numbers each; with one, an array of one dimension.
    fn floats(&mut self, name: &str, width: usize, values: &'a [f64]) {
        let shape = if width == 1 { vec![values.len()] } else { vec![values.len() / width, width] };
        self.0.push((name.to_owned(), shape, Owned::Float(values)));
    }

    fn views(&self) -> Vec<Array<'_>> {
        let mut views = Vec::with_capacity(self.0.len());
        for (name, shape, numbers) in &self.0 {
            let values = match numbers {
                Owned::Int(values) => Numbers::Int(values),
                Owned::Float(values) => Numbers::Float(values),
            };
            views.push(Array { name: name.clone(), shape: shape.clone(), values });
        }
        views
    }
}
