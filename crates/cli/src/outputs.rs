//! The files of a remeshing: the result or one of its levels, all levels, the map, and all of these for each variant.

use crate::args::OutputArgs;
use crate::displacement_folder;
use crate::failure::{Failure, Kind};
use crate::stream::Target;
use mesh_io::Format;
use semireg::{FaceOrder, MAX_LEVELS};
use std::path::{Path, PathBuf};

/// What is written of a result.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outputs {
    /// The level that the output holds; `None` for the finest.
    pub(crate) level: Option<u32>,
    /// Whether every level is written, too.
    pub(crate) all_levels: bool,
    pub(crate) order: FaceOrder,
    /// Bits of displacements; none where they are not quantised.
    pub(crate) displacement_bits: Option<u8>,
    /// One for each result that is made.
    pub(crate) results: Vec<ResultFiles>,
}

/// The files of one result.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ResultFiles {
    pub(crate) seed: u64,
    pub(crate) output: Target,
    /// A file for each level, the base mesh first; empty where the output has them all or none is wanted.
    pub(crate) levels: Vec<PathBuf>,
    pub(crate) map: Option<PathBuf>,
    /// The folder of displacements.
    pub(crate) displacement: Option<PathBuf>,
}

impl Outputs {
    /// What the options ask for, of results of so many levels, `None` where that is not known, with seeds from this one on.
    pub(crate) fn new(args: &OutputArgs, output: &Target, levels: Option<u32>, seed: u64) -> Result<Self, Failure> {
        let usage = |message: String| Err(Failure::new(Kind::Usage, message));
        if let (Some(level), Some(finest)) = (args.level, levels)
            && level > finest
        {
            return usage(format!("--level {level} is above the finest level, {finest}; lower it or raise --levels"));
        }
        if let Some(map) = args.map.as_deref().filter(|map| map.extension().is_none_or(|e| !e.eq_ignore_ascii_case("npz"))) {
            return usage(format!("--map {}: the map is an npz; give a name that ends in .npz", map.display()));
        }
        if output.file().is_none() && (args.all_levels || args.variants.is_some()) {
            return usage("standard output takes one mesh; name a file for --all-levels or --variants".to_owned());
        }
        let Some(last) = seed.checked_add(u64::from(args.variants.unwrap_or(1)) - 1) else {
            return usage(format!("there are not so many seeds from {seed} on; give a smaller --seed"));
        };
        let finest = levels.unwrap_or(MAX_LEVELS);
        let results = (seed..=last).map(|seed| ResultFiles::new(args, output, finest, seed)).collect();
        let (order, displacement_bits) = (args.order.into(), args.displacement_bits);
        Ok(Self { level: args.level, all_levels: args.all_levels, order, displacement_bits, results })
    }

    /// All files that may be written.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        self.results.iter().flat_map(ResultFiles::all).collect()
    }

    /// All folders that are needed.
    pub(crate) fn folders(&self) -> impl Iterator<Item = &Path> {
        self.results.iter().filter_map(|files| files.displacement.as_deref())
    }

    /// Whether the output holds all levels.
    pub(crate) fn are_in_one(&self, files: &ResultFiles) -> bool {
        self.all_levels && files.output.file().is_some_and(holds_all_levels)
    }
}

impl ResultFiles {
    fn new(args: &OutputArgs, output: &Target, levels: u32, seed: u64) -> Self {
        let numbered = |path: &Path| if args.variants.is_some() { with_part(path, &format!("-{seed}")) } else { path.to_owned() };
        let output = match output {
            Target::File(path) => Target::File(numbered(path)),
            Target::StandardOutput(format) => Target::StandardOutput(*format),
        };
        let of_levels = output.file().filter(|path| args.all_levels && !holds_all_levels(path));
        let levels = of_levels.map(|path| (0..=levels).map(|k| with_part(path, &format!(".{k}"))).collect());
        let displacement = args.displacement.as_deref().map(|folder| match args.variants {
            Some(_) => folder.with_file_name(format!("{}-{seed}", folder.file_name().unwrap_or_default().to_string_lossy())),
            None => folder.to_owned(),
        });
        Self { seed, levels: levels.unwrap_or_default(), map: args.map.as_deref().map(numbered), displacement, output }
    }

