//! Whatever the bytes, reading ends with a document or an error, and what was read can be cleaned. A panic fails these tests.

use crate::fuzz::check;
use crate::{small_tetrahedron, tetrahedron};
use mesh_io::{Format, read_bytes, write_bytes};
use proptest::prelude::*;

const TEXT_PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
    property list uchar int vertex_indices\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n\
    0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n5 0 1 2 -1 0\n";
const BIG_ENDIAN_PLY: &[u8] =
    b"ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty short x\nproperty short y\nproperty double z\n\
    element face 1\nproperty list uchar ushort vertex_index\nend_header\n\0\x01\0\x02AAAAAAAA\x03\0\0\0\0\0\0";
const TEXT_STL: &str =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
const OBJ: &str = "# c\no a\nv 0 0 0\nv 1 0 0 1\nv 1 1 0 .1 .2 .3\nvt 0 0\nusemtl m\nf 1/1 2//2 \\\n -1\nf 1 2 9\n";
const COLOR_OFF: &str = "COFF # c\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2 255 0 0\n";
const GLTF: &str = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":24,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAA"}],
    "bufferViews":[{"buffer":0,"byteLength":24,"byteStride":12}],"accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"VEC3",
    "sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":5}]}],"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"children":[1]},{"mesh":0,"rotation":[0,0,0,1],"scale":[1,1,-1]}]}"#;

/// Small valid files of every format and layout.
fn seeds() -> Vec<(Format, Vec<u8>)> {
    let mut seeds: Vec<(Format, Vec<u8>)> = Format::ALL.map(|f| (f, write_bytes(&small_tetrahedron(), f).unwrap())).into();
    seeds.extend([Format::Obj, Format::Ply, Format::Off].map(|f| (f, write_bytes(&tetrahedron(), f).unwrap())));
    seeds.push((Format::Ply, TEXT_PLY.into()));
    seeds.push((Format::Ply, BIG_ENDIAN_PLY.into()));
    seeds.push((Format::Stl, TEXT_STL.into()));
    seeds.push((Format::Obj, OBJ.into()));
    seeds.push((Format::Off, COLOR_OFF.into()));
    seeds.push((Format::Gltf, GLTF.into()));
    seeds
}

#[test]
fn seeds_are_valid() {
    for (format, bytes) in seeds() {
        let d = read_bytes(&bytes, format).unwrap_or_else(|e| panic!("{format:?}: {e}"));
        assert_eq!(d.polygon_of.len(), d.soup.triangles.len());
    }
}

#[test]
fn files_cut_off_at_every_byte() {
    for (format, bytes) in seeds() {
        for end in 0..bytes.len() {
            check(&bytes[..end], format);
        }
    }
}

#[test]
fn a_cut_binary_file_is_refused() {
    for format in [Format::Ply, Format::Stl, Format::Glb] {
        let bytes = write_bytes(&small_tetrahedron(), format).unwrap();
        for end in 0..bytes.len() {
            assert!(read_bytes(&bytes[..end], format).is_err(), "{format:?} cut at {end} of {}", bytes.len());
        }
    }
}

#[test]
fn every_byte_changed() {
    for (format, mut bytes) in seeds() {
        for i in 0..bytes.len() {
            let old = bytes[i];
            for new in [0, 0xff, b'-', b'9', b' ', b'\n', b'"', old ^ 1, old ^ 0x80] {
                bytes[i] = new;
                check(&bytes, format);
            }
            bytes[i] = old;
        }
    }
}

#[test]
fn files_of_every_other_format() {
    for (_, bytes) in seeds() {
        for format in Format::ALL {
            check(&bytes, format);
        }
    }
}

proptest! {
    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        for format in Format::ALL {
            check(&bytes, format);
        }
    }

    #[test]
    fn random_words(words in prop::collection::vec("(v|f|l|#|OFF|COFF|ply|solid|facet|vertex|endloop|\\\\|-?[0-9]{1,12}|[0-9.e-]{1,6}|nan|/| |\r?\n)", 0..80)) {
        let text = words.join(" ");
        for format in Format::ALL {
            check(text.as_bytes(), format);
        }
    }

    #[test]
    fn parts_of_valid_files_out_of_place(
        seed in any::<prop::sample::Index>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0usize..12, any::<u8>()), 1..6),
    ) {
        let seeds = seeds();
        let (format, mut bytes) = seeds[seed.index(seeds.len())].clone();
        for (from, to, length, byte) in edits {
            let from = from.index(bytes.len());
            let piece = bytes[from..(from + length).min(bytes.len())].to_vec();
            let to = to.index(bytes.len());
            bytes.splice(to..(to + length / 2).min(bytes.len()), piece);
            if let Some(b) = bytes.get_mut(to) {
                *b = byte;
            }
        }
        check(&bytes, format);
    }
}
