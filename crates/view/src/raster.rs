//! Triangles and lines into a z-buffer.

use crate::color::mix;
use crate::{Image, Rgb};
use glam::{DVec2, DVec3, Vec3Swizzles as _};

/// A picture with the height of every sample towards the viewer.
pub(crate) struct Canvas {
    width: usize,
    height: usize,
    image: Image,
    heights: Vec<f32>,
}

/// Colour of triangle edges, and how much of it they take.
const EDGE: Rgb = [25, 25, 30];
const EDGE_STRENGTH: f64 = 0.6;
/// Half the width of a triangle edge in samples.
const EDGE_HALF_WIDTH: f64 = 0.65;

impl Canvas {
    pub(crate) fn white(width: usize, height: usize) -> Self {
        Self { width, height, image: Image::white(width, height), heights: vec![f32::NEG_INFINITY; width * height] }
    }

    pub(crate) fn into_image(self) -> Image {
        self.image
    }

    /// Fills a triangle given by column, row and height of its corners, all in samples. Both orientations are drawn.
    pub(crate) fn triangle(&mut self, corners: [DVec3; 3], color: Rgb, edges: bool) {
        let [a, b, c] = corners.map(|p| p.xy());
        let doubled = (b - a).perp_dot(c - a);
        if doubled == 0.0 || !doubled.is_finite() {
            return;
        }
        // Weight i is 1 at corner i and 0 on the opposite edge, whose distance is the weight times the altitude.
        let opposite = [[b, c], [c, a], [a, b]];
        let altitudes = opposite.map(|[p, q]| doubled.abs() / p.distance(q));
        let dark = mix(color, EDGE, EDGE_STRENGTH);
        let (columns, rows) = self.span(a.min(b).min(c), a.max(b).max(c));
        for y in rows {
            for x in columns.clone() {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let weights = opposite.map(|[q, r]| (q - p).perp_dot(r - p) / doubled);
                if weights.iter().any(|&w| w < 0.0) {
                    continue;
                }
                let height = (0..3).map(|i| weights[i] * corners[i].z).sum::<f64>();
                let at_edge = edges && (0..3).any(|i| weights[i] * altitudes[i] < EDGE_HALF_WIDTH);
                self.put(x, y, height as f32, if at_edge { dark } else { color });
            }
        }
    }

    /// Draws a line of some width with round ends. It is lifted by its width, so that on a slanting surface it is not cut.
    pub(crate) fn line(&mut self, from: DVec3, to: DVec3, width: f64, color: Rgb) {
        let (a, b, half) = (from.xy(), to.xy(), 0.5 * width);
        if !(a.is_finite() && b.is_finite()) {
            return;
        }
        let along = b - a;
        let square = along.length_squared();
        let (columns, rows) = self.span(a.min(b) - half, a.max(b) + half);
        for y in rows {
            let p = DVec2::new(0.0, y as f64 + 0.5);
            for x in near_line(&columns, p, a, along, half) {
                let p = DVec2::new(x as f64 + 0.5, p.y);
                let t = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
                if p.distance_squared(a + t * along) <= half * half {
                    let height = from.z + t * (to.z - from.z) + width;
                    self.put(x, y, height as f32, color);
                }
            }
        }
    }

    /// Columns and rows of the samples between two points.
    fn span(&self, low: DVec2, high: DVec2) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
        // `as usize` saturates at 0, so what lies outside gives an empty range or the border.
        let range = |low: f64, high: f64, n: usize| low.floor() as usize..(high.ceil().max(0.0) as usize).min(n);
        (range(low.x, high.x, self.width), range(low.y, high.y, self.height))
    }

    fn put(&mut self, x: usize, y: usize, height: f32, color: Rgb) {
        let i = y * self.width + x;
        if height > self.heights[i] {
            self.heights[i] = height;
            self.image.pixels_mut()[i] = color;
        }
    }
}

/// The part of `columns` in which a row at `row.y` is within `half` of the endless line through `a`: keeps a long slanting line
/// from visiting its whole box.
fn near_line(columns: &std::ops::Range<usize>, row: DVec2, a: DVec2, along: DVec2, half: f64) -> std::ops::Range<usize> {
    let Some(normal) = along.perp().try_normalize().filter(|n| n.x.abs() > 1e-3) else { return columns.clone() };
    let ends = [-half, half].map(|side| a.x + (side - normal.y * (row.y - a.y)) / normal.x);
    let low = ends[0].min(ends[1]).floor() as usize;
    let high = ends[0].max(ends[1]).ceil() as usize;
    columns.start.max(low)..columns.end.min(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Rgb = [255, 0, 0];
    const BLUE: Rgb = [0, 0, 255];

    fn count(canvas: Canvas, color: Rgb) -> usize {
        canvas.into_image().pixels_mut().iter().filter(|p| **p == color).count()
    }

    #[test]
    fn two_triangles_fill_their_square_once() {
        let square = [(2.0, 2.0), (12.0, 2.0), (12.0, 12.0), (2.0, 12.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let mut canvas = Canvas::white(16, 16);
        canvas.triangle([square[0], square[1], square[2]], RED, false);
        canvas.triangle([square[0], square[3], square[2]], RED, false);
        assert_eq!(count(canvas, RED), 100);
    }

    #[test]
    fn the_higher_triangle_wins_in_either_order() {
        let at = |z: f64| [DVec3::new(0.0, 0.0, z), DVec3::new(8.0, 0.0, z), DVec3::new(0.0, 8.0, z)];
        for order in [[(1.0, RED), (0.0, BLUE)], [(0.0, BLUE), (1.0, RED)]] {
            let mut canvas = Canvas::white(8, 8);
            order.into_iter().for_each(|(z, color)| canvas.triangle(at(z), color, false));
            assert_eq!(count(canvas, BLUE), 0);
        }
    }

    #[test]
    fn a_slanting_line_has_its_length_times_its_width() {
        let mut canvas = Canvas::white(300, 300);
        canvas.line(DVec3::new(20.0, 30.0, 0.0), DVec3::new(260.0, 210.0, 0.0), 6.0, RED);
        let expected = 300.0 * 6.0 + std::f64::consts::PI * 9.0;
        assert!((count(canvas, RED) as f64 - expected).abs() < 0.02 * expected);
    }

    #[test]
    fn what_lies_outside_or_is_huge_is_cut_off() {
        let mut canvas = Canvas::white(8, 8);
        canvas.triangle([DVec3::splat(-9.0), DVec3::new(-1.0, -9.0, 0.0), DVec3::new(-1.0, -1.0, 0.0)], RED, false);
        canvas.line(DVec3::splat(100.0), DVec3::splat(1e300), 3.0, RED);
        assert_eq!(count(canvas, RED), 0);
        let mut canvas = Canvas::white(8, 8);
        canvas.line(DVec3::new(-1e12, 4.0, 0.0), DVec3::new(1e12, 4.0, 0.0), 2.0, RED);
        assert_eq!(count(canvas, RED), 16);
    }
}
