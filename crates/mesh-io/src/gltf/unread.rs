//! What a glTF file holds beside triangles, named.

use super::scene::Instance;
use crate::extra::{Extra, Extras};
use gltf_json::Root;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;

/// Notes what the file and the meshes of its scene have beside positions and triangles.
pub(super) fn note(root: &Root, instances: &[Instance<'_>], extras: &mut Extras) {
    extras.note(Extra::Materials(root.materials.len()));
    extras.note(Extra::Textures(root.textures.len()));
    extras.note(Extra::OtherScenes(root.scenes.len().saturating_sub(1)));
    extras.note(Extra::Animations(root.animations.len()));
    extras.note(Extra::Skins(root.skins.len()));
    let named =
        |node: &&gltf_json::Node| node.mesh.and_then(|mesh| node.name.as_ref().or(root.get(mesh)?.name.as_ref())).is_some();
    extras.note(Extra::Parts(root.nodes.iter().filter(named).count()));
    for primitive in instances.iter().flat_map(|instance| &instance.mesh.primitives) {
        note_primitive(primitive, extras);
    }
}

fn note_primitive(primitive: &Primitive, extras: &mut Extras) {
    let has_triangles = matches!(primitive.mode, Checked::Valid(Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan));
    extras.note_if(!has_triangles, Extra::PointsOrLines);
    extras.note_if(primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty()), Extra::MorphTargets);
    for semantic in primitive.attributes.keys() {
        match semantic {
            Checked::Valid(Semantic::Normals | Semantic::Tangents) => extras.note(Extra::Normals),
            Checked::Valid(Semantic::Colors(_)) => extras.note(Extra::Colors),
            Checked::Valid(Semantic::TexCoords(_)) => extras.note(Extra::TextureCoordinates),
            // Joints and weights belong to a skeleton, which is noted; other names are those of single programs.
            _ => {}
        }
    }
}
