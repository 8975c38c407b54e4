//! Writes the seeds, `corpus/<target>/*`: small fixtures in every format, and files that use the rarer parts of each.

use mesh_core::{CleanOptions, TriMesh, clean};
use mesh_io::{Array, Format, Numbers, array_bytes, write_bytes};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

type Failure = Box<dyn std::error::Error>;

/// Small, so that the fuzzer makes many runs a second.
const FIXTURES: [&str; 4] = ["box12.obj", "plane.off", "cad_small.obj", "shell_small.obj"];

/// Files by hand: target, name, contents.
const BY_HAND: [(&str, &str, &str); 9] = [
    ("obj", "parts", "# c\no a\nv 0 0 0\nv 1 0 0 1\nv 1 1 0 .1 .2 .3\nvt 0 0\nvn 0 0 1\nusemtl m\nf 1/1 2//1 \\\n -1\nf 1 2 9\n"),
    ("obj", "polygon", "g p\nv 0 0 0\nv 1 0 0\nv 1 1 nan\nv 0 1 1e400\ns off\nf -4 -3 -2 -1\nl 1 2\n"),
    ("off", "colors", "COFF # c\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2 255 0 0\n"),
    ("off", "glued", "OFF4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
    (
        "stl",
        "text",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
    ),
    (
        "ply",
        "strips",
        "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
         property list uchar int vertex_indices\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n\
         0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n5 0 1 2 -1 0\n",
    ),
    (
        "ply",
        "big_endian",
        "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty short x\nproperty short y\nproperty double z\n\
         element face 1\nproperty list uchar ushort vertex_index\nend_header\n\0\x01\0\x02AAAAAAAA\x03\0\0\0\0\0\0",
    ),
    (
        "gltf",
        "sparse",
        r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":24,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAA"}],
        "bufferViews":[{"buffer":0,"byteLength":24,"byteStride":12}],"accessors":[{"bufferView":0,"componentType":5126,"count":2,
        "type":"VEC3","sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":5}]}],"scene":0,"scenes":[{"nodes":[0]}],
        "nodes":[{"children":[1]},{"mesh":0,"rotation":[0,0,0,1],"scale":[1,1,-1]}]}"#,
    ),
    (
        "gltf",
        "normalized",
        r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":18,"uri":"data:;base64,AAAAAAAA/38AAAAAAAD/fwAA"}],
        "bufferViews":[{"buffer":0,"byteLength":18}],"accessors":[{"bufferView":0,"componentType":5122,"normalized":true,"count":3,
        "type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}],"nodes":[{"mesh":0,
        "matrix":[2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1]}]}"#,
    ),
];

fn main() -> Result<(), Failure> {
    let fuzz = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    for file in FIXTURES {
        let mesh = load(&fuzz.join("../fixtures/data").join(file))?;
        for format in Format::ALL {
            let target = if format == Format::Glb { "gltf" } else { format.extension() };
            save(&fuzz, target, &format!("{file}.{}", format.extension()), &write_bytes(&mesh, format)?)?;
        }
        save(&fuzz, "ply", &format!("{file}.text"), text_ply(&mesh)?.as_bytes())?;
        save(&fuzz, "stl", &format!("{file}.text"), text_stl(&mesh)?.as_bytes())?;
    }
    for (target, name, contents) in BY_HAND {
        save(&fuzz, target, name, contents.as_bytes())?;
    }
    let array = |name: &str, shape: &[usize], values| Array { name: name.to_owned(), shape: shape.to_vec(), values };
    let arrays = [
        array("a", &[2, 1], Numbers::Float(vec![0.5, 1.0].into())),
        array("b", &[3], Numbers::Int(vec![1, 2, 3].into())),
        array("c", &[], Numbers::Int32(vec![7].into())),
    ];
    save(&fuzz, "npz", "arrays", &array_bytes(&arrays)?)
}

fn load(path: &Path) -> Result<TriMesh, Failure> {
    Ok(clean(&mesh_io::read(path)?.soup, &CleanOptions::default())?.mesh)
}

fn save(fuzz: &Path, target: &str, name: &str, bytes: &[u8]) -> Result<(), Failure> {
    let folder = fuzz.join("corpus").join(target);
    std::fs::create_dir_all(&folder)?;
    Ok(std::fs::write(folder.join(name), bytes)?)
}

/// `mesh-io` writes binary ply and stl only.
fn text_ply(mesh: &TriMesh) -> Result<String, Failure> {
    let mut text = format!("ply\nformat ascii 1.0\nelement vertex {}\n", mesh.n_vertices());
    text += "property float x\nproperty float y\nproperty float z\n";
    writeln!(text, "element face {}\nproperty list uchar int vertex_indices\nend_header", mesh.n_faces())?;
    for p in mesh.positions() {
        writeln!(text, "{} {} {}", p.x, p.y, p.z)?;
    }
    for [a, b, c] in mesh.faces() {
        writeln!(text, "3 {} {} {}", a.0, b.0, c.0)?;
    }
    Ok(text)
}

fn text_stl(mesh: &TriMesh) -> Result<String, Failure> {
    let mut text = "solid\n".to_owned();
    for f in mesh.faces().ids() {
        text += "facet normal 0 0 0\nouter loop\n";
        for p in mesh.triangle(f) {
            writeln!(text, "vertex {} {} {}", p.x, p.y, p.z)?;
        }
        text += "endloop\nendfacet\n";
    }
    Ok(text + "endsolid\n")
}
