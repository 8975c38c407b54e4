//! Linear 1-to-4 subdivision of a base mesh, any number of times, that keeps the region map (paper, section 4.1).
//!
//! Index arithmetic only: child faces of face `f = (a, b, c)` are `4f..4f+3` = `(a, ab, ca) (b, bc, ab) (c, ca, bc) (bc, ca, ab)`,
//! and the vertices of a level are a prefix of those of the next. A midpoint of an edge on an arc is on that arc, of any other edge
//! in the sheet of its face (two end points do not decide: two corners may be joined across a sheet).

mod subdivide;

pub use subdivide::{SubdivDomain, SubdivError, subdivide};
