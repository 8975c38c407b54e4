//! The command line as the user types it.

use clap::{Parser, Subcommand};
use semireg::{Method, Options, PaperOptions, Weights};
use std::ops::RangeInclusive;
use std::path::PathBuf;

/// Semi-regular remeshing of triangle meshes: few base triangles, split 1-to-4 again and again, with the creases kept.
#[derive(Parser)]
#[command(name = "semireg", version)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Remesh INPUT and write the certified result to OUTPUT
    Remesh(RemeshArgs),
    /// Make the base mesh of INPUT, before any subdivision, and write it to BASE
    Base(BaseArgs),
    /// Draw what every stage up to the base mesh makes of INPUT
    Stages(StagesArgs),
    /// Say what a file holds: counts, topology, defects, features, quality
    Inspect(InspectArgs),
    /// Measure how well B stands for A: distance, creases, quality, topology
    Compare(CompareArgs),
    /// Check that a file is a sound mesh of so many subdivision levels; exit 1 if not
    Check(CheckArgs),
}

#[derive(clap::Args)]
pub(crate) struct RemeshArgs {
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    /// Where the result goes; the extension says in which format
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// How often every base triangle is split in four
    #[arg(long, value_name = "L", default_value_t = Options::default().levels, value_parser = levels, allow_negative_numbers = true)]
    pub(crate) levels: u32,
    /// Leave the vertices on the surface, instead of where the triangles between them come closest to it
    #[arg(long)]
    pub(crate) no_fit: bool,
    /// A base mesh of your own to subdivide, in any format: a manifold of the input's topology, near its surface
    #[arg(long, value_name = "FILE", conflicts_with = "base_vertices")]
    pub(crate) base: Option<PathBuf>,
    /// Leave a picture (PNG) and a coloured mesh (PLY) of every stage in this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) stages: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) paper: PaperArgs,
}

/// What only `--method paper` takes.
#[derive(clap::Args, Clone, Copy)]
pub(crate) struct PaperArgs {
    /// With --method paper: weights of the neighbours in its relaxation [default: uniform]
    #[arg(long, value_name = "WEIGHTS", value_enum)]
    pub(crate) relax_weights: Option<WeightsArg>,
    /// With --method paper: mean quality at which its relaxation stops, 0 to 1 [default: 1, never reached]
    #[arg(long, value_name = "Q", value_parser = quality, allow_negative_numbers = true)]
    pub(crate) target_quality: Option<f64>,
    /// With --method paper: iterations of its relaxation at most; it ends before when nothing is gained [default: 100]
    #[arg(long, value_name = "N", value_parser = iterations, allow_negative_numbers = true)]
    pub(crate) relax_iterations: Option<u32>,
}

impl PaperArgs {
    /// The first option that was given.
    pub(crate) fn given(self) -> Option<&'static str> {
        let options = [
            ("--relax-weights", self.relax_weights.is_some()),
            ("--target-quality", self.target_quality.is_some()),
            ("--relax-iterations", self.relax_iterations.is_some()),
        ];
        options.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
    }

    /// The same for the library.
    pub(crate) fn options(self) -> PaperOptions {
        let default = PaperOptions::default();
        PaperOptions {
            weights: self.relax_weights.map_or(default.weights, Weights::from),
            target_quality: self.target_quality.unwrap_or(default.target_quality),
            iterations: self.relax_iterations.map_or(default.iterations, |n| n as usize),
        }
    }
}

/// Weights of the neighbours.
#[derive(clap::ValueEnum, Clone, Copy)]
pub(crate) enum WeightsArg {
    /// All alike
    Uniform,
    /// More at vertices of many triangles, less at those of few, smooth between them
    Adaptive,
}

impl From<WeightsArg> for Weights {
    fn from(weights: WeightsArg) -> Self {
        match weights {
            WeightsArg::Uniform => Self::Uniform,
            WeightsArg::Adaptive => Self::Adaptive,
        }
    }
}

#[derive(clap::Args)]
pub(crate) struct BaseArgs {
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    /// Where the base mesh goes; the extension says in which format
    #[arg(short, long, value_name = "BASE")]
    pub(crate) output: PathBuf,
}

#[derive(clap::Args)]
pub(crate) struct StagesArgs {
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    /// The folder for a picture (PNG) and a coloured mesh (PLY) of every stage, and the charts (SVG)
    #[arg(long)]
    pub(crate) dir: PathBuf,
}

/// What every command takes that makes a base mesh.
#[derive(clap::Args)]
pub(crate) struct SourceArgs {
    /// The mesh to remesh: obj, ply, stl, off, gltf or glb, also compressed (.gz)
    pub(crate) input: PathBuf,
    /// Wanted number of base vertices [default: three times what corners and curves need, at least 1000 and 1.6 % of the input's, at
    /// most 2000]
    #[arg(long, value_name = "N", value_parser = base_vertices, allow_negative_numbers = true)]
    pub(crate) base_vertices: Option<u32>,
    /// An edge with at least this angle between its faces, in degrees, is a crease [default: 40]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    pub(crate) crease_angle: Option<f64>,
    /// An edge with at least this angle goes on from the loose end of a crease [default: 25, at most the crease angle]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    pub(crate) weak_angle: Option<f64>,
    /// Edges to keep whatever their angle: the lines of this file (`l` of an obj, `edge` of a ply) between places of input vertices
    #[arg(long, value_name = "FILE")]
    pub(crate) marked_edges: Option<PathBuf>,
    /// How results are made [default: best]
    #[arg(long, value_name = "METHOD", value_enum, default_value_t = MethodArg::Best, hide_default_value = true)]
    pub(crate) method: MethodArg,
    /// Seed of all that is chosen at random
    #[arg(long, value_name = "S", default_value_t = 0, value_parser = seed, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// Number of threads; the result does not depend on it [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub(crate) threads: Option<u16>,
    /// Write over the input, or another file that is read
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) talk: Talk,
}

