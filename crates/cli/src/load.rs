//! Meshes from files, as they are.

use crate::failure::{Failure, Kind};
use crate::stream::Source;
use anyhow::Context as _;
use glam::DVec3;
use mesh_core::{Soup, TriMesh};
use mesh_io::{Extra, Numbers};
use std::path::Path;

/// A mesh that was not cleaned.
pub(crate) struct Raw {
    pub(crate) mesh: TriMesh,
    /// Triangles that no mesh can hold, left out: an index is out of range, or two are the same.
    pub(crate) left_out: usize,
}

/// A mesh without any repair: order and vertices stay.
pub(crate) fn raw(source: &Source) -> anyhow::Result<Raw> {
    let Soup { positions, mut triangles } = source.read()?.soup;
    let read = triangles.len();
    triangles.retain(|&[a, b, c]| a != b && b != c && c != a && [a, b, c].iter().all(|&v| (v as usize) < positions.len()));
    let left_out = read - triangles.len();
    let mesh = TriMesh::new(positions, triangles).with_context(|| source.to_string())?;
    Ok(Raw { mesh, left_out })
}

/// The lines of a file, by the positions of their ends.
pub(crate) fn lines(path: &Path) -> anyhow::Result<Vec<[DVec3; 2]>> {
    let (document, name) = (mesh_io::read(path)?, path.display());
    if document.lines.is_empty() {
        let message = format!("{name} has no lines; give them as `l` of an obj or as the element `edge` of a ply");
        return Err(Failure::new(Kind::Marks, message).into());
    }
    let position = |v: u32| document.soup.positions.get(v as usize).copied();
    let ends = |(i, &[a, b]): (usize, &[u32; 2])| {
        let ends = position(a).zip(position(b)).map(|(a, b)| [a, b]);
        let message = || format!("{name}: line segment {} has an end that is no vertex of the file; correct it", i + 1);
        ends.ok_or_else(|| Failure::new(Kind::Marks, message()).into())
    };
    document.lines.iter().enumerate().map(ends).collect()
}

/// The densities of a file: of its properties at the vertices or its arrays the one of that name, or the only one.
pub(crate) fn density(path: &Path) -> anyhow::Result<Vec<f64>> {
    let mut named: Vec<(String, Vec<f64>)> = match path.extension() {
        Some(extension) if extension == "npy" || extension == "npz" => {
            mesh_io::read_arrays(path)?.into_iter().map(|array| (array.name, floats(array.values))).collect()
        }
        _ => mesh_io::read(path)?.attributes.vertex_values.into_iter().map(|v| (v.name, v.values)).collect(),
    };
    let at = named.iter().position(|(name, _)| name == "density").or((named.len() == 1).then_some(0));
    match at {
        Some(at) => Ok(named.swap_remove(at).1),
        None => {
            let remedy = "give a ply with a property `density` of its vertices, or an npy";
            Err(Failure::new(Kind::Usage, format!("{} has no density; {remedy}", path.display())).into())
        }
    }
}

fn floats(numbers: Numbers) -> Vec<f64> {
    match numbers {
        Numbers::Float(values) => values.into_owned(),
        Numbers::Int(values) => values.iter().map(|&n| n as f64).collect(),
        Numbers::Int32(values) => values.iter().map(|&n| f64::from(n)).collect(),
    }
}

/// A warning of what a file holds that its remeshed surface does not have; none where it has all.
pub(crate) fn lost(extras: &[Extra]) -> Option<String> {
    let lost: Vec<String> = extras.iter().filter(|extra| extra.is_lost()).map(ToString::to_string).collect();
    let (last, others) = lost.split_last()?;
    let is_one = others.is_empty() && last.starts_with("1 ");
    let listed = if others.is_empty() { last.clone() } else { format!("{} and {last}", others.join(", ")) };
    Some(format!("{listed} {} not carried over to the result", if is_one { "is" } else { "are" }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_lost_is_told() {
        assert_eq!(lost(&[Extra::Normals]), None);
        let told = |extras: &[Extra]| lost(extras).unwrap();
        assert_eq!(told(&[Extra::Normals, Extra::Materials(1)]), "1 material is not carried over to the result");
        assert_eq!(
            told(&[Extra::TextureCoordinates, Extra::Colors, Extra::Materials(2)]),
            "texture coordinates, colours and 2 materials are not carried over to the result"
        );
    }
}
