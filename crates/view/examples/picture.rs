//! A picture of a fixture, coloured by quality: `cargo run -p view --example picture -- [OUT.png]`

use std::error::Error;
use view::{Line, Scene, ViewOptions, quality_color, render};

fn main() -> Result<(), Box<dyn Error>> {
    let mesh = fixtures::part(6);
    let mut scene = Scene::new(&mesh);
    scene.face_colors = Some(mesh.faces().ids().map(|f| quality_color(mesh_core::aspect_ratio(mesh.triangle(f)))).collect());
    if let Some(bounds) = mesh.bounds() {
        scene.lines.push(Line { from: bounds.min, to: bounds.max, color: [200, 0, 0], width: 3.0 });
    }
    let image = render(&scene, &ViewOptions { width: 600, height: 600, edges: true, ..Default::default() });
    match std::env::args().nth(1) {
        Some(path) => image.write_png(path)?,
        None => println!("{} x {} pixels, {} bytes of PNG", image.width(), image.height(), image.to_png_bytes()?.len()),
    }
    Ok(())
}
