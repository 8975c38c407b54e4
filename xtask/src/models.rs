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

/// Levels of a model without an entry: the default of `semireg`.
pub(crate) const LEVELS: u32 = 2;

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

/// The models that a check of a change runs, where the folder has them, each with what it is there for. A whole folder of
/// models takes hours.
const NAMED: &[(&str, &str)] = &[
    ("fandisk.obj", "creases that end on smooth surfaces; the paper has it too"),
    ("block.obj", "a block with cylinders and holes, genus 3"),
    ("casting.off", "genus 9, small details beside large faces"),
    ("joint.obj", "the largest part with creases, genus 2"),
    ("rabbit_on_base.obj", "a free form joined to one with creases"),
    ("spot.obj", "a coarse free form, with texture coordinates"),
    ("camelhead.off", "a free form with a border"),
    ("mech-holes-shark.off", "a free form with holes, few creases"),
    ("non_manif_hole.ply", "vertices that are not manifold"),
    ("many_small_holes.ply", "32 border loops: more base vertices are needed than asked for"),
    ("self_intersectA.obj", "a surface that passes through itself"),
    ("corrupted_invalid_double.obj", "a number that cannot be read: refused in words"),
];

/// Of the files of a folder those that are named, and the named ones that it lacks.
pub(crate) fn split_named(files: Vec<String>) -> (Vec<String>, Vec<&'static str>) {
    let missing = NAMED.iter().map(|(name, _)| *name).filter(|name| !files.iter().any(|file| file == name)).collect();
    let named = files.into_iter().filter(|file| NAMED.iter().any(|(name, _)| file == name)).collect();
    (named, missing)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_check_runs_named_models_only_and_tells_which_are_missing() {
        let files = ["airplane.obj", "block.obj", "fandisk.obj"].map(str::to_owned).to_vec();
        let (named, missing) = split_named(files);
        assert_eq!(named, ["block.obj", "fandisk.obj"]);
        assert_eq!(missing.len(), NAMED.len() - 2);
        assert!(NAMED.len() <= 12 && !missing.contains(&"block.obj"));
    }

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