/// How results are made.
#[derive(clap::ValueEnum, Clone, Copy)]
pub(crate) enum MethodArg {
    /// The way that promises more; the other one where its result is not right
    Best,
    /// Sites of patches, triangulated in charts, alone
    Patches,
    /// Decimation alone
    Decimation,
    /// The paper's pipeline as it is printed, from the patches to its relaxation, for comparison
    Paper,
}

impl From<MethodArg> for Method {
    fn from(method: MethodArg) -> Self {
        match method {
            MethodArg::Best => Self::Best,
            MethodArg::Patches => Self::Patches,
            MethodArg::Decimation => Self::Decimation,
            MethodArg::Paper => Self::Paper(PaperOptions::default()),
        }
    }
}

/// How much a command says.
#[derive(clap::Args, Clone, Copy)]
pub(crate) struct Talk {
    /// Print one JSON object: the report, or what went wrong
    #[arg(long)]
    pub(crate) json: bool,
    /// Print all figures, and a line for each stage when it begins (on a terminal, a bar shows that anyway)
    #[arg(short, long, conflicts_with = "quiet")]
    pub(crate) verbose: bool,
    /// Print nothing but errors, and what --json prints
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(clap::Args)]
pub(crate) struct InspectArgs {
    /// The mesh: obj, ply, stl, off, gltf or glb, also compressed (.gz)
    pub(crate) input: PathBuf,
    #[command(flatten)]
    pub(crate) talk: Talk,
}

#[derive(clap::Args)]
pub(crate) struct CompareArgs {
    /// The original; lengths are measured by the diagonal of its box
    pub(crate) a: PathBuf,
    /// The mesh that stands for it
    pub(crate) b: PathBuf,
    #[command(flatten)]
    pub(crate) talk: Talk,
}

#[derive(clap::Args)]
pub(crate) struct CheckArgs {
    /// A mesh in a format that keeps the order of vertices: any but stl
    pub(crate) file: PathBuf,
    /// Subdivision levels that it shall have
    #[arg(long, value_name = "L", default_value_t = Options::default().levels, value_parser = levels, allow_negative_numbers = true)]
    pub(crate) levels: u32,
    /// Triangles without area are told, but no fault: for a base mesh, which is judged by its connectivity
    #[arg(long)]
    pub(crate) connectivity: bool,
    #[command(flatten)]
    pub(crate) talk: Talk,
}

fn levels(text: &str) -> Result<u32, String> {
    whole(text, 0..=8).map(|n| n as u32)
}

fn base_vertices(text: &str) -> Result<u32, String> {
    whole(text, 1..=u32::MAX.into()).map(|n| n as u32)
}

fn threads(text: &str) -> Result<u16, String> {
    whole(text, 1..=1024).map(|n| n as u16)
}

fn iterations(text: &str) -> Result<u32, String> {
    whole(text, 0..=1_000_000).map(|n| n as u32)
}

fn quality(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(quality) if (0.0..=1.0).contains(&quality) => Ok(quality),
        _ => Err("a quality from 0 to 1 is needed".to_owned()),
    }
}

fn seed(text: &str) -> Result<u64, String> {
    whole(text, 0..=u64::MAX)
}

fn whole(text: &str, range: RangeInclusive<u64>) -> Result<u64, String> {
    let needed = || format!("a whole number from {} to {} is needed", range.start(), range.end());
    text.parse().ok().filter(|n| range.contains(n)).ok_or_else(needed)
}

fn degrees(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(angle) if angle > 0.0 && angle < 180.0 => Ok(angle),
        _ => Err("an angle between 0 and 180 degrees is needed".to_owned()),
    }
}

impl Command {
    /// Whether the user wants JSON.
    pub(crate) fn json(&self) -> bool {
        let talk = match self {
            Self::Remesh(args) => args.source.talk,
            Self::Base(args) => args.source.talk,
            Self::Stages(args) => args.source.talk,
            Self::Inspect(args) => args.talk,
            Self::Compare(args) => args.talk,
            Self::Check(args) => args.talk,
        };
        talk.json
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    #[test]
    fn the_definition_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn numbers_out_of_range_are_told_the_range() {
        for (option, value, range) in [
            ("--levels", "-1", "from 0 to 8"),
            ("--levels", "9", "from 0 to 8"),
            ("--base-vertices", "-5", "from 1 to 4294967295"),
            ("--threads", "-2", "from 1 to 1024"),
            ("--seed", "-1", "from 0 to"),
            ("--target-quality", "1.5", "from 0 to 1"),
            ("--relax-iterations", "-1", "from 0 to 1000000"),
            ("--crease-angle", "-10", "between 0 and 180 degrees"),
        ] {
            let said =
                Args::try_parse_from(["semireg", "remesh", "a.obj", "-o", "b.obj", option, value]).err().unwrap().to_string();
            assert!(said.contains(&format!("'{value}' for '{option}")) && said.contains(range), "{said}");
        }
    }
}
