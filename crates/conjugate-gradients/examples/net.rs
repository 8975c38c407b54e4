//! How deep a square net of springs sags when its border is held: `cargo run --release -p conjugate-gradients --example net`

use conjugate_gradients::solve;
use glam::DVec3;

fn main() {
    for n in [16, 32, 64, 128] {
        // Knots in rows of `n`; those beyond stay where they are.
        let at = |x: &[DVec3], i: usize, j: usize| if i < n && j < n { x[n * i + j] } else { DVec3::ZERO };
        let row = |x: &[DVec3], k: usize| {
            let (i, j) = (k / n, k % n);
            let neighbours = [(i.wrapping_sub(1), j), (i + 1, j), (i, j.wrapping_sub(1)), (i, j + 1)];
            neighbours.into_iter().map(|(a, b)| x[k] - at(x, a, b)).sum()
        };
        // The same weight on the whole net, and a wind from the side.
        let pull = DVec3::new(0.0, 0.3, -1.0) / ((n + 1) * (n + 1)) as f64;
        for most in [n / 2, 10 * n] {
            let found = solve(vec![pull; n * n], row, |r, _| r / 4.0, 1e-10, most);
            let middle = found[n * (n / 2) + n / 2];
            println!("{n:3} x {n:<3} {most:4} iterations at most: the middle moves by {:.5} and {:.5}", middle.y, middle.z);
        }
    }
}
