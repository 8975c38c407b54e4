//! The options that say how large a result shall be, or how near to the input.

use crate::number::{count, fraction, length};
use semireg::{Goal, Target};

/// At most one of these; without, and without `--base-vertices`, a result is as large as its shape takes.
#[derive(clap::Args, Clone, Copy, Default)]
#[group(id = "goal", multiple = false, conflicts_with = "base_vertices")]
pub(crate) struct GoalArgs {
    /// Vertices of the result, within 3 %: base vertices and, without --levels, levels are chosen
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub(crate) vertices: Option<u32>,
    /// Triangles of the result, within 3 %: base vertices and, without --levels, levels are chosen
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub(crate) triangles: Option<u32>,
    /// Mean length of the edges of the result, in the units of the mesh, within 5 %
    #[arg(long, value_name = "LENGTH", value_parser = length, allow_negative_numbers = true)]
    pub(crate) edge_length: Option<f64>,
    /// The smallest result that is nowhere farther from the input than this share of its diagonal; several are tried
    #[arg(long, value_name = "SHARE", value_parser = fraction, allow_negative_numbers = true)]
    pub(crate) max_error: Option<f64>,
    /// The same in the units of the mesh
    #[arg(long, value_name = "LENGTH", value_parser = length, allow_negative_numbers = true)]
    pub(crate) max_error_length: Option<f64>,
}

impl GoalArgs {
    /// What is asked for, if any of it is, with this number of levels.
    pub(crate) fn goal(self, levels: Option<u32>) -> Option<Goal> {
        let targets = [
            self.vertices.map(|n| Target::Vertices(n as usize)),
            self.triangles.map(|n| Target::Triangles(n as usize)),
            self.edge_length.map(Target::EdgeLength),
            self.max_error.map(Target::MaxError),
            self.max_error_length.map(Target::MaxErrorLength),
        ];
        targets.into_iter().flatten().next().map(|target| Goal { target, levels })
    }
}
