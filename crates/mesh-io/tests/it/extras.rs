//! What a file holds beside its triangles is named.

use crate::{document, small_tetrahedron};
use mesh_io::{Extra, Format, write_bytes};

/// In words.
fn extras(contents: impl AsRef<[u8]>, format: Format) -> Vec<String> {
    document(contents, format).extras.iter().map(Extra::to_string).collect()
}

#[test]
fn a_plain_mesh_has_none() {
    for format in Format::ALL {
        assert!(extras(write_bytes(&small_tetrahedron(), format).unwrap(), format).is_empty(), "{format:?}");
    }
}

#[test]
fn only_normals_can_be_made_again() {
    assert!(!Extra::Normals.is_lost());
    assert!(Extra::TextureCoordinates.is_lost() && Extra::Materials(1).is_lost());
}

#[test]
fn of_an_obj() {
    let text = "mtllib a.mtl\no one\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvt 0 0\nvn 0 0 1\nusemtl red paint\nf 1/1/1 2/1/1 3/1/1\n\
                o two\ng two\nusemtl blue\nf 1 2 3\nusemtl red paint\nf 1 2 3\nl 1 2\n";
    let expected = ["normals", "texture coordinates", "colours", "2 materials", "the names of 2 parts", "points or lines"];
    assert_eq!(extras(text, Format::Obj), expected);
    let curves = "v 0 0 0\nv 1 0 0\nv 0 1 0 2\no only\nf 1 2 3\ncstype bezier\ncurv 0 1 1 2 3\np 1\n";
    assert_eq!(extras(curves, Format::Obj), ["free-form curves or surfaces", "points or lines"]);
}

#[test]
fn of_a_ply() {
    let text = "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                property float nx\nproperty uchar red\nproperty float s\nproperty float quality\nelement face 1\n\
                property list uchar int vertex_indices\nproperty int label\nelement camera 1\nproperty float f\nelement none 0\n\
                property float g\nend_header\n0 0 0 1 255 0 7\n1 0 0 1 255 0 7\n0 1 0 1 255 0 7\n3 0 1 2 4\n1\n";
    let expected = ["normals", "texture coordinates", "colours", "1 texture", "the properties quality, label, camera"];
    assert_eq!(extras(text, Format::Ply), expected);
}

#[test]
fn of_an_stl() {
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    assert!(extras(format!("solid a\n{facet}endsolid a\n"), Format::Stl).is_empty());
    let two = format!("solid a\n{facet}endsolid a\nsolid b\n{facet}endsolid b\n");
    assert_eq!(extras(two, Format::Stl), ["the names of 2 parts"]);
    let mut binary = write_bytes(&small_tetrahedron(), Format::Stl).unwrap();
    *binary.last_mut().unwrap() = 0x80;
    assert_eq!(extras(binary, Format::Stl), ["attributes of faces"]);
}

#[test]
fn of_an_off() {
    let with = |header: &str, vertex: &str, face: &str| {
        extras(format!("{header}\n3 1 0\n0 0 0{vertex}\n1 0 0{vertex}\n0 1 0{vertex}\n3 0 1 2{face}\n"), Format::Off)
    };
    assert!(with("OFF", " # no colour", "").is_empty());
    assert_eq!(with("COFF", " 255 0 0 255", ""), ["colours"]);
    assert_eq!(with("OFF", "", " 1 0 0"), ["colours"]);
    assert_eq!(with("STNOFF", " 0 0 1 .5 .5", ""), ["normals", "texture coordinates"]);
}

#[test]
fn of_a_gltf() {
    let text = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "materials":[{},{}],"textures":[{"source":0}],"images":[{"uri":"a.png"}],"skins":[{"joints":[0]}],
        "animations":[{"channels":[],"samplers":[]}],"scene":0,"scenes":[{"nodes":[0,1]},{"nodes":[]}],
        "nodes":[{"mesh":0,"name":"a"},{"mesh":0,"name":"b"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0,"TEXCOORD_0":0,"COLOR_0":0,"_OWN":0},"targets":[{"POSITION":0}]},
        {"attributes":{"POSITION":0},"mode":0}]}]}"#;
    let expected = [
        "normals",
        "texture coordinates",
        "colours",
        "2 materials",
        "1 texture",
        "the names of 2 parts",
        "1 other scene",
        "1 animation",
        "1 skeleton",
        "morph targets",
        "points or lines",
    ];
    assert_eq!(extras(text, Format::Gltf), expected);
    assert_eq!(document(text, Format::Gltf).soup.triangles.len(), 2);
}
