//! What is tried to come to a certified result, as data.

use crate::base::Way;
use crate::verdict::Verdict;
use std::fmt;

/// One try on the way to a result.
#[derive(Clone, Debug)]
pub struct Attempt {
    /// What was tried.
    pub remedy: Remedy,
    /// The way that made the base mesh; `None` where there is none.
    pub way: Option<Way>,
    /// What it came to.
    pub verdict: Verdict,
    /// Wall time in seconds.
    pub seconds: f64,
}

/// What is tried where a result is not yet right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Remedy {
    /// Nothing: the base mesh as it was asked for.
    AsAsked,
    /// The base mesh of the other way, with the same setting.
    OtherBase,
    /// A base mesh with so many times the vertices.
    MoreVertices(f64),
    /// A base mesh on more of the creases.
    MoreCreases,
    /// A base mesh with so many times the vertices, on fewer of the creases.
    FewerCreases(f64),
    /// The surroundings of faulty triangles relaxed by themselves, as far as so many base edges.
    RelaxPlaces(f64),
    /// Vertices beside faulty triangles moved to places that the certificate accepts.
    Nudge,
    /// Edges of the base mesh bisected under faulty triangles, or where the input is missed.
    BisectBase(EdgeChoice),
    /// The creases beside faulty triangles let go of.
    ReleaseCreases,
    /// Finest edges snapped to bends and minor creases.
    Snap,
    /// The same, without the bends and creases beside triangles that did not bear it.
    LetGoCreases,
    /// The least-squares fit.
    Fit,
    /// The fit, with the triangles held that it turned over before.
    HoldFaces,
    /// No fit: the vertices stay on the surface.
    LeaveUnfitted,
}

/// Which edge of the base face under a triangle is bisected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeChoice {
    /// The longest.
    Longest,
    /// The longest of those that end at the base vertex of the triangle, if it has one.
    AtTip,
    /// The shortest.
    Shortest,
    /// The longest of those on arcs, if it has any; else the longest.
    OnArc,
}

impl Remedy {
    /// Whether it begins anew with another base mesh; all others go on with the one that there is.
    pub fn makes_a_base(self) -> bool {
        matches!(self, Self::AsAsked | Self::OtherBase | Self::MoreVertices(_) | Self::MoreCreases | Self::FewerCreases(_))
    }
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AsAsked => write!(f, "as asked"),
            Self::OtherBase => write!(f, "with the base mesh of the other way"),
            Self::MoreVertices(factor) => write!(f, "with {factor} times the base vertices"),
            Self::MoreCreases => write!(f, "with more creases"),
            Self::FewerCreases(factor) => write!(f, "with {factor} times the base vertices and fewer creases"),
            Self::RelaxPlaces(reach) => write!(f, "faulty places relaxed as far as {reach} base edges"),
            Self::Nudge => write!(f, "vertices beside faulty triangles moved"),
            Self::BisectBase(EdgeChoice::Longest) => write!(f, "longest base edges bisected under faulty triangles"),
            Self::BisectBase(EdgeChoice::AtTip) => write!(f, "base edges at the tips of faulty triangles bisected"),
            Self::BisectBase(EdgeChoice::Shortest) => write!(f, "shortest base edges bisected under faulty triangles"),
            Self::BisectBase(EdgeChoice::OnArc) => write!(f, "base edges bisected where the input is missed"),
            Self::ReleaseCreases => write!(f, "creases beside faulty triangles let go of"),
            Self::Snap => write!(f, "snapped to bends and minor creases"),
            Self::LetGoCreases => write!(f, "snapped without the creases beside poor triangles"),
            Self::Fit => write!(f, "fitted"),
            Self::HoldFaces => write!(f, "fitted with held triangles"),
            Self::LeaveUnfitted => write!(f, "left without the fit"),
        }
    }
}
