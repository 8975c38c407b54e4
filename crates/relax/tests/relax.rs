//! Relaxation on shapes whose answers are known.

mod common;

use common::{OCTAHEDRON, cube, frustum, icosahedron, octahedron, on_sphere, torus};
use relax::{RelaxOptions, RelaxReport};

fn print(name: &str, r: &RelaxReport) {
    println!(
        "{name:26} start {:.4} min {:.3} inv {:4} | quadric({:2}) {:.4} min {:.3} inv {:3} | shape({:2}) {:.4} min {:.3} inv {:3}",
        r.start.ar_mean, r.start.ar_min, r.start.inverted, r.quadric_iterations, r.after_quadric.ar_mean, r.after_quadric.ar_min,
        r.after_quadric.inverted, r.shape_steps, r.end.ar_mean, r.end.ar_min, r.end.inverted
    );
}

#[test]
fn beds() {
    let (p, f) = icosahedron();
    let options = RelaxOptions::default();
    for jitter in [0.0, 0.4, 0.8, 1.5, 3.0] {
        print(&format!("ico {jitter}"), &on_sphere(p.clone(), &f, 4).jitter(jitter, 1).relax(&options).report);
        print(&format!("octa {jitter}"), &on_sphere(octahedron(), &OCTAHEDRON, 4).jitter(jitter, 2).relax(&options).report);
        print(&format!("torus {jitter}"), &torus(3).jitter(jitter, 3).relax(&options).report);
        print(&format!("cube {jitter}"), &cube(7, 3).jitter(jitter, 4).relax(&options).report);
        print(&format!("cylinder {jitter}"), &frustum([1.0, 1.0], 1.5, 6, 3).jitter(jitter, 5).relax(&options).report);
        print(&format!("cone {jitter}"), &frustum([1.0, 0.3], 1.5, 6, 3).jitter(jitter, 6).relax(&options).report);
    }
}
