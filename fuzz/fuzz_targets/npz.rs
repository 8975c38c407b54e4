//! The reader of npz.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = mesh_io::read_arrays_bytes(bytes);
});
