//! The measures of `certify` under the names that the JSON has, and as lines for people.

use crate::print::Table;
use crate::verdict::Verdict;
use certify::{Measures, Quality, SharpCover, Stats, TopologyCounts};
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
    /// What matters of them, in words that need no explanation.
    pub(crate) fn words(&self) -> String {
        surface_words(self.components, self.border_loops, self.genus)
    }

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

/// A surface in words.
pub(crate) fn surface_words(parts: usize, borders: usize, genus: Option<i64>) -> String {
    let plural = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let open = if borders == 0 { "closed".to_owned() } else { plural(borders, "open border") };
    format!("{}, {open}{}", plural(parts, "part"), genus.map_or(String::new(), |g| format!(", genus {g}")))
}

/// A share in per cent, to two digits.
pub(crate) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    // Rounding of coordinates.
    if percent.abs() < 1e-8 {
        return "0 %".to_owned();
    }
    let decimals = (1.0 - percent.abs().log10().floor()).max(0.0) as usize;
    format!("{percent:.decimals$} %")
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
    /// Appends the line that matters.
    pub(crate) fn summary(&self, table: &mut Table) {
        let Self { ar_mean, ar_p01, .. } = self;
        let verdict = Verdict::of_shape(*ar_mean, *ar_p01);
        let figures = format!("quality {ar_mean:.2} in the mean, {ar_p01:.2} in the worst hundredth (1 = equilateral)");
        table.row("shape", format!("{verdict}: {figures}"));
    }

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
    /// Share of the sharp edges that a person sees.
    sharp_cover: Option<f64>,
    crease_cover: Option<f64>,
    crease_distance: Option<Spread>,
    border_distance: Option<Spread>,
    flipped: Option<usize>,
    self_intersecting: usize,
    /// Away from where the original cuts itself.
    self_intersecting_new: usize,
    self_intersecting_original: usize,
    topology: Counts,
    topology_original: Counts,
    #[serde(skip)]
    sharp: Option<SharpCover>,
    /// Over the original's diagonal.
    mean_edge: f64,
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
            sharp_cover: None,
            crease_cover: m.creases.map(|c| c.share),
            crease_distance: m.creases.and_then(|c| c.distance).map(Spread::from),
            border_distance: m.border.map(Spread::from),
            flipped: m.flipped.as_ref().map(Vec::len),
            self_intersecting: m.remeshed_self_intersecting,
            self_intersecting_new: m.new_self_intersecting,
            self_intersecting_original: m.original_self_intersecting,
            topology: topology.into(),
            topology_original: topology_original.into(),
            sharp: None,
            mean_edge: 0.0,
        }
    }

    /// With what is kept of the sharp edges that a person sees, on a mesh with edges of this mean length in diagonals of the original.
    pub(crate) fn with_sharp_edges(self, sharp: Option<SharpCover>, edge: f64) -> Self {
        Self { sharp_cover: sharp.map(|cover| cover.share), sharp, mean_edge: edge, ..self }
    }

    /// Appends the lines that matter, each with a verdict.
    pub(crate) fn summary(&self, table: &mut Table) {
        table.row("mesh", format!("{} vertices, {} triangles: {}", self.vertices, self.faces, self.topology.words()));
        self.shape.summary(table);
        let verdict = Verdict::of_distance(self.err_max, self.mean_edge);
        let [mean, greatest] = [self.err_mean, self.err_max].map(percent);
        table.row("distance", format!("{verdict}: {mean} of the diagonal in the mean, {greatest} at most"));
        let words = |kept: SharpCover| {
            let few = if kept.are_few() { "there are few; " } else { "" };
            format!("{}: {few}{:.1} % of their length kept", Verdict::of_sharp_edges(kept), 100.0 * kept.share)
        };
        table.row("sharp edges", self.sharp.map_or("none to keep".to_owned(), words));
        let (cuts, new) = (self.self_intersecting, self.self_intersecting_new);
        let words =
            || format!("{}: {cuts} triangles cut others, {new} of them where the original does not", Verdict::of_cuts(cuts, new));
        table.row_if("cuts", (cuts > 0).then(words));
    }

    /// Appends the lines that matter of a base mesh: its edges are chords, so its distance says nothing of what is kept.
    pub(crate) fn base_summary(&self, table: &mut Table) {
        table.row("mesh", format!("{} vertices, {} triangles: {}", self.vertices, self.faces, self.topology.words()));
        self.shape.summary(table);
    }

    /// Appends what is wrong with a mesh that was not certified.
    pub(crate) fn faults(&self, table: &mut Table) {
        let poor = Verdict::Poor;
        let original = self.topology_original.words();
        let differs = [self.topology.components, self.topology.border_loops]
            != [self.topology_original.components, self.topology_original.border_loops]
            || self.topology.euler != self.topology_original.euler;
        table.row_if("topology", differs.then(|| format!("{poor}: the original has {original}")));
        let flipped = self.flipped.filter(|n| *n > 0);
        table.row_if("flipped", flipped.map(|n| format!("{poor}: {n} triangles face the other way than the original")));
    }

    /// Appends a line for each measure.
    pub(crate) fn rows(&self, table: &mut Table) {
        table.row("vertices, faces", format!("{}, {}", self.vertices, self.faces));
        table.row("topology", self.topology.text());
        self.shape.rows(table);
        let Self { err_mean, err_rms, err_max, .. } = self;
        table.row("error", format!("mean {err_mean:.2e}, RMS {err_rms:.2e}, greatest {err_max:.2e} of the diagonal"));
        let cover = |share: f64| format!("{:.2} % of the length that a person sees as sharp is kept", 100.0 * share);
        table.row_if("sharp edges", self.sharp_cover.map(cover));
        let cover = |share: f64| format!("{:.2} % of all edges over 40 degrees are kept, noise included", 100.0 * share);
        table.row_if("crease cover", self.crease_cover.map(cover));
        table
            .row_if("border", self.border_distance.as_ref().map(|b| format!("mean {:.2e}, greatest {:.2e} away", b.mean, b.max)));
        let flipped =
            self.flipped.map_or("unknown, the original is not consistently oriented".to_owned(), |n| format!("{n} triangles"));
        table.row("flipped", flipped);
        let Self { self_intersecting, self_intersecting_new: new, self_intersecting_original: original, .. } = self;
        table.row(
            "intersecting",
            format!("{self_intersecting} triangles, {new} where the original does not, {original} in the original"),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_have_two_digits() {
        for (share, text) in [(0.0123, "1.2 %"), (1.74e-4, "0.017 %"), (0.5, "50 %"), (1.0, "100 %"), (1e-12, "0 %")] {
            assert_eq!(percent(share), text);
        }
    }

    #[test]
    fn surfaces_in_words() {
        assert_eq!(surface_words(1, 0, Some(0)), "1 part, closed, genus 0");
        assert_eq!(surface_words(2, 1, None), "2 parts, 1 open border");
    }
}
