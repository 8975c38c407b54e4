//! The file formats.

use crate::Extra;
use std::path::Path;

/// A mesh file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Wavefront obj, text, f64.
    Obj,
    /// Stanford ply, read as text and binary, written as little endian binary, f64.
    Ply,
    /// Stereolithography, read as text and binary, written as binary, f32 and without shared vertices.
    Stl,
    /// Object file format of Geomview, text, f64.
    Off,
    /// glTF 2.0 as JSON, f32; written with its buffer inside.
    Gltf,
    /// glTF 2.0 as one binary file, f32.
    Glb,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 6] = [Self::Obj, Self::Ply, Self::Stl, Self::Off, Self::Gltf, Self::Glb];

    /// The format that the extension of a path names, in upper or lower case; `None` for another extension or none.
    pub fn from_path(path: &Path) -> Option<Self> {
        Self::from_extension(path.extension()?.to_str()?)
    }

    /// The format with this extension, in upper or lower case and without a dot; `None` for another one.
    pub fn from_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|f| extension.eq_ignore_ascii_case(f.extension()))
    }

    /// Whether a file of this format, once written, has something again that an input had: [`crate::write_with`] takes it from the attributes.
    pub fn holds(self, extra: &Extra) -> bool {
        use Extra::{Colors, Materials, Normals, Parts, Properties, TextureCoordinates, Textures};
        match self {
            Self::Obj => matches!(extra, Normals | TextureCoordinates | Colors | Materials(_) | Parts(_)),
            Self::Ply => {
                matches!(extra, Normals | TextureCoordinates | Colors | Materials(_) | Parts(_) | Textures(_) | Properties(_))
            }
            Self::Gltf | Self::Glb => matches!(extra, Normals | TextureCoordinates | Colors | Materials(_) | Textures(_)),
            Self::Stl | Self::Off => false,
        }
    }

    /// The usual extension, in lower case and without dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Off => "off",
            Self::Gltf => "gltf",
            Self::Glb => "glb",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_decides_in_any_case() {
        for format in Format::ALL {
            for extension in [format.extension().to_owned(), format.extension().to_uppercase()] {
                assert_eq!(Format::from_path(Path::new(&format!("a.b/c.d.{extension}"))), Some(format));
            }
        }
        for path in ["a", "obj", ".obj", "a.obj.gz", "a.", "a.obj/b"] {
            assert_eq!(Format::from_path(Path::new(path)), None, "{path}");
        }
    }
}
