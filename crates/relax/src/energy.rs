//! The shape energy of one triangle, `q^p + w (r + 1/r) / 2`, with its gradient and a positive model of its second derivative.
//!
//! `q = (a^2 + b^2 + c^2) / (4 sqrt 3 y)` is the inverse mean ratio, 1 for an equilateral triangle, `r = y / target`, and `y` the
//! signed area made positive: `y = (A + sqrt(A^2 + eps^2)) / 2` (Garanzha, Kaporin, Kudryavtseva, Protais, Ray and Sokolov,
//! *Foldover-free maps in 50 lines of code*, 2021, eq. 3). With `eps = 0` that is the area itself, and the energy a barrier
//! against inversion.
//!
//! The energy is convex in edge lengths and area together (a square over a linear function), so leaving out the second
//! derivative of the area, as they do, makes the second derivative positive.

use glam::DVec3;

/// How shape and size are weighed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Metric {
    /// Power of the shape term, at least 1.
    pub(crate) power: f64,
    /// Weight of the size term.
    pub(crate) size_weight: f64,
    /// No energy exceeds this: `e` counts as `e cap / (e + cap)`.
    pub(crate) cap: f64,
}

/// A triangle on the surface, measured: what its energy depends on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measures {
    /// The surface's unit normal.
    pub(crate) normal: DVec3,
    /// The area, negative where the triangle faces against the surface.
    pub(crate) signed_area: f64,
    /// The sum of the squared lengths of the edges.
    pub(crate) squared_lengths: f64,
}

/// What a triangle shall be like.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal {
    /// The area wanted.
    pub(crate) target: f64,
    /// Regularisation, an area.
    pub(crate) eps: f64,
}

/// Second-order model of the energy: `H_ij = stiffness M_ij I + ll l_i l_j + la (l_i a_j + a_i l_j) + aa a_i a_j`, with
/// `M_ij` 4 on the diagonal and -2 off it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion {
    pub(crate) gradient: [DVec3; 3],
    /// `l`: derivative of the sum of the squared lengths by the corners.
    pub(crate) lengths: [DVec3; 3],
    /// `a`: derivative of `y` by the corners.
    pub(crate) areas: [DVec3; 3],
    pub(crate) stiffness: f64,
    pub(crate) ll: f64,
    pub(crate) la: f64,
    pub(crate) aa: f64,
}

/// `q^power`; without the dear call for the powers while untangling, and of the default and its derivatives.
fn raised(q: f64, power: f64) -> f64 {
    if power == 1.0 {
        q
    } else if power == 0.0 {
        1.0
    } else if power == 2.0 {
        q * q
    } else {
        q.powf(power)
    }
}

impl Metric {
    fn uncapped(&self, q: f64, r: f64) -> f64 {
        raised(q, self.power) + 0.5 * self.size_weight * (r + 1.0 / r)
    }
}

impl Measures {
    /// `|a|^2 + |b|^2 + |c|^2 = EQUILATERAL * area` for an equilateral triangle: 4 sqrt 3.
    const EQUILATERAL: f64 = 6.928_203_230_275_509;

    /// Those of a triangle where the surface has this unit normal.
    pub(crate) fn new(corners: [DVec3; 3], normal: DVec3) -> Self {
        let [a, b, c] = corners;
        let squared_lengths = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
        Self { normal, signed_area: mesh_core::vector_area(corners).dot(normal), squared_lengths }
    }

    /// `y` and its derivative by the signed area.
    fn positive_area(&self, eps: f64) -> (f64, f64) {
        let area = self.signed_area;
        // The same, and faster.
        let root = if eps == 0.0 { area.abs() } else { area.hypot(eps) };
        // Without cancellation where the area is negative.
        let y = if area > 0.0 { 0.5 * (area + root) } else { 0.5 * eps * eps / (root - area) };
        (y, y / root)
    }

    /// The energy; the cap for an inverted triangle without regularisation.
    pub(crate) fn energy(&self, goal: Goal, metric: &Metric) -> f64 {
        let (y, _) = self.positive_area(goal.eps);
        if y.is_nan() || y <= 0.0 {
            return metric.cap;
        }
        let q = self.squared_lengths / (Self::EQUILATERAL * y);
        let r = y / goal.target;
        1.0 / (1.0 / metric.uncapped(q, r) + 1.0 / metric.cap)
    }

