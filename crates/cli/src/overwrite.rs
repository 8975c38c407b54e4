//! Files that would be written over files that are read.

use crate::failure::{Failure, Kind};
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Fails when one of the files that will be written is one of those that are read, by whatever name or link.
pub(crate) fn check<'a>(read: impl IntoIterator<Item = &'a Path>, written: &[PathBuf]) -> Result<(), Failure> {
    // A file that does not exist yet is none that is read.
    let exists: Vec<(&PathBuf, PathBuf)> = written.iter().filter_map(|path| Some((path, fs::canonicalize(path).ok()?))).collect();
    for input in read {
        let Ok(place) = fs::canonicalize(input) else { continue };
        if let Some((output, _)) = exists.iter().find(|(_, other)| *other == place) {
            let what =
                if *output == input { "it is read".to_owned() } else { format!("it is {}, which is read", input.display()) };
            let message = format!("would write over {}: {what}; name another file, or add --force", output.display());
            return Err(Failure::new(Kind::Overwrite, message));
        }
    }
    Ok(())
}

/// Fails when a file that will be written has the name of a picture.
pub(crate) fn check_distinct(output: &Path, others: &[PathBuf]) -> Result<(), Failure> {
    let Some(taken) = place(output) else { return Ok(()) };
    if others.iter().any(|other| place(other).is_some_and(|p| p == taken)) {
        let message = format!("{} is also the name of a picture of a stage; name another file or folder", output.display());
        return Err(Failure::new(Kind::Overwrite, message));
    }
    Ok(())
}

/// Fails when two files of a result have one name.
pub(crate) fn check_different(files: &[PathBuf]) -> Result<(), Failure> {
    let mut taken = HashSet::new();
    match files.iter().find(|file| place(file).is_some_and(|place| !taken.insert(place))) {
        Some(twice) => {
            let message =
                format!("{} would be written twice, as two parts of the result; name another file or folder", twice.display());
            Err(Failure::new(Kind::Overwrite, message))
        }
        None => Ok(()),
    }
}

/// Where a file is or will be; none where its folder is not there.
fn place(path: &Path) -> Option<PathBuf> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    fs::canonicalize(folder).map(|folder| folder.join(path.file_name().unwrap_or_default())).ok()
}
