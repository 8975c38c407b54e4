//! The command line as the user types it.

use crate::decode_args::DecodeArgs;
use crate::goal_args::GoalArgs;
use crate::kept::{FeaturesArg, KeepArg};
use crate::number::{amount, base_vertices, bits, degrees, levels, seed, slope, threads, variants};
use crate::relaxation_args::RelaxationArgs;
use crate::shard::Shard;
use crate::stream::is_stream;
use crate::stream_args::{InputStreamArgs, StreamArgs, formats};
use crate::talk::Talk;
use clap::{Parser, Subcommand};
use mesh_io::Format;
use semireg::{FaceOrder, Method, USUAL_LEVELS};
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
    /// Remesh many files, each in a process of its own, with a line for each in OUT/results.jsonl
    Batch(BatchArgs),
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
    /// Make a mesh of the displacements that `remesh --displacement` wrote
    Decode(DecodeArgs),
}

#[derive(clap::Args)]
pub(crate) struct RemeshArgs {
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    /// Where the result goes; the extension says in which format. `-` for standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) streams: StreamArgs,
    #[command(flatten)]
    pub(crate) result: ResultArgs,
    #[command(flatten)]
    pub(crate) outputs: OutputArgs,
    /// A base mesh of your own to subdivide, in any format: a manifold of the input's topology, near its surface
    #[arg(long, value_name = "FILE", conflicts_with_all = ["base_vertices", "goal"])]
    pub(crate) base: Option<PathBuf>,
    /// Leave a picture (PNG) and a coloured mesh (PLY) of every stage in this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) stages: Option<PathBuf>,
    /// End without a result when standard input ends: so `batch` starts its processes, that none outlives it
    #[arg(long, hide = true)]
    pub(crate) end_with_stdin: bool,
}

/// How a result is made on its base mesh, whatever the input: what `remesh` and `batch` both take.
#[derive(clap::Args)]
pub(crate) struct ResultArgs {
    #[command(flatten)]
    pub(crate) goal: GoalArgs,
    /// How often every base triangle is split in four [default: 2; 1 where the shape takes very many base vertices; what suits a size that is asked for]
    #[arg(long, value_name = "L", value_parser = levels, allow_negative_numbers = true)]
    pub(crate) levels: Option<u32>,
    /// Leave the vertices on the surface, instead of where the triangles between them come closest to it
    #[arg(long)]
    pub(crate) no_fit: bool,
    /// Write positions and triangles alone: no normals, no feature curves, nothing of what the input has beside
    #[arg(long)]
    pub(crate) plain: bool,
    #[command(flatten)]
    pub(crate) relaxation: RelaxationArgs,
}

#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("files").required(true).multiple(false))]
pub(crate) struct BatchArgs {
    /// The meshes, and folders of them, which are searched with all folders inside
    #[arg(group = "files")]
    pub(crate) inputs: Vec<PathBuf>,
    /// A file with the path of a mesh in every line; `-` for standard input
    #[arg(long, value_name = "FILE", group = "files")]
    pub(crate) list: Option<PathBuf>,
    /// The folder for the results, named as the inputs below the folder that holds all of these, and for results.jsonl
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// The format of the results
    #[arg(long, value_parser = formats(), default_value = Format::Obj.extension())]
    pub(crate) format: Format,
    /// Number of files that are remeshed at the same time [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub(crate) jobs: Option<u16>,
    /// Number of threads for each file; results do not depend on it [default: the processors over the jobs]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub(crate) threads: Option<u16>,
    /// A file that takes longer than this is given up [default: no limit]
    #[arg(long, value_name = "SECONDS", value_parser = amount, allow_negative_numbers = true)]
    pub(crate) timeout: Option<f64>,
    /// A file that takes more memory than this, in GiB, is given up [default: no limit]
    #[arg(long, value_name = "GIB", value_parser = amount, allow_negative_numbers = true)]
    pub(crate) memory: Option<f64>,
    /// Go on with a batch that was ended: files that have a line in results.jsonl are left out
    #[arg(long, conflicts_with = "force")]
    pub(crate) resume: bool,
    /// Begin anew where there is a results.jsonl already, which is lost
    #[arg(long)]
    pub(crate) force: bool,
    /// Part I of N: every N-th file from the I-th on. Its lines go to results-I-of-N.jsonl, so that several machines can share OUT
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,
    #[command(flatten)]
    pub(crate) making: MakingArgs,
    #[command(flatten)]
    pub(crate) result: ResultArgs,
    #[command(flatten)]
    pub(crate) talk: Talk,
}

