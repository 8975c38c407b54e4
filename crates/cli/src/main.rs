//! The `semireg` command line.

fn main() {}
