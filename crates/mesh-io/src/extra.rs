//! What a file holds beside its triangles.

use std::collections::BTreeSet;
use std::fmt::{self, Display, Formatter};

/// Something that a file holds beside positions and polygons. A reader notes that it is there, whether it is read
/// ([`Attributes`](crate::Attributes)) or not.
///
/// As text it is a part of a list: "texture coordinates", "3 materials".
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Extra {
    /// Normals or tangents; any surface has normals that can be computed again.
    Normals,
    /// Texture coordinates (UVs).
    TextureCoordinates,
    /// Colours of vertices or faces.
    Colors,
    /// Materials: how many.
    Materials(usize),
    /// Texture images: how many.
    Textures(usize),
    /// Named objects, groups, solids or nodes: how many, at least 2.
    Parts(usize),
    /// Scenes beside the one that is read: how many.
    OtherScenes(usize),
    /// Animations: how many.
    Animations(usize),
    /// Skeletons that bend the mesh: how many.
    Skins(usize),
    /// Other shapes of the same mesh to blend with (morph targets).
    MorphTargets,
    /// Curves or surfaces that are not made of polygons.
    FreeForm,
    /// Points or lines. Lines are in [`Document::lines`](crate::Document::lines) where the format says so there.
    PointsOrLines,
    /// A number for each face of a binary stl, which some programs use for colours.
    FaceAttributes,
    /// Names of other properties (ply), each once, in the order of the file.
    Properties(Vec<String>),
}

impl Extra {
    /// Whether a mesh of new triangles lacks it: everything but normals.
    pub fn is_lost(&self) -> bool {
        *self != Self::Normals
    }
}

/// Names beyond this number are only counted.
const MOST_NAMES: usize = 5;

impl Display for Extra {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Normals => f.write_str("normals"),
            Self::TextureCoordinates => f.write_str("texture coordinates"),
            Self::Colors => f.write_str("colours"),
            Self::Materials(n) => counted(f, *n, "material"),
            Self::Textures(n) => counted(f, *n, "texture"),
            Self::Parts(n) => write!(f, "the names of {n} parts"),
            Self::OtherScenes(n) => counted(f, *n, "other scene"),
            Self::Animations(n) => counted(f, *n, "animation"),
            Self::Skins(n) => counted(f, *n, "skeleton"),
            Self::MorphTargets => f.write_str("morph targets"),
            Self::FreeForm => f.write_str("free-form curves or surfaces"),
            Self::PointsOrLines => f.write_str("points or lines"),
            Self::FaceAttributes => f.write_str("attributes of faces"),
            Self::Properties(names) => {
                write!(f, "the properties {}", names[..names.len().min(MOST_NAMES)].join(", "))?;
                if names.len() > MOST_NAMES { write!(f, " and {} more", names.len() - MOST_NAMES) } else { Ok(()) }
            }
        }
    }
}

fn counted(f: &mut Formatter, n: usize, what: &str) -> fmt::Result {
    write!(f, "{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// Collects the extras of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Extras {
    found: BTreeSet<Extra>,
    properties: Vec<String>,
}

impl Extras {
    /// Notes something, once however often it comes; a count of 0 is nothing, and the name of a single part says little.
    pub(crate) fn note(&mut self, extra: Extra) {
        use Extra::{Animations, Materials, OtherScenes, Parts, Skins, Textures};
        match extra {
            Materials(0) | Textures(0) | OtherScenes(0) | Animations(0) | Skins(0) | Parts(0 | 1) => {}
            Extra::Properties(names) => names.into_iter().for_each(|name| self.property(name)),
            other => {
                self.found.insert(other);
            }
        }
    }
    /// Notes something if it is there.
    pub(crate) fn note_if(&mut self, there: bool, extra: Extra) {
        if there {
            self.note(extra);
        }
    }
    /// Notes a property that has only a name.
    pub(crate) fn property(&mut self, name: String) {
        if !self.properties.contains(&name) {
            self.properties.push(name);
        }
    }
    /// Everything noted, in the order of [`Extra`].
    pub(crate) fn list(mut self) -> Vec<Extra> {
        if !self.properties.is_empty() {
            self.found.insert(Extra::Properties(self.properties));
        }
        self.found.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_noted_once_and_named_in_words() {
        let mut extras = Extras::default();
        for _ in 0..2 {
            extras.note(Extra::Materials(3));
            extras.note(Extra::TextureCoordinates);
            extras.note(Extra::Textures(1));
            extras.note(Extra::Parts(1));
            extras.note(Extra::Skins(0));
            (0..7).for_each(|i| extras.property(format!("p{i}")));
        }
        let list: Vec<String> = extras.list().iter().map(Extra::to_string).collect();
        let properties = "the properties p0, p1, p2, p3, p4 and 2 more";
        assert_eq!(list, ["texture coordinates", "3 materials", "1 texture", properties]);
    }
}
