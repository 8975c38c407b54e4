//! What is remeshed: models where they are there, and meshes of any size by a generator of the fixtures.

use super::program::Job;
use crate::process::{cargo, must, output, target_directory};
use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Models, parts and the dragon, with base vertices and levels.
const MODELS: [(&str, usize, u32); 4] =
    [("fandisk.obj", 208, 3), ("kitten.obj", 605, 2), ("chinese_lion.obj", 654, 3), ("igea.ply", 940, 3)];
const CASES: [(&str, usize, u32); 2] = [("flange_002_coarse.stl", 1500, 2), ("housing_006_normal.stl", 1500, 2)];
const DRAGON: (usize, u32) = (1500, 3);

/// Folders and files that the caller has.
pub(super) struct Found<'a> {
    pub(super) models: Option<&'a Path>,
    pub(super) cases: Option<&'a Path>,
    pub(super) dragon: Option<&'a Path>,
}

impl Found<'_> {
    /// The models that are there; a line for each that is not.
    pub(super) fn jobs(&self) -> Vec<Job> {
        let in_folder = |folder: Option<&Path>, list: &[(&str, usize, u32)]| -> Vec<(String, Option<PathBuf>, usize, u32)> {
            list.iter().map(|&(name, base, levels)| (name.to_owned(), folder.map(|f| f.join(name)), base, levels)).collect()
        };
        let mut wanted = in_folder(self.models, &MODELS);
        wanted.extend(in_folder(self.cases, &CASES));
        wanted.push(("dragon".to_owned(), self.dragon.map(Path::to_owned), DRAGON.0, DRAGON.1));
        let mut jobs = Vec::new();
        for (name, path, base_vertices, levels) in wanted {
            match path.filter(|path| path.is_file()) {
                Some(input) => jobs.push(Job { name, input, base_vertices, levels }),
                None => println!("skipped: {name} is not there (--models, --cases and --dragon say where)"),
            }
        }
        jobs
    }
}

/// The generator of dense meshes, built.
pub(super) struct Generator {
    binary: PathBuf,
    folder: PathBuf,
}

impl Generator {
    pub(super) fn build() -> Result<Self> {
        must(&mut cargo(&["build", "--release", "-p", "fixtures", "--bin", "make-dense"]))?;
        let target = target_directory()?;
        let folder = target.join("bench/inputs");
        fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
        Ok(Self { binary: target.join("release/make-dense"), folder })
    }

    /// A mesh of this shape with about so many triangles, and how many it has.
    pub(super) fn make(&self, shape: &str, triangles: usize, base_vertices: usize, levels: u32) -> Result<(Job, usize)> {
        let name = format!("{shape} {}k", triangles / 1000);
        let input = self.folder.join(format!("{shape}_{triangles}.ply"));
        let made = output(Command::new(&self.binary).arg(shape).arg(triangles.to_string()).arg(&input))?;
        let made = made.trim().parse().with_context(|| format!("make-dense printed {made}"))?;
        Ok((Job { name, input, base_vertices, levels }, made))
    }
}
