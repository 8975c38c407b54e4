//! Where a picture is taken from. All projections are orthographic.

use glam::{DVec2, DVec3};
use mesh_core::TriMesh;

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum View {
    /// Four pictures of the whole scene on one sheet: three obliquely from above, one obliquely from below. z is up.
    #[default]
    Four,
    /// The whole scene seen from this side (the direction from the scene to the viewer).
    From(DVec3),
    /// The surroundings of a point.
    Close {
        /// The point in the middle of the picture.
        at: DVec3,
        /// Half of the shorter side of the picture, in units of the mesh.
        radius: f64,
        /// Direction from the point to the viewer.
        from: DVec3,
    },
}

/// The four sides of [`View::Four`], in reading order.
pub(crate) const FOUR_SIDES: [DVec3; 4] =
    [DVec3::new(1.0, 1.0, 0.8), DVec3::new(-1.0, 1.0, -0.6), DVec3::new(1.0, -1.0, 0.5), DVec3::new(-0.4, -0.6, 1.0)];

/// The close view of `mesh` around `at`, from the side that the face with the nearest middle looks to.
pub fn close_up(mesh: &TriMesh, at: DVec3, radius: f64) -> View {
    let middle_distance = |f: &_| mesh.centroid(*f).distance_squared(at);
    let nearest = mesh.faces().ids().min_by(|f, g| middle_distance(f).total_cmp(&middle_distance(g)));
    let from = nearest.map_or(DVec3::Z, |f| mesh.normal(f));
    View::Close { at, radius, from }
}

/// An orthographic projection to pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    right: DVec3,
    down: DVec3,
    /// Unit vector towards the viewer.
    pub(crate) back: DVec3,
    centre: DVec3,
    middle: DVec2,
    /// Pixels per unit of the mesh.
    pub(crate) scale: f64,
}

/// Share of the picture left free at each side when the whole scene is shown.
const MARGIN: f64 = 0.03;

impl Camera {
    /// Shows all `points` in a picture of `width` x `height` pixels, seen from the side `from`.
    pub(crate) fn fit(points: &[DVec3], from: DVec3, width: usize, height: usize) -> Self {
        let flat = Self::at(DVec3::ZERO, from, 1.0, DVec2::ZERO);
        let on_plane = |p: &DVec3| DVec2::new(flat.right.dot(*p), flat.down.dot(*p));
        let low = points.iter().map(on_plane).reduce(DVec2::min).unwrap_or(DVec2::ZERO);
        let high = points.iter().map(on_plane).reduce(DVec2::max).unwrap_or(DVec2::ZERO);
        let (middle, extent) = (0.5 * (low + high), high - low);
        let room = DVec2::new(width as f64, height as f64) * (1.0 - 2.0 * MARGIN);
        let scale = (room / extent).min_element();
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let centre = flat.right * middle.x + flat.down * middle.y;
        Self::at(centre, from, scale, 0.5 * DVec2::new(width as f64, height as f64))
    }

    /// Shows the surroundings of `at`: `radius` reaches from the middle to the nearer sides.
    pub(crate) fn close(at: DVec3, radius: f64, from: DVec3, width: usize, height: usize) -> Self {
        let middle = 0.5 * DVec2::new(width as f64, height as f64);
        Self::at(at, from, middle.min_element() / radius.abs().max(f64::MIN_POSITIVE), middle)
    }

    fn at(centre: DVec3, from: DVec3, scale: f64, middle: DVec2) -> Self {
        let back = from.try_normalize().unwrap_or(DVec3::Z);
        let up = if back.z.abs() < 0.99 { DVec3::Z } else { DVec3::Y };
        let right = up.cross(back).normalize_or_zero();
        Self { right, down: right.cross(back), back, centre, middle, scale }
    }

    /// Column, row and height towards the viewer, all in pixels.
    pub(crate) fn project(&self, p: DVec3) -> DVec3 {
        let d = (p - self.centre) * self.scale;
        DVec3::new(self.middle.x + self.right.dot(d), self.middle.y + self.down.dot(d), self.back.dot(d))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_fits_and_z_is_up() {
        let points = [DVec3::new(0.0, 0.0, -5.0), DVec3::new(1.0, 2.0, 7.0), DVec3::new(-3.0, 0.0, 0.0)];
        for from in FOUR_SIDES {
            let camera = Camera::fit(&points, from, 200, 100);
            let seen = points.map(|p| camera.project(p));
            assert!(seen.iter().all(|p| (0.0..=200.0).contains(&p.x) && (0.0..=100.0).contains(&p.y)));
            assert!(camera.project(DVec3::Z).y < camera.project(DVec3::ZERO).y);
        }
    }

    #[test]
    fn the_nearer_point_is_higher() {
        let camera = Camera::close(DVec3::ZERO, 2.0, DVec3::X, 100, 100);
        let p = camera.project(DVec3::new(1.0, 1.0, 0.0));
        assert!((p - DVec3::new(75.0, 50.0, 25.0)).length() < 1e-9, "{p}");
    }
}
