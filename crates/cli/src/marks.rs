//! Edges of the input that its attributes mark: hard edges, seams of textures, borders of materials.

use crate::args::MakingArgs;
use crate::failure::{Failure, Kind};
use crate::kept::{FeaturesArg, KeepArg};
use crate::stream;
use attributes::Source;
use glam::DVec3;
use mesh_core::{Cleaned, EdgeId, IdVec};
use mesh_io::{Attributes, Document};
use semireg::Options;

/// Normals on both sides of an edge are the same if their coordinates differ by no more: about 1 degree.
const SAME_NORMAL: f64 = 0.02;
/// Texture coordinates on both sides of an edge are the same if they differ by no more: the rounding of f32, far below a pixel.
pub(crate) const SAME_UV: f64 = 1e-6;

/// Which edges of the input to keep.
pub(crate) struct Marks {
    pub(crate) features: FeaturesArg,
    seams: bool,
    materials: bool,
}

impl Marks {
    /// What the user asked for.
    pub(crate) fn asked(args: &MakingArgs) -> Self {
        let keeps = |what| args.keep.contains(&what);
        Self { features: args.features, seams: keeps(KeepArg::Seams), materials: keeps(KeepArg::Materials) }
    }

    /// Names of what is kept on request.
    pub(crate) fn kept(&self) -> Vec<&'static str> {
        [("seams", self.seams), ("materials", self.materials)]
            .iter()
            .filter(|(_, is_kept)| *is_kept)
            .map(|(name, _)| *name)
            .collect()
    }

    /// The options with the marked edges that a file asks for. Fails where it has nothing of the kind.
    pub(crate) fn added_to(&self, options: &Options, document: &Document, from: &stream::Source) -> anyhow::Result<Options> {
        let mut options = options.clone();
        if self.features != FeaturesArg::Normals && !self.seams && !self.materials {
            return Ok(options);
        }
        self.check(&document.attributes, from)?;
        // The same cleaning comes again in the run; its vertices are where these are.
        let cleaned = mesh_core::clean(&document.soup, &options.clean)?;
        options.marked_edges.extend(self.edges(document, &cleaned));
        Ok(options)
    }

    fn check(&self, attributes: &Attributes, from: &stream::Source) -> Result<(), Failure> {
        let has_hard_edges = !attributes.normals.is_empty() || !attributes.smoothing.is_empty();
        let needs = [
            (self.features == FeaturesArg::Normals, has_hard_edges, "--features normals", "normals or smoothing groups"),
            (self.seams, !attributes.uvs.is_empty(), "--keep seams", "texture coordinates"),
            (self.materials, !attributes.materials.is_empty(), "--keep materials", "materials"),
        ];
        match needs.iter().find(|(is_asked, is_there, ..)| *is_asked && !is_there) {
            Some((_, _, option, what)) => {
                let message = format!("{} has no {what}; leave {option} out, or give a file that has them", from);
                Err(Failure::new(Kind::Marks, message))
            }
            None => Ok(()),
        }
    }

    fn edges(&self, document: &Document, cleaned: &Cleaned) -> Vec<[DVec3; 2]> {
        let (source, attributes) = (Source::new(&document.soup, cleaned), &document.attributes);
        let mut edges = Vec::new();
        if self.features == FeaturesArg::Normals {
            edges.extend(source.ends_of(&hard_edges(&source, attributes)));
        }
        if self.seams {
            attributes.uvs.iter().for_each(|layer| edges.extend(source.ends_of(&source.seams(&arrays(layer), SAME_UV))));
        }
        if self.materials {
            edges.extend(source.ends_of(&source.label_borders(&attributes.materials.of_face)));
        }
        edges
    }
}

/// Edges that the normals of the file make hard; its smoothing groups where it has no normals.
fn hard_edges(source: &Source, attributes: &Attributes) -> IdVec<EdgeId, bool> {
    if attributes.normals.is_empty() {
        return source.group_borders(&attributes.smoothing);
    }
    let unit: Vec<[[f64; 3]; 3]> = attributes.normals.iter().map(|t| t.map(|n| n.normalize_or(n).to_array())).collect();
    source.seams(&unit, SAME_NORMAL)
}

/// Texture coordinates as plain arrays.
pub(crate) fn arrays(layer: &[[glam::DVec2; 3]]) -> Vec<[[f64; 2]; 3]> {
    layer.iter().map(|t| t.map(|uv| uv.to_array())).collect()
}