/// What is written of a result.
#[derive(clap::Args, Clone, Debug, Default)]
pub(crate) struct OutputArgs {
    /// Write level K of the result in the place of the finest: 0 is the base mesh, L the finest
    #[arg(long, value_name = "K", value_parser = levels, allow_negative_numbers = true, conflicts_with = "all_levels")]
    pub(crate) level: Option<u32>,
    /// Write every level, too: beside out.obj the files out.0.obj (the base mesh), out.1.obj and so on; gltf and glb hold all in one file
    #[arg(long)]
    pub(crate) all_levels: bool,
    /// Write where everything of OUTPUT is on the input, and the other way round, to this file, an npz for numpy
    #[arg(long, value_name = "FILE")]
    pub(crate) map: Option<PathBuf>,
    /// Write the base mesh and the displacements of all levels into this folder: arrays for numpy, and the base mesh as usda and glb
    #[arg(long, value_name = "DIR")]
    pub(crate) displacement: Option<PathBuf>,
    /// Quantise displacements to N bits each [default: as they are]
    #[arg(long, value_name = "N", value_parser = bits, allow_negative_numbers = true, requires = "displacement")]
    pub(crate) displacement_bits: Option<u8>,
    /// Order of the faces of each level [default: children]
    #[arg(long, value_name = "ORDER", value_enum, default_value_t = OrderArg::Children, hide_default_value = true)]
    pub(crate) order: OrderArg,
    /// Make K results on different base meshes, by the seeds from --seed on: out-0.obj, out-1.obj and so on, numbered by seed
    #[arg(long, value_name = "K", value_parser = variants, allow_negative_numbers = true, conflicts_with_all = ["base", "stages"])]
    pub(crate) variants: Option<u32>,
}

/// Order of the faces of a level.
#[derive(clap::ValueEnum, Clone, Copy, Debug, Default)]
pub(crate) enum OrderArg {
    /// The children of face f are 4f to 4f + 3
    #[default]
    Children,
    /// Of 4F faces, the children of face f are f, f + F, f + 2F and f + 3F, as SubdivNet pools
    Subdivnet,
}

impl From<OrderArg> for FaceOrder {
    fn from(order: OrderArg) -> Self {
        match order {
            OrderArg::Children => Self::Children,
            OrderArg::Subdivnet => Self::SubdivNet,
        }
    }
}

#[derive(clap::Args)]
pub(crate) struct BaseArgs {
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    /// Where the base mesh goes; the extension says in which format. `-` for standard output
    #[arg(short, long, value_name = "BASE")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) streams: StreamArgs,
}

#[derive(clap::Args)]
pub(crate) struct StagesArgs {
    #[command(flatten)]
    pub(crate) source: SourceArgs,
    /// The folder for a picture (PNG) and a coloured mesh (PLY) of every stage, and the charts (SVG)
    #[arg(long)]
    pub(crate) dir: PathBuf,
    #[command(flatten)]
    pub(crate) stream: InputStreamArgs,
}

