//! How exact a bumpy sphere comes back from displacements of some numbers of bits.

use displacement::{EncodeOptions, encode, figures};
use region_map::{Domain, Surface};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    const LEVELS: u32 = 4;
    let surface = Surface::with_creases(fixtures::icosphere(2), 40.0)?;
    let linear = subdiv::subdivide(&Domain::identity(&surface), LEVELS)?.domain.mesh;
    let bumpy = |p: glam::DVec3| p.normalize() * (1.0 + 0.1 * (4.0 * p.x).sin() * (5.0 * p.y).cos());
    let mesh = linear.with_positions(linear.positions().iter().map(|&p| bumpy(p)).collect())?;
    println!("bits       with residual    without    (greatest distances, in parts of the diagonal)");
    for bits in [None, Some(16), Some(12), Some(8), Some(4)] {
        let figures = figures(&encode(&mesh, LEVELS, &EncodeOptions { bits })?, &mesh)?;
        let name = bits.map_or("exact".to_owned(), |bits| bits.to_string());
        println!("{name:10} {:13.1e} {:10.1e}", figures.with_residual.greatest, figures.without_residual.greatest);
    }
    Ok(())
}
