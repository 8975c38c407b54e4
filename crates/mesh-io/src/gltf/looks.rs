//! What the materials of a glTF file look like.

use super::buffers::Buffers;
use gltf_json::Index;
use serde_json::{Map, Value};

/// Materials, textures and images of a glTF file, as it has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GltfLooks {
    /// The arrays `materials`, `textures` and `samplers`, with what the file has of them.
    pub(super) arrays: Map<String, Value>,
    pub(super) images: Vec<Image>,
    /// Names of the extensions that they use, and of those without which they cannot be shown.
    pub(super) extensions: [Vec<String>; 2],
}

/// An image: its JSON without the place where its bytes are, and the bytes if they are in the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Image {
    pub(super) json: Map<String, Value>,
    pub(super) bytes: Option<Vec<u8>>,
}

/// The arrays that are kept word by word.
const KEPT: [&str; 3] = ["materials", "textures", "samplers"];
/// The lists of extensions of a file.
pub(super) const EXTENSION_LISTS: [&str; 2] = ["extensionsUsed", "extensionsRequired"];

impl GltfLooks {
    pub(super) fn read(root: &Value, buffers: &Buffers) -> Self {
        let kept = KEPT.iter().filter_map(|&name| Some((name.to_owned(), root.get(name).filter(|v| v.is_array())?.clone())));
        let arrays: Map<String, Value> = kept.collect();
        let images: Vec<Image> = root["images"].as_array().into_iter().flatten().map(|json| Image::read(json, buffers)).collect();
        let text = Value::Object(arrays.clone()).to_string();
        let is_used = |name: &String| text.contains(&format!("\"{name}\""));
        let extensions = EXTENSION_LISTS.map(|list| {
            let names = root[list].as_array().into_iter().flatten().filter_map(Value::as_str).map(str::to_owned);
            names.filter(is_used).collect()
        });
        Self { arrays, images, extensions }
    }

    pub(crate) fn rename(&mut self, rename: impl Fn(&str) -> String) {
        for image in &mut self.images {
            if let Some(Value::String(uri)) = image.json.get_mut("uri")
                && !uri.starts_with("data:")
                && !uri.contains("://")
            {
                *uri = rename(uri);
            }
        }
    }
}

impl Image {
    fn read(json: &Value, buffers: &Buffers) -> Self {
        let mut json = json.as_object().cloned().unwrap_or_default();
        let view = json.remove("bufferView").and_then(|view| view.as_u64()).and_then(|view| u32::try_from(view).ok());
        let bytes = view.and_then(|view| buffers.view(Index::new(view)));
        Self { json, bytes: bytes.map(<[u8]>::to_vec) }
    }
}