    /// Gradient and second-order model at these corners. The energy must be finite. The cap is concave: only its slope counts in
    /// the model.
    pub(crate) fn expansion(&self, [p0, p1, p2]: [DVec3; 3], goal: Goal, metric: &Metric) -> Expansion {
        let (y, slope) = self.positive_area(goal.eps);
        let lengths = [2.0 * p0 - p1 - p2, 2.0 * p1 - p2 - p0, 2.0 * p2 - p0 - p1].map(|d| 2.0 * d);
        let areas = [p2 - p1, p0 - p2, p1 - p0].map(|opposite| 0.5 * slope * self.normal.cross(opposite));

        let q = self.squared_lengths / (Self::EQUILATERAL * y);
        let (q_l, q_y) = (1.0 / (Self::EQUILATERAL * y), -q / y);
        let (q_ly, q_yy) = (-q_l / y, 2.0 * q / (y * y));
        let shape_1 = metric.power * raised(q, metric.power - 1.0);
        let shape_2 = metric.power * (metric.power - 1.0) * raised(q, metric.power - 2.0);
        let r = y / goal.target;
        // The slope of the cap.
        let s = (1.0 + metric.uncapped(q, r) / metric.cap).powi(-2);
        let size_1 = 0.5 * metric.size_weight * (1.0 - 1.0 / (r * r)) / goal.target;
        let size_2 = metric.size_weight / (r * r * r * goal.target * goal.target);

        let (by_l, by_y) = (s * shape_1 * q_l, s * (shape_1 * q_y + size_1));
        Expansion {
            gradient: [0, 1, 2].map(|i| by_l * lengths[i] + by_y * areas[i]),
            lengths,
            areas,
            stiffness: by_l,
            ll: s * shape_2 * q_l * q_l,
            la: s * (shape_1 * q_ly + shape_2 * q_l * q_y),
            aa: s * (shape_1 * q_yy + shape_2 * q_y * q_y + size_2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const METRIC: Metric = Metric { power: 2.0, size_weight: 0.3, cap: f64::INFINITY };

    /// A triangle where the surface has this normal.
    #[derive(Clone, Copy)]
    struct Triangle {
        corners: [DVec3; 3],
        normal: DVec3,
        goal: Goal,
    }

    impl Triangle {
        fn energy(&self, metric: &Metric) -> f64 {
            Measures::new(self.corners, self.normal).energy(self.goal, metric)
        }

        fn expansion(&self, metric: &Metric) -> Expansion {
            Measures::new(self.corners, self.normal).expansion(self.corners, self.goal, metric)
        }
    }

    fn triangle(eps: f64) -> Triangle {
        let corners = [DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.2, 0.1, 0.5), DVec3::new(0.4, 0.8, 0.2)];
        Triangle { corners, normal: DVec3::new(0.1, 0.2, 1.0).normalize(), goal: Goal { target: 0.2, eps } }
    }

    #[test]
    fn an_equilateral_triangle_of_the_target_area_has_the_least_energy() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.75f64.sqrt(), 0.0)];
        let best = Triangle { corners, normal: DVec3::Z, goal: Goal { target: 3f64.sqrt() / 4.0, eps: 0.0 } };
        assert!((best.energy(&METRIC) - 1.3).abs() < 1e-14);
        assert!(best.expansion(&METRIC).gradient.iter().all(|g| g.length() < 1e-14));
        assert_eq!(Triangle { normal: -DVec3::Z, ..best }.energy(&METRIC), f64::INFINITY);
    }

    /// The gradient is that of the energy, upright and inverted.
    #[test]
    fn gradient_by_differences() {
        for (normal, eps, cap) in [(1.0, 0.0, f64::INFINITY), (1.0, 0.0, 2.0), (1.0, 0.2, 50.0), (-1.0, 0.2, f64::INFINITY)] {
            let (t, metric) = (triangle(eps), Metric { cap, ..METRIC });
            let t = Triangle { normal: normal * t.normal, ..t };
            let gradient = t.expansion(&metric).gradient;
            for (corner, axis) in (0..3).flat_map(|c| DVec3::AXES.map(|a| (c, a))) {
                let at = |step: f64| {
                    let mut moved = t;
                    moved.corners[corner] += step * axis;
                    moved.energy(&metric)
                };
                let slope = (at(1e-5) - at(-1e-5)) / 2e-5;
                assert!((slope - gradient[corner].dot(axis)).abs() < 1e-6 * (1.0 + slope.abs()), "{slope}");
            }
        }
    }

    /// The model of the second derivative is not negative in any of a thousand directions, even for an inverted triangle.
    #[test]
    fn the_model_is_positive() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for sign in [1.0, -1.0] {
            let t = triangle(0.1);
            let e = Triangle { normal: sign * t.normal, ..t }.expansion(&METRIC);
            for _ in 0..1000 {
                let d = [0; 3].map(|_| DVec3::new(random(), random(), random()));
                let along = |g: [DVec3; 3]| (0..3).map(|i| g[i].dot(d[i])).sum::<f64>();
                let (l, a) = (along(e.lengths), along(e.areas));
                let spread = 2.0 * (0..3).map(|i| d[i].distance_squared(d[(i + 1) % 3])).sum::<f64>();
                let curvature = e.stiffness * spread + e.ll * l * l + 2.0 * e.la * l * a + e.aa * a * a;
                assert!(curvature > -1e-12 * e.stiffness, "{curvature}");
            }
        }
    }
}
