//! Flat charts as SVG text.

use crate::Rgb;
use glam::DVec2;
use std::fmt::Write as _;

/// A drawing in the plane, y up: filled polygons first, then lines, then points.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    polygons: Vec<(Vec<DVec2>, Rgb)>,
    lines: Vec<(DVec2, DVec2, Rgb)>,
    points: Vec<(DVec2, Rgb)>,
}

/// Length of the longer side in SVG units, and the margin around the drawing.
const SIDE: f64 = 1000.0;
const MARGIN: f64 = 20.0;

impl Chart {
    /// Adds a filled polygon (a triangle, say) with a thin grey outline.
    pub fn polygon(&mut self, corners: impl IntoIterator<Item = DVec2>, fill: Rgb) -> &mut Self {
        self.polygons.push((corners.into_iter().collect(), fill));
        self
    }
    /// Adds a line.
    pub fn line(&mut self, from: DVec2, to: DVec2, color: Rgb) -> &mut Self {
        self.lines.push((from, to, color));
        self
    }
    /// Adds a dot.
    pub fn point(&mut self, at: DVec2, color: Rgb) -> &mut Self {
        self.points.push((at, color));
        self
    }

    /// The drawing as an SVG document, scaled so that its longer side is 1000 units.
    pub fn to_svg(&self) -> String {
        let (low, high) = self.bounds();
        let extent = high - low;
        let longest = extent.max_element();
        let scale = if longest > 0.0 { SIDE / longest } else { 1.0 };
        let place = |p: &DVec2| (MARGIN + (p.x - low.x) * scale, MARGIN + (high.y - p.y) * scale);
        let size = extent * scale + 2.0 * MARGIN;
        let mut svg = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.2} {:.2}\">\n", size.x, size.y);
        for (corners, fill) in &self.polygons {
            let list: Vec<_> = corners.iter().map(place).map(|(x, y)| format!("{x:.2},{y:.2}")).collect();
            let _ = writeln!(svg, "<polygon points=\"{}\" fill=\"{}\" stroke=\"#888888\"/>", list.join(" "), hex(*fill));
        }
        for (from, to, color) in &self.lines {
            let ((x1, y1), (x2, y2)) = (place(from), place(to));
            let ends = format!("x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\"");
            let _ = writeln!(svg, "<line {ends} stroke=\"{}\" stroke-width=\"2\"/>", hex(*color));
        }
        for (at, color) in &self.points {
            let (x, y) = place(at);
            let _ = writeln!(svg, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"4\" fill=\"{}\"/>", hex(*color));
        }
        svg + "</svg>\n"
    }

    fn bounds(&self) -> (DVec2, DVec2) {
        let polygons = self.polygons.iter().flat_map(|(corners, _)| corners.iter().copied());
        let lines = self.lines.iter().flat_map(|&(from, to, _)| [from, to]);
        let all: Vec<_> = polygons.chain(lines).chain(self.points.iter().map(|&(at, _)| at)).collect();
        let fold = |pick: fn(DVec2, DVec2) -> DVec2| all.iter().copied().reduce(pick).unwrap_or(DVec2::ZERO);
        (fold(DVec2::min), fold(DVec2::max))
    }
}

fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_and_a_point_are_placed_with_y_up() {
        let mut chart = Chart::default();
        chart.polygon([DVec2::ZERO, DVec2::X, DVec2::new(0.0, 0.5)], [255, 0, 16]);
        chart.point(DVec2::X, [0; 3]).line(DVec2::ZERO, DVec2::X, [0, 0, 255]);
        let svg = chart.to_svg();
        assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1040.00 540.00\">"));
        assert!(svg.contains("<polygon points=\"20.00,520.00 1020.00,520.00 20.00,20.00\" fill=\"#ff0010\""));
        assert!(svg.contains("<circle cx=\"1020.00\" cy=\"520.00\""));
    }

    #[test]
    fn an_empty_chart_is_a_document() {
        assert!(Chart::default().to_svg().ends_with("</svg>\n"));
    }
}
