//! What the finest level can follow.

/// Which bends and creases are worth it, and what they may cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SnapOptions {
    /// An arc has a bend where it leaves the edge along it by more than this, as a share of the diagonal of the surface's box.
    /// Default 8e-4: less than the distance within which the certificate takes a crease for covered.
    pub bend: f64,
    /// Nothing is snapped to unless the network keeps at least this share of the length of all creases, 0 to 1. Default 0.5.
    ///
    /// Else creases are noise, or shapes that no base vertex was spent on: spot and chinese_lion keep no crease at all. With 0 the
    /// cover of spot's creases rises from .19 to .65, and its mean AR falls from .969 to .959; chinese_lion's falls from .965 to
    /// .949.
    pub least_kept: f64,
    /// Pieces of minor creases shorter than this, in mean edge lengths of the domain, are left. Default 3.
    pub least_length: f64,
    /// A piece that turns more than this an edge length (degrees, in the mean) is left: edges cannot follow it. Default 15.
    /// Measured: those of casting and mechpart turn by 3 to 10, of chinese_lion and spot by 9 to 15, the noise of kitten,
    /// rocker-arm and igea by 24 and more.
    pub most_turn: f64,
    /// Where a minor crease turns by more than this at a vertex (degrees), it is cut in pieces there. Default 50.
    pub sharp_turn: f64,
    /// A triangle beside a bend or piece is poor when its quality (AR) is less than this, and than before. Default 0.4.
    pub least_quality: f64,
}

impl Default for SnapOptions {
    fn default() -> Self {
        Self { bend: 8e-4, least_kept: 0.5, least_length: 3.0, most_turn: 15.0, sharp_turn: 50.0, least_quality: 0.3 }
    }
}
