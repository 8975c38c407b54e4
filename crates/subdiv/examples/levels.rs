//! Counts of a fixture, taken as its own base mesh, at the first levels: `cargo run -p subdiv --example levels -- [LEVELS]`

use region_map::{Domain, Surface};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let levels: u32 = std::env::args().nth(1).map_or(Ok(4), |a| a.parse())?;
    let base = Domain::identity(&Surface::smooth(fixtures::torus(1.0, 0.4, 12, 8))?);
    println!("level  vertices     faces");
    for level in 0..=levels {
        let finest = subdiv::subdivide(&base, level)?.domain.mesh;
        println!("{level:5} {:9} {:9}", finest.n_vertices(), finest.n_faces());
    }
    Ok(())
}