/// What every command takes that makes a base mesh.
#[derive(clap::Args)]
pub(crate) struct SourceArgs {
    /// The mesh to remesh: obj, ply, stl, off, gltf or glb, also compressed (.gz). `-` for standard input
    pub(crate) input: PathBuf,
    #[command(flatten)]
    pub(crate) making: MakingArgs,
    /// Edges to keep whatever their angle: the lines of this file (`l` of an obj, `edge` of a ply) between places of input vertices
    #[arg(long, value_name = "FILE")]
    pub(crate) marked_edges: Option<PathBuf>,
    /// Where base vertices shall be denser: a number above 0 for each vertex of the input, as the property `density` of a ply, or as an npy
    #[arg(long, value_name = "FILE")]
    pub(crate) density: Option<PathBuf>,
    /// Number of threads; the result does not depend on it [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub(crate) threads: Option<u16>,
    /// Write over the input, or another file that is read
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) talk: Talk,
}

/// How a base mesh is made, whatever the input: what all commands take that make one.
#[derive(clap::Args)]
pub(crate) struct MakingArgs {
    /// Wanted number of base vertices [default: three times what corners and curves need, at least 1000 and 1.6 % of the input's, at
    /// most 2000; with one level up to 8000]
    #[arg(long, value_name = "N", value_parser = base_vertices, allow_negative_numbers = true)]
    pub(crate) base_vertices: Option<u32>,
    /// An edge with at least this angle between its faces, in degrees, is a crease; 180 finds none [default: 40]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    pub(crate) crease_angle: Option<f64>,
    /// An edge with at least this angle goes on from the loose end of a crease [default: 25, at most the crease angle]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    pub(crate) weak_angle: Option<f64>,
    /// What is kept beside borders and marked edges [default: creases]
    #[arg(long, value_name = "WHICH", value_enum, default_value_t = FeaturesArg::Creases, hide_default_value = true)]
    pub(crate) features: FeaturesArg,
    /// Keep the edges where these end, as marked edges
    #[arg(long, value_name = "WHAT", value_enum, value_delimiter = ',')]
    pub(crate) keep: Vec<KeepArg>,
    /// Split triangles where the border beside has vertices on their edges (T-vertices), so that the surface is closed there
    #[arg(long)]
    pub(crate) close_t_vertices: bool,
    /// How fast lengths of base edges change along the surface, per length: 0 for edges of one length [default: 0.3]
    #[arg(long, value_name = "G", value_parser = slope, allow_negative_numbers = true)]
    pub(crate) gradation: Option<f64>,
    /// How base meshes are made [default: best]
    #[arg(long, value_name = "METHOD", value_enum, default_value_t = MethodArg::Best, hide_default_value = true)]
    pub(crate) method: MethodArg,
    /// Seed of all that is chosen at random
    #[arg(long, value_name = "S", default_value_t = 0, value_parser = seed, allow_negative_numbers = true)]
    pub(crate) seed: u64,
}

/// How base meshes are made.
#[derive(clap::ValueEnum, Clone, Copy)]
pub(crate) enum MethodArg {
    /// The way that promises more; the other one where its result is not right
    Best,
    /// Sites of patches, triangulated in charts, alone
    Patches,
    /// Decimation alone
    Decimation,
    /// The paper's patches and triangulation as they are printed, for comparison; its relaxation as well, unless another is asked for
    Paper,
}

impl From<MethodArg> for Method {
    fn from(method: MethodArg) -> Self {
        match method {
            MethodArg::Best => Self::Best,
            MethodArg::Patches => Self::Patches,
            MethodArg::Decimation => Self::Decimation,
            MethodArg::Paper => Self::Paper,
        }
    }
}

#[derive(clap::Args)]
pub(crate) struct InspectArgs {
    /// The mesh: obj, ply, stl, off, gltf or glb, also compressed (.gz). `-` for standard input
    pub(crate) input: PathBuf,
    #[command(flatten)]
    pub(crate) stream: InputStreamArgs,
    #[command(flatten)]
    pub(crate) talk: Talk,
}

#[derive(clap::Args)]
pub(crate) struct CompareArgs {
    /// The original; lengths are measured by the diagonal of its box. `-` for standard input
    pub(crate) a: PathBuf,
    /// The mesh that stands for it. `-` for standard input
    pub(crate) b: PathBuf,
    #[command(flatten)]
    pub(crate) stream: InputStreamArgs,
    #[command(flatten)]
    pub(crate) talk: Talk,
}

