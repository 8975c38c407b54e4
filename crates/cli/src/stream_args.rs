//! The options that tell the formats of what goes through `-`.

use crate::failure::{Failure, Kind};
use crate::stream::{Source, Target, check_meant, is_stream};
use mesh_io::Format;
use std::path::Path;

/// The formats of what goes through `-`.
#[derive(clap::Args, Clone, Copy)]
pub(crate) struct StreamArgs {
    /// The format of what goes through `-`
    #[arg(long, value_enum)]
    pub(crate) format: Option<FormatArg>,
    /// The format of standard input, where it is not that of --format
    #[arg(long, value_name = "FORMAT", value_enum)]
    pub(crate) input_format: Option<FormatArg>,
}

/// The format of what comes through `-`.
#[derive(clap::Args, Clone, Copy)]
pub(crate) struct InputStreamArgs {
    /// The format of standard input, which `-` stands for
    #[arg(long, value_enum)]
    pub(crate) format: Option<FormatArg>,
}

/// The file formats by their extensions.
#[derive(clap::ValueEnum, Clone, Copy)]
pub(crate) enum FormatArg {
    Obj,
    Ply,
    Stl,
    Off,
    Gltf,
    Glb,
}

impl From<FormatArg> for Format {
    fn from(format: FormatArg) -> Self {
        match format {
            FormatArg::Obj => Self::Obj,
            FormatArg::Ply => Self::Ply,
            FormatArg::Stl => Self::Stl,
            FormatArg::Off => Self::Off,
            FormatArg::Gltf => Self::Gltf,
            FormatArg::Glb => Self::Glb,
        }
    }
}

impl StreamArgs {
    /// What is read and what is written.
    pub(crate) fn ends(self, input: &Path, output: &Path) -> Result<(Source, Target), Failure> {
        let [format, input_format] = [self.format, self.input_format].map(|format| format.map(Format::from));
        let (reads, writes) = (is_stream(input), is_stream(output));
        check_meant("--input-format", input_format, reads)?;
        check_meant("--format", format, writes || reads && input_format.is_none())?;
        Ok((Source::new(input, input_format.or(format))?, Target::new(output, format)?))
    }
}

impl InputStreamArgs {
    /// What is read.
    pub(crate) fn source(self, input: &Path) -> Result<Source, Failure> {
        let format = self.format.map(Format::from);
        check_meant("--format", format, is_stream(input))?;
        Source::new(input, format)
    }

    /// Two that are read, of which one at most can be standard input.
    pub(crate) fn two_sources(self, a: &Path, b: &Path) -> Result<[Source; 2], Failure> {
        let format = self.format.map(Format::from);
        check_meant("--format", format, is_stream(a) || is_stream(b))?;
        if is_stream(a) && is_stream(b) {
            let message = "standard input cannot be both meshes; name a file for one of them";
            return Err(Failure::new(Kind::Usage, message));
        }
        Ok([Source::new(a, format)?, Source::new(b, format)?])
    }
}
