//! What all attempts run on: the input cleaned and refined, made once.

mod density;
mod given;
mod marked;
mod prepare;
mod size;
mod warnings;

pub(crate) use given::GivenBase;
pub(crate) use prepare::Input;
