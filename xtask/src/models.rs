//! Folders of models, and how each of them is remeshed.

use crate::root;
use anyhow::{Context, Result};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// How models are remeshed, by file name; those that are not in it get the program's defaults.
#[derive(Deserialize)]
pub(crate) struct Spec(BTreeMap<String, Entry>);

/// How one model is remeshed: its field names are those of the file.
#[derive(Deserialize, Clone, Copy, Default, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
struct Entry {
    /// Wanted number of base vertices.
    base: Option<usize>,
    level: Option<u32>,
}

/// Levels of a model without an entry: the program's default.
const LEVELS: u32 = 3;

impl Spec {
    /// Reads a file; without one the spec of the workspace, with the paper's base sizes.
    pub(crate) fn load(path: Option<&Path>) -> Result<Self> {
        let path = path.map_or_else(|| root().join("xtask/spec.json"), Path::to_owned);
        let text = fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
        serde_json::from_str(&text)
            .with_context(|| format!("{} should hold {{\"NAME\": {{\"base\": N, \"level\": L}}}}", path.display()))
    }

    /// The wanted number of base vertices and the levels of a model.
    pub(crate) fn of(&self, file: &str) -> (Option<usize>, u32) {
        let Entry { base, level } = self.0.get(file).copied().unwrap_or_default();
        (base, level.unwrap_or(LEVELS))
    }
}

/// Names of the mesh files in a folder, sorted.
pub(crate) fn files(folder: &Path) -> Result<Vec<String>> {
    let entries = fs::read_dir(folder).with_context(|| format!("cannot list {}", folder.display()))?;
    let mut names = entries.map(|e| Ok(e?.file_name().to_string_lossy().into_owned())).collect::<Result<Vec<_>>>()?;
    names.retain(|name| [".obj", ".ply", ".stl", ".off", ".gltf", ".glb"].iter().any(|end| name.to_lowercase().ends_with(end)));
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_spec_leaves_out_is_the_default() {
        let spec: Spec = serde_json::from_str(r#"{"a.obj": {"base": 208, "level": 2}, "b.obj": {"base": 100}}"#).unwrap();
        assert_eq!(spec.of("a.obj"), (Some(208), 2));
        assert_eq!(spec.of("b.obj"), (Some(100), LEVELS));
        assert_eq!(spec.of("c.obj"), (None, LEVELS));
        assert!(serde_json::from_str::<Spec>(r#"{"a.obj": {"levels": 2}}"#).is_err());
    }

    #[test]
    fn our_own_spec_can_be_read() {
        assert_eq!(Spec::load(None).unwrap().of("fandisk.obj"), (Some(208), 3));
    }
}
