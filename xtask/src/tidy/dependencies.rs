//! Who may depend on whom (ARCHITECTURE.md). Dev-dependencies may cross, but for those of benches.

use super::metadata::{packages, text};
use serde_json::Value;

/// The stages don't see each other: what passes between them is in region-map.
const STAGES: &[&str] = &[
    "refine",
    "features",
    "sizing",
    "proxy",
    "segment-vsa",
    "segment-cvt",
    "basemesh",
    "trace-base",
    "subdiv",
    "project",
    "reconnect",
    "relax",
    "snap",
    "fit",
];

/// What stages see.
const BASIS: &[&str] = &["mesh-core", "region-map"];

/// The crates of the workspace that one of them may depend on; `None` for a crate that has no place yet.
fn may_see(name: &str) -> Option<Vec<&'static str>> {
    match name {
        "mesh-core" | "conjugate-gradients" | "xtask" => Some(vec![]),
        "mesh-io" | "attributes" | "region-map" | "certify" | "correspondence" | "fixtures" => Some(vec!["mesh-core"]),
        "view" => Some(BASIS.to_vec()),
        // It takes meshes apart by the levels that correspondence finds in them.
        "displacement" => Some(vec!["mesh-core", "correspondence"]),
        // The stages that solve systems with unknowns at vertices.
        "relax" | "fit" => Some([BASIS, &["conjugate-gradients"]].concat()),
        // Both make base meshes with a map, by the same charts.
        "chart" => Some(BASIS.to_vec()),
        "basemesh" | "trace-base" => Some([BASIS, &["chart"]].concat()),
        // It rates edits of a base mesh by how well its subdivision relaxes.
        "reconnect" => Some([BASIS, &["relax"]].concat()),
        stage if STAGES.contains(&stage) => Some(BASIS.to_vec()),
        "semireg" => Some([BASIS, STAGES, &["certify", "correspondence"]].concat()),
        // For the property tests of the stages only.
        "odd-arguments" => Some([BASIS, &["fixtures"]].concat()),
        "cli" => Some([BASIS, &["mesh-io", "attributes", "features", "certify", "displacement", "view", "semireg"]].concat()),
        _ => None,
    }
}

/// Foreign crates that only some of ours may use, in any role.
const ONLY_IN: &[(&str, &[&str])] = &[
    ("obvhs", &["mesh-core"]),
    ("spade", &["basemesh", "fixtures"]),
    ("bevy_mikktspace", &["mesh-io"]),
    ("flate2", &["mesh-io"]),
    ("gltf", &["mesh-io"]),
    ("gltf-json", &["mesh-io"]),
    ("ply-rs-bw", &["mesh-io"]),
    ("rawzip", &["mesh-io"]),
    ("stl_io", &["mesh-io"]),
    ("tobj", &["mesh-io"]),
    ("png", &["view"]),
    ("anyhow", &["cli", "xtask"]),
    ("clap", &["cli", "xtask"]),
    ("ctrlc", &["cli"]),
    ("fs4", &["cli"]),
    ("indicatif", &["cli"]),
    ("serde", &["cli", "xtask"]),
    ("serde_json", &["cli", "mesh-io", "xtask"]),
    ("sysinfo", &["cli"]),
    ("nix", &["xtask"]),
    ("proc-macro2", &["xtask"]),
    ("syn", &["xtask"]),
    ("criterion", &["semireg"]),
];

/// Every dependency that is not allowed, and every crate that has no place yet.
pub(super) fn check(metadata: &Value) -> Vec<String> {
    let mut problems = Vec::new();
    for package in packages(metadata, true) {
        let name = text(package, "name");
        let Some(allowed) = may_see(name) else {
            problems.push(format!("crate {name} has no place among the dependencies ({})", file!()));
            continue;
        };
        for dependency in package["dependencies"].as_array().into_iter().flatten() {
            let wanted = text(dependency, "name");
            let only_in = ONLY_IN.iter().find(|(n, _)| *n == wanted);
            if may_see(wanted).is_some() && dependency["kind"].is_null() && !allowed.contains(&wanted) {
                problems.push(format!("{name} must not depend on {wanted}"));
            }
            if only_in.is_some_and(|(_, crates)| !crates.contains(&name)) {
                problems.push(format!("{name} must not use {wanted}: it belongs to {}", only_in.map_or("", |(_, c)| c[0])));
            }
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn problems(name: &str, dependency: Value) -> Vec<String> {
        let package = json!({ "id": "x", "name": name, "dependencies": [dependency] });
        check(&json!({ "workspace_members": ["x"], "packages": [package] }))
    }

    #[test]
    fn stages_do_not_see_each_other() {
        assert_eq!(problems("project", json!({ "name": "subdiv", "kind": null })), ["project must not depend on subdiv"]);
        assert!(problems("project", json!({ "name": "region-map", "kind": null })).is_empty());
        assert!(problems("relax", json!({ "name": "conjugate-gradients", "kind": null })).is_empty());
        assert_eq!(problems("relax", json!({ "name": "fit", "kind": null })), ["relax must not depend on fit"]);
        assert!(problems("reconnect", json!({ "name": "relax", "kind": null })).is_empty());
        assert_eq!(problems("relax", json!({ "name": "reconnect", "kind": null })), ["relax must not depend on reconnect"]);
        assert_eq!(
            problems("trace-base", json!({ "name": "basemesh", "kind": null })),
            ["trace-base must not depend on basemesh"]
        );
        assert!(problems("project", json!({ "name": "subdiv", "kind": "dev" })).is_empty());
    }

    #[test]
    fn foreign_crates_stay_where_they_belong() {
        assert_eq!(problems("relax", json!({ "name": "obvhs", "kind": null })).len(), 1);
        assert!(problems("mesh-core", json!({ "name": "obvhs", "kind": null })).is_empty());
    }

    #[test]
    fn an_unknown_crate_is_told() {
        assert_eq!(problems("stray", json!({ "name": "glam", "kind": null })).len(), 1);
    }
}
