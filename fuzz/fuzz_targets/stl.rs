//! The reader of stl, text and binary.
#![no_main]

use mesh_io::Format;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::check(bytes, Format::Stl));
