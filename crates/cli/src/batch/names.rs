//! What the results of a batch are called.

use crate::failure::{Failure, Kind};
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

/// The result of each input, as a path below the output folder: that of the input below `root`, with another extension.
///
/// Where this gives several the same name (`a.obj` and `a.stl`), in upper or lower case, these keep their own extension before the new
/// one (`a.stl.ply`). Fails where two are the same even so.
pub(super) fn results(inputs: &[PathBuf], root: &Path, extension: &str) -> Result<Vec<PathBuf>, Failure> {
    let short: Vec<PathBuf> = inputs.iter().map(|input| extended(without_extension(&below(input, root)), extension)).collect();
    let counts = counts(&short);
    let names: Vec<PathBuf> = inputs
        .iter()
        .zip(short)
        .map(|(input, short)| if counts[&folded(&short)] > 1 { extended(below(input, root), extension) } else { short })
        .collect();
    check_distinct(inputs, &names)?;
    Ok(names)
}

/// With an extension after what is there.
fn extended(path: PathBuf, extension: &str) -> PathBuf {
    let mut name = path.into_os_string();
    name.push(".");
    name.push(extension);
    name.into()
}

/// The part of a path below a folder; never one that leads elsewhere.
fn below(path: &Path, root: &Path) -> PathBuf {
    let part = path.strip_prefix(root).unwrap_or(path);
    part.components().filter(|part| matches!(part, Component::Normal(_))).collect()
}

/// Without the extension, and without that before `.gz`.
fn without_extension(path: &Path) -> PathBuf {
    let is_packed = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz"));
    let path = path.with_extension("");
    if is_packed { path.with_extension("") } else { path }
}

/// One key for names that some file systems take for the same.
fn folded(path: &Path) -> String {
    path.to_string_lossy().to_lowercase()
}

fn counts(names: &[PathBuf]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for name in names {
        *counts.entry(folded(name)).or_default() += 1;
    }
    counts
}

fn check_distinct(inputs: &[PathBuf], names: &[PathBuf]) -> Result<(), Failure> {
    let mut taken = BTreeMap::new();
    for (input, name) in inputs.iter().zip(names) {
        if let Some(other) = taken.insert(folded(name), input) {
            let [a, b, name] = [other, input, name].map(|path| path.display());
            let message = format!("the results of {a} and {b} would both be {name}; rename one of them, or leave one out");
            return Err(Failure::new(Kind::Overwrite, message));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(inputs: &[&str]) -> Result<Vec<String>, Failure> {
        let inputs: Vec<PathBuf> = inputs.iter().map(|input| Path::new("/in").join(input)).collect();
        let names = results(&inputs, Path::new("/in"), "ply")?;
        Ok(names.iter().map(|name| name.to_string_lossy().replace('\\', "/")).collect())
    }

    #[test]
    fn results_are_where_the_inputs_are() {
        let inputs = ["a/x.obj", "b/x.stl", "b/x.y.off", "scan.PLY.gz", "noextension"];
        assert_eq!(named(&inputs).unwrap(), ["a/x.ply", "b/x.ply", "b/x.y.ply", "scan.ply", "noextension.ply"]);
    }

    #[test]
    fn one_name_for_several_is_told_apart() {
        let inputs = ["a/X.obj", "a/x.stl", "a/x.stl.gz", "b/x.stl", "a.obj/x.stl"];
        let names = ["a/X.obj.ply", "a/x.stl.ply", "a/x.stl.gz.ply", "b/x.ply", "a.obj/x.ply"];
        assert_eq!(named(&inputs).unwrap(), names);
        let error = named(&["x.obj", "x.stl", "x.stl.off"]).unwrap_err().to_string();
        assert!(error.contains("would both be x.stl.ply; rename"), "{error}");
    }
}
