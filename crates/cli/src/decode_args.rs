//! The options of `semireg decode`.

use crate::number::levels;
use crate::stream::{Target, check_meant, is_stream};
use crate::stream_args::formats;
use crate::talk::Talk;
use mesh_io::Format;
use std::path::PathBuf;

#[derive(clap::Args)]
pub(crate) struct DecodeArgs {
    /// The folder that `remesh --displacement` wrote
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Where the mesh goes; the extension says in which format. `-` for standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// The format of standard output, which `-` stands for
    #[arg(long, value_parser = formats())]
    pub(crate) format: Option<Format>,
    /// The level that is decoded: 0 is the base mesh [default: the finest]
    #[arg(long, value_name = "K", value_parser = levels, allow_negative_numbers = true)]
    pub(crate) level: Option<u32>,
    /// Displace every vertex along a normal alone: smaller data, less exact
    #[arg(long)]
    pub(crate) no_residual: bool,
    /// Write over a file of DIR
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    talk: Talk,
}

impl DecodeArgs {
    pub(crate) fn talk(&self) -> Talk {
        Talk { on_stderr: is_stream(&self.output), ..self.talk }
    }

    pub(crate) fn target(&self) -> Result<Target, crate::failure::Failure> {
        check_meant("--format", self.format, is_stream(&self.output))?;
        Target::new(&self.output, self.format)
    }
}
