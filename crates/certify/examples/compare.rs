//! How well a coarse sphere stands for a fine one, and whether it is a subdivided icosahedron:
//! `cargo run -p certify --example compare`

use certify::{MeasureOptions, Reference, certify, measure};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let (fine, coarse) = (Reference::new(fixtures::icosphere(20))?, fixtures::icosphere(8));
    let measures = measure(&fine, &coarse, &MeasureOptions::default())?;
    let (quality, distance) = (&measures.quality, measures.distance.worse());
    println!("mean quality {:.4}, least {:.4}", quality.ar_mean, quality.ar_min);
    println!("distance over the diagonal: mean {:.2e}, greatest {:.2e}", distance.mean, distance.max);

    // Its faces are not in the order of a subdivision: no certificate for one of three levels, but one for none.
    for levels in [0, 3] {
        let certificate = certify(&fine, &coarse, levels, &MeasureOptions::default())?;
        let reasons: Vec<String> = certificate.failures().iter().map(ToString::to_string).collect();
        println!("{levels} levels: passed {} {reasons:?}", certificate.passed());
    }
    Ok(())
}
