//! The options that tell the formats of what goes through `-`.

use crate::failure::{Failure, Kind};
use crate::stream::{Source, Target, check_meant, is_stream};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use mesh_io::Format;
use std::path::Path;

/// The formats of what goes through `-`.
#[derive(clap::Args, Clone, Copy)]
pub(crate) struct StreamArgs {
    /// The format of what goes through `-`
    #[arg(long, value_parser = formats())]
    pub(crate) format: Option<Format>,
    /// The format of standard input, where it is not that of --format
    #[arg(long, value_name = "FORMAT", value_parser = formats())]
    pub(crate) input_format: Option<Format>,
}

/// The format of what comes through `-`.
#[derive(clap::Args, Clone, Copy)]
pub(crate) struct InputStreamArgs {
    /// The format of standard input, which `-` stands for
    #[arg(long, value_parser = formats())]
    pub(crate) format: Option<Format>,
}

/// The file formats by their extensions.
pub(crate) fn formats() -> impl TypedValueParser<Value = Format> {
    let known = PossibleValuesParser::new(Format::ALL.map(Format::extension));
    known.try_map(|name| Format::from_extension(&name).ok_or("no such format"))
}

impl StreamArgs {
    /// What is read and what is written.
    pub(crate) fn ends(self, input: &Path, output: &Path) -> Result<(Source, Target), Failure> {
        let Self { format, input_format } = self;
        let (reads, writes) = (is_stream(input), is_stream(output));
        check_meant("--input-format", input_format, reads)?;
        check_meant("--format", format, writes || reads && input_format.is_none())?;
        Ok((Source::new(input, input_format.or(format))?, Target::new(output, format)?))
    }
}

impl InputStreamArgs {
    /// What is read.
    pub(crate) fn source(self, input: &Path) -> Result<Source, Failure> {
        let format = self.format;
        check_meant("--format", format, is_stream(input))?;
        Source::new(input, format)
    }

    /// Two that are read, of which one at most can be standard input.
    pub(crate) fn two_sources(self, a: &Path, b: &Path) -> Result<[Source; 2], Failure> {
        let format = self.format;
        check_meant("--format", format, is_stream(a) || is_stream(b))?;
        if is_stream(a) && is_stream(b) {
            let message = "standard input cannot be both meshes; name a file for one of them";
            return Err(Failure::new(Kind::Usage, message));
        }
        Ok([Source::new(a, format)?, Source::new(b, format)?])
    }
}