    /// Those of a result that has so many levels.
    pub(crate) fn of_levels(&self, levels: u32) -> Self {
        let mut files = self.clone();
        files.levels.truncate(levels as usize + 1);
        files
    }

    /// All of them, the output first.
    pub(crate) fn all(&self) -> Vec<PathBuf> {
        let output = self.output.file().map(Path::to_owned);
        let displacement = self.displacement.as_deref().map(displacement_folder::files).unwrap_or_default();
        output.into_iter().chain(self.levels.iter().chain(&self.map).cloned()).chain(displacement).collect()
    }
}

/// Whether one file of this format holds all levels.
fn holds_all_levels(path: &Path) -> bool {
    matches!(mesh_io::writable_format(path), Ok(Format::Gltf | Format::Glb))
}

/// `out.obj` and `.0` give `out.0.obj`.
fn with_part(path: &Path, part: &str) -> PathBuf {
    let [stem, extension] = [path.file_stem(), path.extension()].map(|s| s.unwrap_or_default().to_string_lossy());
    path.with_file_name(format!("{stem}{part}.{extension}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outputs(args: &OutputArgs, output: &str) -> Result<Vec<String>, String> {
        let outputs = Outputs::new(args, &Target::File(output.into()), Some(2), 3).map_err(|e| e.to_string())?;
        Ok(outputs.files().iter().map(|path| path.display().to_string()).collect())
    }

    #[test]
    fn files_are_named_by_seed_and_level() {
        let named = |variants: Option<u32>, all_levels, map: Option<&str>, output| {
            outputs(&OutputArgs { variants, all_levels, map: map.map(PathBuf::from), ..OutputArgs::default() }, output).unwrap()
        };
        assert_eq!(named(None, false, None, "a/out.b.obj"), ["a/out.b.obj"]);
        assert_eq!(named(None, true, Some("m.npz"), "a/o.obj"), ["a/o.obj", "a/o.0.obj", "a/o.1.obj", "a/o.2.obj", "m.npz"]);
        assert_eq!(named(Some(2), false, Some("m.npz"), "o.ply"), ["o-3.ply", "m-3.npz", "o-4.ply", "m-4.npz"]);
        assert_eq!(named(Some(2), true, None, "o.glb"), ["o-3.glb", "o-4.glb"]);
        let all = OutputArgs { all_levels: true, ..OutputArgs::default() };
        let unknown = Outputs::new(&all, &Target::File("o.obj".into()), None, 0).unwrap();
        assert_eq!((unknown.files().len(), unknown.results[0].of_levels(1).all().len()), (10, 3));
        assert_eq!(named(Some(1), true, None, "o.off"), ["o-3.off", "o-3.0.off", "o-3.1.off", "o-3.2.off"]);
    }

    #[test]
    fn what_cannot_be_is_told() {
        let told = |args: OutputArgs| outputs(&args, "o.obj").unwrap_err();
        assert!(told(OutputArgs { level: Some(3), ..OutputArgs::default() }).contains("above the finest level, 2"));
        assert!(told(OutputArgs { map: Some("m.obj".into()), ..OutputArgs::default() }).contains("ends in .npz"));
        let args = OutputArgs { variants: Some(2), ..OutputArgs::default() };
        let streamed = Outputs::new(&args, &Target::StandardOutput(Format::Obj), None, 0).map_err(|e| e.to_string());
        assert!(streamed.unwrap_err().contains("name a file for --all-levels or --variants"));
        assert!(Outputs::new(&args, &Target::File("o.obj".into()), Some(2), u64::MAX).is_err());
    }
}
