//! Which files a batch is of.

use crate::failure::{Failure, Kind};
use crate::stream::is_stream;
use anyhow::Context as _;
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The files of a batch.
#[derive(Debug)]
pub(super) struct Inputs {
    /// Absolute paths in increasing order, each once.
    pub(super) files: Vec<PathBuf>,
    /// The folder that holds all of them.
    pub(super) root: PathBuf,
}

/// Finds the files: those named, and those of the folders named that have the extension of a mesh format. Folders are searched with all
/// folders inside; hidden ones and the output folder are passed over, as are hidden files.
pub(super) fn find(named: &[PathBuf], out: &Path) -> anyhow::Result<Inputs> {
    // No folder that is not there yet is searched.
    let out = fs::canonicalize(out).ok();
    let (mut files, mut homes) = (Vec::new(), Vec::new());
    for path in named {
        if is_stream(path) {
            let message = "`batch` reads files; for a list of them from standard input, say `--list -`";
            return Err(Failure::new(Kind::Usage, message).into());
        }
        let path = resolved(path).with_context(|| format!("cannot use the path {}", path.display()))?;
        if path.is_dir() {
            check_apart(&path, out.as_deref())?;
            search(&path, out.as_deref(), &mut files)?;
            homes.push(path);
        } else {
            homes.push(path.parent().unwrap_or(&path).to_owned());
            files.push(path);
        }
    }
    files.sort();
    files.dedup();
    let root = homes.into_iter().reduce(|a, b| common(&a, &b)).unwrap_or_default();
    if files.is_empty() {
        let message = "there is no mesh in what was named; name files or folders of obj, ply, stl, off, gltf or glb";
        return Err(Failure::new(Kind::Empty, message).into());
    }
    Ok(Inputs { files, root })
}

/// The paths in a list, one a line; empty lines are passed over.
pub(super) fn listed(list: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let text = if is_stream(list) { io::read_to_string(io::stdin()) } else { fs::read_to_string(list) };
    let text = text.with_context(|| format!("cannot read the list {} (--list)", list.display()))?;
    Ok(text.lines().filter(|line| !line.trim().is_empty()).map(PathBuf::from).collect())
}

/// The absolute path of a folder with all links resolved, or of a file with those of its folder; a file may be a link, or be missing.
fn resolved(path: &Path) -> io::Result<PathBuf> {
    let path = std::path::absolute(path)?;
    if path.is_dir() {
        return fs::canonicalize(path);
    }
    let folder = path.parent().and_then(|folder| fs::canonicalize(folder).ok());
    Ok(folder.zip(path.file_name()).map(|(folder, name)| folder.join(name)).unwrap_or(path))
}

/// Results in a folder that is searched would be inputs of the same batch when it is resumed.
fn check_apart(folder: &Path, out: Option<&Path>) -> Result<(), Failure> {
    if out == Some(folder) {
        let message = format!("{} is the folder of the inputs and of the results; name another --out", folder.display());
        return Err(Failure::new(Kind::Overwrite, message));
    }
    Ok(())
}

fn search(folder: &Path, out: Option<&Path>, files: &mut Vec<PathBuf>) -> anyhow::Result<()> {
    let cannot = || format!("cannot search the folder {}; check its permissions", folder.display());
    for entry in fs::read_dir(folder).with_context(cannot)? {
        let entry = entry.with_context(cannot)?;
        let path = entry.path();
        if path.file_name().is_some_and(is_hidden) || out == Some(&path) {
            continue;
        }
        // Links to files are followed. Those to folders are not: they may lead in a circle.
        if entry.file_type().with_context(cannot)?.is_dir() {
            search(&path, out, files)?;
        } else if path.is_file() && mesh_io::readable_format(&path).is_some() {
            files.push(path);
        }
    }
    Ok(())
}

fn is_hidden(name: &OsStr) -> bool {
    name.as_encoded_bytes().starts_with(b".")
}

/// The innermost folder that holds both.
fn common(a: &Path, b: &Path) -> PathBuf {
    a.components().zip(b.components()).take_while(|(a, b)| a == b).map(|(a, _)| a).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder_of(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for file in files {
            let path = folder.path().join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "").unwrap();
        }
        folder
    }

    /// The names of what is found below the root.
    fn found(folder: &Path, named: &[&str], out: &str) -> (Vec<String>, PathBuf) {
        let named: Vec<PathBuf> = named.iter().map(|name| folder.join(name)).collect();
        let Inputs { files, root } = find(&named, &folder.join(out)).unwrap();
        let names = files.iter().map(|f| f.strip_prefix(&root).unwrap().to_string_lossy().replace('\\', "/")).collect();
        (names, root)
    }

    #[test]
    fn folders_are_searched_but_not_for_results() {
        let folder = folder_of(&[
            "b/y.STL",
            "a.obj",
            "b/c/x.ply.gz",
            "b/notes.txt",
            ".hidden/z.obj",
            "b/._y.obj",
            "out/a.obj",
            "out/b/y.obj",
        ]);
        let (names, root) = found(folder.path(), &["."], "out");
        assert_eq!(names, ["a.obj", "b/c/x.ply.gz", "b/y.STL"]);
        assert_eq!(root, fs::canonicalize(folder.path()).unwrap());
    }

    #[test]
    fn files_are_named_below_the_folder_that_they_share() {
        let folder = folder_of(&["p/a/x.obj", "p/b/x.stl", "p/b/y.obj"]);
        // A file may be named twice, and one that is missing is told in its line.
        let named = ["p/b/x.stl", "p/a/x.obj", "p/a/../a/x.obj", "p/b/missing.obj"];
        assert_eq!(found(folder.path(), &named, "out").0, ["a/x.obj", "b/missing.obj", "b/x.stl"]);
        assert_eq!(found(folder.path(), &["p/a", "p/b/y.obj"], "out").0, ["a/x.obj", "b/y.obj"]);
        assert_eq!(found(folder.path(), &["p/a/x.obj"], "out").0, ["x.obj"]);
    }

    #[test]
    fn no_input_and_inputs_among_the_results_are_refused() {
        let folder = folder_of(&["notes.txt", "m/a.obj"]);
        let refused = |named: &str, out: &str| {
            Failure::of(find(&[folder.path().join(named)], &folder.path().join(out)).unwrap_err()).to_string()
        };
        assert!(refused(".", "m").contains("no mesh"), "the only one is in the output folder");
        assert!(refused("m", "m/../m").contains("name another --out"));
    }

    #[test]
    fn a_list_has_a_path_in_every_line() {
        let folder = folder_of(&[]);
        let list = folder.path().join("list.txt");
        fs::write(&list, "a b.obj\r\n\n../c.stl").unwrap();
        assert_eq!(listed(&list).unwrap(), [Path::new("a b.obj"), Path::new("../c.stl")]);
    }
}
