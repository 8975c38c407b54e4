//! The measures of `certify` under the names that the JSON has, and as lines for people.

use crate::print::Table;
use certify::{Measures, Quality, Stats, TopologyCounts};
use serde::Serialize;

/// Mean, root mean square and greatest of a distance, in parts of the original's diagonal.
#[derive(Serialize)]
pub(crate) struct Spread {
    mean: f64,
    rms: f64,
    max: f64,
}

impl From<Stats> for Spread {
    fn from(s: Stats) -> Self {
        Self { mean: s.mean, rms: s.rms, max: s.max }
    }
}

/// Counts of a mesh.
#[derive(Serialize)]
pub(crate) struct Counts {
    pub(crate) components: usize,
    pub(crate) euler: i64,
    pub(crate) border_loops: usize,
    pub(crate) border_edges: usize,
    pub(crate) nonmanifold_edges: usize,
    pub(crate) nonmanifold_vertices: usize,
    pub(crate) oriented: bool,
    /// Sum over the components; none for a mesh that is no oriented manifold.
    pub(crate) genus: Option<i64>,
}

impl From<TopologyCounts> for Counts {
    fn from(t: TopologyCounts) -> Self {
        // X = 2 C - 2 g - L
        let genus = (2 * t.components as i64 - t.border_loops as i64 - t.euler) / 2;
        Self {
            components: t.components,
            euler: t.euler,
            border_loops: t.border_loops,
            border_edges: t.border_edges,
            nonmanifold_edges: t.nonmanifold_edges,
            nonmanifold_vertices: t.nonmanifold_vertices,
            oriented: t.oriented,
            genus: (t.manifold() && t.oriented).then_some(genus),
        }
    }
}

impl Counts {
    /// As a part of a sentence.
    pub(crate) fn text(&self) -> String {
        let genus = self.genus.map_or(String::new(), |g| format!(", genus {g}"));
        let mut text =
            format!("{} components, {} border loops{genus}, Euler number {}", self.components, self.border_loops, self.euler);
        if self.nonmanifold_edges + self.nonmanifold_vertices > 0 {
            text += &format!(", {} edges and {} vertices not manifold", self.nonmanifold_edges, self.nonmanifold_vertices);
        }
        if !self.oriented {
            text += ", orientation not consistent";
        }
        text
    }
}

/// Shape of the triangles.
#[derive(Serialize)]
pub(crate) struct Shape {
    ar_mean: f64,
    ar_p01: f64,
    ar_min: f64,
    agl: f64,
    angle_min: f64,
    angle_max: f64,
    area_cv: f64,
    area_ratio: f64,
    degenerate: usize,
    irregular: f64,
}

impl From<&Quality> for Shape {
    fn from(q: &Quality) -> Self {
        Self {
            ar_mean: q.ar_mean,
            ar_p01: q.ar_p01,
            ar_min: q.ar_min,
            agl: q.agl,
            angle_min: q.angle_min,
            angle_max: q.angle_max,
            area_cv: q.area_cv,
            area_ratio: q.area_ratio,
            degenerate: q.degenerate,
            irregular: q.irregular(),
        }
    }
}

impl Shape {
    /// Appends the lines on shape.
    pub(crate) fn rows(&self, table: &mut Table) {
        let Self { ar_mean, ar_p01, ar_min, agl, angle_min, angle_max, area_cv, area_ratio, degenerate, irregular } = self;
        table.row("aspect ratio", format!("mean {ar_mean:.3}, 1st percentile {ar_p01:.3}, least {ar_min:.3} (1 = equilateral)"));
        table.row("angles", format!("{agl:.2} degrees off 60 in the mean (Agl), from {angle_min:.1} to {angle_max:.1}"));
        table.row("areas", format!("variation {area_cv:.3}, greatest over least {area_ratio:.1}"));
        table.row("irregular", format!("{:.2} % of the inner vertices have a valence other than 6", 100.0 * irregular));
        table.row("degenerate", format!("{degenerate} triangles"));
    }
}

/// All measures between an original and a mesh that stands for it.
#[derive(Serialize)]
pub(crate) struct Figures {
    vertices: usize,
    faces: usize,
    #[serde(flatten)]
    shape: Shape,
    err_mean: f64,
    err_rms: f64,
    err_max: f64,
    forward: Spread,
    backward: Spread,
    crease_cover: Option<f64>,
    crease_distance: Option<Spread>,
    border_distance: Option<Spread>,
    flipped: Option<usize>,
    self_intersecting: usize,
    self_intersecting_original: usize,
    topology: Counts,
    topology_original: Counts,
}

impl Figures {
    /// Takes the measures; counts are those of `pick`ed topologies, as indexed or as welded.
    pub(crate) fn new(m: &Measures, pick: impl Fn(&certify::Topologies) -> TopologyCounts) -> Self {
        let worse = m.distance.worse();
        let (topology, topology_original) = (pick(&m.remeshed_topology), pick(&m.original_topology));
        Self {
            vertices: topology.vertices,
            faces: topology.faces,
            shape: Shape::from(&m.quality),
            err_mean: worse.mean,
            err_rms: worse.rms,
            err_max: worse.max,
            forward: m.distance.forward.into(),
            backward: m.distance.backward.into(),
            crease_cover: m.creases.map(|c| c.share),
            crease_distance: m.creases.and_then(|c| c.distance).map(Spread::from),
            border_distance: m.border.map(Spread::from),
            flipped: m.flipped.as_ref().map(Vec::len),
            self_intersecting: m.remeshed_self_intersecting,
            self_intersecting_original: m.original_self_intersecting,
            topology: topology.into(),
            topology_original: topology_original.into(),
        }
    }

    /// Appends a line for each measure.
    pub(crate) fn rows(&self, table: &mut Table) {
        table.row("vertices, faces", format!("{}, {}", self.vertices, self.faces));
        table.row("topology", self.topology.text());
        self.shape.rows(table);
        let Self { err_mean, err_rms, err_max, .. } = self;
        table.row("error", format!("mean {err_mean:.2e}, RMS {err_rms:.2e}, greatest {err_max:.2e} of the diagonal"));
        table.row_if("crease cover", self.crease_cover.map(|c| format!("{:.2} % of the original's creases are kept", 100.0 * c)));
        table
            .row_if("border", self.border_distance.as_ref().map(|b| format!("mean {:.2e}, greatest {:.2e} away", b.mean, b.max)));
        let flipped =
            self.flipped.map_or("unknown, the original is not consistently oriented".to_owned(), |n| format!("{n} triangles"));
        table.row("flipped", flipped);
        let (mine, theirs) = (self.self_intersecting, self.self_intersecting_original);
        table.row("intersecting", format!("{mine} triangles, {theirs} in the original"));
    }
}
