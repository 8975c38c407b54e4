//! What materials look like.

use crate::gltf::GltfLooks;

/// What materials look like, as a file says it. It is kept as it is, for a file of the same format.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Looks {
    /// The file does not say.
    #[default]
    Unknown,
    /// Names of the files that describe them (`mtllib` of an obj), as the obj names them.
    Libraries(Vec<String>),
    /// Names of the images that a ply refers to.
    Images(Vec<String>),
    /// Materials, textures and images of a glTF file.
    Gltf(Box<GltfLooks>),
}

impl Looks {
    /// Changes the names of all files that this refers to.
    pub fn rename(&mut self, rename: impl Fn(&str) -> String) {
        match self {
            Self::Unknown => {}
            Self::Libraries(names) | Self::Images(names) => names.iter_mut().for_each(|name| *name = rename(name)),
            Self::Gltf(looks) => looks.rename(rename),
        }
    }
}
