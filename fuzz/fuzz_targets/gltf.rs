//! The reader of gltf as JSON and as glb, told apart by the first bytes.
#![no_main]

use mesh_io::Format;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::check(bytes, Format::Gltf));
