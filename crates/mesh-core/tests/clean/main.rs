//! Cleaning: every defect as a small case with a known answer, then random soups.

mod defects;
mod layers;
mod random;
mod shapes;
