//! Options of snapping.

/// Which bends and creases are worth it, and what they may cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SnapOptions {
    /// An arc has a bend where it leaves the edge along it by more than this, as a share of the diagonal of the surface's box.
    /// Default 8e-4: less than the distance within which the certificate takes a crease for covered.
    pub bend: f64,
    /// Pieces of minor creases shorter than this, in mean edge lengths of the domain, are left. Default 3.
    pub least_length: f64,
    /// A piece that turns more than this an edge length (degrees, in the mean) is left: edges cannot follow it. Default 15.
    /// Measured: those of casting and mechpart turn by 3 to 10, of chinese_lion and spot by 9 to 15, the noise of kitten,
    /// rocker-arm and igea by 24 and more.
    pub most_turn: f64,
    /// A piece is left unless its mean distance from the domain is more than this many times the median distance of the surface
    /// from the domain: a crease that is nearer is not lost. Default 3. Measured medians: 7 of pensatore, camelhead and casting,
    /// 2.8 of chinese_lion, 2 of noisy scans. Without it chinese_lion has AR .950, mean error 8.57e-5 and cover .67, with it
    /// .961, 8.68e-5 and .59; pensatore and casting stay the same, the noisy fixture organic_raw has .934 instead of .921.
    pub least_depth: f64,
    /// Edges that a person sees as sharp are followed in pieces of this length and more, in mean edge lengths of the domain, whatever their distance from
    /// the domain. Default 1.
    pub seen_length: f64,
    /// A piece of them that turns more than this an edge length (degrees, in the mean) is left. Default 30.
    pub seen_turn: f64,
    /// Where a minor crease turns by more than this at a vertex (degrees), it is cut in pieces there. Default 50.
    pub sharp_turn: f64,
    /// A triangle beside a bend or piece is poor when its quality (AR) is less than this, and than before. Default 0.3. Measured
    /// with 0.3 and 0.5: chinese_lion has AR .950 and .954, a crease cover of .67 and .63; casting .858 and .858, .982 and .974.
    pub least_quality: f64,
}

impl Default for SnapOptions {
    fn default() -> Self {
        Self {
            bend: 8e-4,
            least_length: 3.0,
            most_turn: 15.0,
            least_depth: 3.0,
            seen_length: 1.0,
            seen_turn: 30.0,
            sharp_turn: 50.0,
            least_quality: 0.3,
        }
    }
}

impl SnapOptions {
    /// The rules for edges that a person sees as sharp, in the place of those for all.
    pub(crate) fn for_seen(self) -> Self {
        Self { least_length: self.seen_length, most_turn: self.seen_turn, least_depth: 0.0, ..self }
    }
}
