//! Carries texture coordinates of a tall box to a coarser one, and says how far they are off.

use attributes::{Source, corner_values, correspond};
use mesh_core::{CleanOptions, clean};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let soup = fixtures::cube(12).to_soup();
    let cleaned = clean(&soup, &CleanOptions::default())?;
    let source = Source::new(&soup, &cleaned);
    // Seen from above: x and y of each corner.
    let uvs: Vec<[[f64; 2]; 3]> =
        soup.triangles.iter().map(|t| t.map(|v| [soup.positions[v as usize].x, soup.positions[v as usize].y])).collect();
    let other = fixtures::cube(5);
    let carried = corner_values(&other, &correspond(&source, &source.seams(&uvs, 1e-9), &other), &uvs);
    let off = other.faces().iter().zip(&carried).flat_map(|(face, uvs)| {
        face.map(|v| other.position(v)).into_iter().zip(*uvs).map(|(p, [u, v])| (p.x - u).hypot(p.y - v))
    });
    println!("{} faces, texture coordinates off by {:.1e} at most", other.n_faces(), off.fold(0.0, f64::max));
    Ok(())
}
