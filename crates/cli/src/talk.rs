//! How much is said, and where.

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
    /// The mesh goes to standard output, and all that is said to standard error.
    #[arg(skip)]
    pub(crate) on_stderr: bool,
}