#[derive(clap::Args)]
pub(crate) struct CheckArgs {
    /// A mesh in a format that keeps the order of vertices: any but stl. `-` for standard input
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) stream: InputStreamArgs,
    /// Subdivision levels that it shall have
    #[arg(long, value_name = "L", default_value_t = USUAL_LEVELS, value_parser = levels, allow_negative_numbers = true)]
    pub(crate) levels: u32,
    /// Triangles without area are told, but no fault: for a base mesh, which is judged by its connectivity
    #[arg(long)]
    pub(crate) connectivity: bool,
    /// Order in which its faces are [default: children]
    #[arg(long, value_name = "ORDER", value_enum, default_value_t = OrderArg::Children, hide_default_value = true)]
    pub(crate) order: OrderArg,
    #[command(flatten)]
    pub(crate) talk: Talk,
}

impl Command {
    /// How much the user wants to hear, and where.
    pub(crate) fn talk(&self) -> Talk {
        match self {
            Self::Remesh(args) => args.talk(),
            Self::Batch(args) => args.talk,
            Self::Base(args) => args.talk(),
            Self::Stages(args) => args.source.talk,
            Self::Inspect(args) => args.talk,
            Self::Compare(args) => args.talk,
            Self::Check(args) => args.talk,
            Self::Decode(args) => args.talk(),
        }
    }
}

impl RemeshArgs {
    pub(crate) fn talk(&self) -> Talk {
        Talk { on_stderr: is_stream(&self.output), ..self.source.talk }
    }
}

impl BaseArgs {
    pub(crate) fn talk(&self) -> Talk {
        Talk { on_stderr: is_stream(&self.output), ..self.source.talk }
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
    fn a_size_is_asked_for_once() {
        let parsed = |options: &[&str]| Args::try_parse_from([&["semireg", "remesh", "a.obj", "-o", "b.obj"], options].concat());
        assert!(parsed(&["--vertices", "9000", "--levels", "3"]).is_ok());
        for twice in [
            ["--vertices=9000", "--triangles=9000"],
            ["--base-vertices=900", "--edge-length=1"],
            ["--max-error=.01", "--max-error-length=1"],
            ["--base=c.obj", "--vertices=900"],
        ] {
            let said = parsed(&twice).err().unwrap().to_string();
            assert!(said.contains("cannot be used with"), "{said}");
        }
    }

    #[test]
    fn numbers_out_of_range_are_told_the_range() {
        for (option, value, range) in [
            ("--levels", "-1", "from 0 to 8"),
            ("--levels", "9", "from 0 to 8"),
            ("--base-vertices", "-5", "from 1 to 4294967295"),
            ("--variants", "0", "from 1 to 1000"),
            ("--level", "9", "from 0 to 8"),
            ("--displacement-bits", "25", "from 2 to 24"),
            ("--threads", "-2", "from 1 to 1024"),
            ("--seed", "-1", "from 0 to"),
            ("--vertices", "3", "from 4 to"),
            ("--triangles", "60000000", "from 4 to 50000000"),
            ("--edge-length", "0", "a length above 0"),
            ("--max-error-length", "inf", "a length above 0"),
            ("--gradation", "-1", "a number from 0 on"),
            ("--max-error", "1.5", "a share above 0 and below 1"),
            ("--target-quality", "1.5", "from 0 to 1"),
            ("--relax-iterations", "-1", "from 0 to 1000000"),
            ("--crease-angle", "-10", "at most 180 degrees"),
        ] {
            let said =
                Args::try_parse_from(["semireg", "remesh", "a.obj", "-o", "b.obj", option, value]).err().unwrap().to_string();
            assert!(said.contains(&format!("'{value}' for '{option}")) && said.contains(range), "{said}");
        }
    }
}
