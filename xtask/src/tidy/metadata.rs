//! What `cargo metadata` tells of our packages and those that we build with.

use crate::process::{cargo, output};
use crate::root;
use anyhow::{Context, Result};
use serde_json::Value;
use std::path::Path;

/// All of it.
pub(super) fn metadata() -> Result<Value> {
    let text = output(&mut cargo(&["metadata", "--format-version", "1", "--locked"]))?;
    serde_json::from_str(&text).context("cargo metadata")
}

/// The packages: those of the workspace only, or all.
pub(super) fn packages(metadata: &Value, workspace_only: bool) -> impl Iterator<Item = &Value> {
    let members: Vec<&Value> = metadata["workspace_members"].as_array().into_iter().flatten().collect();
    let all = metadata["packages"].as_array().into_iter().flatten();
    all.filter(move |p| !workspace_only || members.contains(&&p["id"]))
}

/// The folders of the crates of the workspace, from the workspace's, in order.
pub(super) fn folders(metadata: &Value) -> Vec<String> {
    let manifests = packages(metadata, true).map(|p| Path::new(text(p, "manifest_path")));
    let folders = manifests.filter_map(|manifest| manifest.parent()?.strip_prefix(root()).ok());
    let mut folders: Vec<String> = folders.map(|folder| folder.display().to_string()).collect();
    folders.sort();
    folders
}

/// A text field of a package.
pub(super) fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}
