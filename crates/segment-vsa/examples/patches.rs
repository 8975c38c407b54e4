//! Patches of a fixture: `cargo run -p segment-vsa --example patches -- [MAX_PATCHES]`

use region_map::{Cells, Surface};
use segment_vsa::{VsaOptions, segment};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let max_patches = std::env::args().nth(1).map_or(Ok(24), |a| a.parse())?;
    let surface = Surface::with_creases(fixtures::brick(16), 40.0)?;
    let options = VsaOptions { max_patches, ..VsaOptions::default() };
    let (segmentation, report) = segment(&surface, &options)?;
    let cells = Cells::trace(&surface, &segmentation)?;
    println!("genus {}, {} sheets, {max_patches} patches wanted", surface.topology().genus(), surface.network().n_sheets);
    println!("{} patches (disks), {} arcs, {} corners", cells.patches.len(), cells.arcs.len(), cells.corners.len());
    println!("{report:?}");
    Ok(())
}
