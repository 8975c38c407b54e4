//! Reading and writing gltf.

use crate::{check_refused, document, small_tetrahedron};
use glam::DVec3;
use mesh_core::TriMesh;
use mesh_io::Format::{Glb, Gltf};
use mesh_io::{Attributes, Document, Level, Settings, WriteError, read, read_bytes, write_bytes, write_bytes_with, write_levels};
use std::path::Path;

/// A 1 x 1 square of 4 points, (0 0 0) (1 0 0) (0 1 0) (1 1 0), then the indices 0 1 2 3 as u16, as a base64 data URI.
fn square_buffer() -> String {
    let mut bytes = Vec::new();
    for x in [0f32, 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.] {
        bytes.extend(x.to_le_bytes());
    }
    for i in [0u16, 1, 2, 3] {
        bytes.extend(i.to_le_bytes());
    }
    data_uri(&bytes)
}

fn data_uri(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let bits: Vec<u8> = bytes.iter().flat_map(|b| (0..8).rev().map(move |i| b >> i & 1)).collect();
    let digit = |c: &[u8]| char::from(DIGITS[(0..6).fold(0, |d, i| d * 2 + usize::from(*c.get(i).unwrap_or(&0)))]);
    format!("data:application/octet-stream;base64,{}", bits.chunks(6).map(digit).collect::<String>())
}

/// A document around the square: accessor 0 holds 4 positions, accessor 1 4 indices, accessor 2 the first 3 of them.
fn file(rest: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":56,"uri":"{}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":8}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
        {{"bufferView":1,"componentType":5123,"count":4,"type":"SCALAR"}},{{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}}],
        {rest}}}"#,
        square_buffer()
    )
}

fn mesh(primitives: &str) -> Document {
    document(file(&format!(r#""meshes":[{{"primitives":[{primitives}]}}]"#)), Gltf)
}

const TRIANGLE: &str = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":2}]}]"#;

#[test]
fn modes() {
    let of = |mode: u32| mesh(&format!(r#"{{"attributes":{{"POSITION":0}},"indices":1,"mode":{mode}}}"#)).soup.triangles;
    assert_eq!(of(5), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(of(6), [[0, 1, 2], [0, 2, 3]]);
    for skipped in 0..4 {
        assert!(of(skipped).is_empty());
    }
    let unindexed = mesh(r#"{"attributes":{"POSITION":0},"mode":5}"#);
    assert_eq!(unindexed.soup.triangles, [[0, 1, 2], [2, 1, 3]]);
}

#[test]
fn primitives_share_the_vertices_of_a_shared_accessor() {
    let d = mesh(r#"{"attributes":{"POSITION":0},"indices":2},{"attributes":{"POSITION":0},"indices":1,"mode":6}"#);
    assert_eq!(d.soup.positions.len(), 4);
    assert_eq!(d.soup.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3]]);
    assert_eq!(d.polygon_of, [0, 1, 2]);
}

#[test]
fn nodes_place_instances() {
    let half_turn = r#"{"mesh":0,"rotation":[0,0,1,0],"translation":[10,0,0],"scale":[2,2,2]}"#;
    let mirror = r#"{"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}"#;
    let nodes = format!(
        r#""scene":0,"scenes":[{{"nodes":[2]}}],"nodes":[{half_turn},{mirror},{{"children":[0,1],"translation":[0,100,0]}},{{"mesh":0}}]"#
    );
    let d = document(file(&format!("{TRIANGLE},{nodes}")), Gltf);
    let expected = [
        [10., 100., 0.],
        [8., 100., 0.],
        [10., 98., 0.],
        [8., 98., 0.],
        [0., 100., 5.],
        [-1., 100., 5.],
        [0., 101., 5.],
        [-1., 101., 5.],
    ];
    for (p, e) in d.soup.positions.iter().zip(expected) {
        assert!(p.distance(e.into()) < 1e-12, "{p} {e:?}");
    }
    // The mirrored one is turned round.
    assert_eq!((d.soup.positions.len(), d.soup.triangles), (8, vec![[0, 1, 2], [4, 6, 5]]));
}

#[test]
fn without_a_scene_the_nodes_without_parent_are_it() {
    let d = document(file(&format!(r#"{TRIANGLE},"nodes":[{{"mesh":0}},{{"children":[0],"translation":[0,0,7]}}]"#)), Gltf);
    assert_eq!(d.soup.positions[0], DVec3::new(0.0, 0.0, 7.0));
    assert_eq!(d.soup.triangles.len(), 1);
}

#[test]
fn quantized_interleaved_and_sparse_positions() {
    // Three points of 3 normalised i8 in steps of 4 bytes, then the sparse index 1 as u8, then its position.
    let bytes = [127i8, 0, 0, 99, 0, 127, 0, 99, 0, 0, -127, 99, 1, 0, 0, 0, 127, 127, -128, 0].map(|b| b as u8);
    let json = |sparse: &str, view: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"extensionsRequired":["KHR_mesh_quantization"],"buffers":[{{"byteLength":20,"uri":"{}"}}],
            "bufferViews":[{{"buffer":0,"byteLength":12,"byteStride":4}},{{"buffer":0,"byteOffset":12,"byteLength":1}},
            {{"buffer":0,"byteOffset":16,"byteLength":3}}],
            "accessors":[{{{view}"componentType":5120,"normalized":true,"count":3,"type":"VEC3"{sparse}}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}]}}"#,
            data_uri(&bytes)
        )
    };
    let view = r#""bufferView":0,"#;
    let sparse = r#","sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":2}}"#;
    let replaced = DVec3::new(1.0, 1.0, -1.0);
    assert_eq!(document(json("", view), Gltf).soup.positions, [DVec3::X, DVec3::Y, -DVec3::Z]);
    assert_eq!(document(json(sparse, view), Gltf).soup.positions, [DVec3::X, replaced, -DVec3::Z]);
    assert_eq!(document(json(sparse, ""), Gltf).soup.positions, [DVec3::ZERO, replaced, DVec3::ZERO]);
    check_refused(json(sparse, "").replace("\"count\":3", "\"count\":4000000"), Gltf, None, "4000000 elements without data");
}

#[test]
fn buffers_in_other_files() {
    let directory = tempfile::tempdir().unwrap();
    let glb = write_bytes(&small_tetrahedron(), Glb).unwrap();
    let json_length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let json = String::from_utf8(glb[20..20 + json_length].to_vec()).unwrap();
    let json = json.replace(r#""buffers":[{"#, r#""buffers":[{"uri":"a%20buffer.bin","#);
    std::fs::write(directory.path().join("mesh.gltf"), &json).unwrap();
    let missing = read(&directory.path().join("mesh.gltf")).unwrap_err().to_string();
    assert!(missing.contains("a buffer.bin"), "{missing}");
    std::fs::write(directory.path().join("a buffer.bin"), &glb[28 + json_length..]).unwrap();
    assert_eq!(read(&directory.path().join("mesh.gltf")).unwrap().soup, small_tetrahedron().to_soup());
    check_refused(&json, Gltf, None, "a buffer in another file, a buffer.bin");
    check_refused(json.replace("a%20buffer.bin", "https://a.b/c"), Gltf, None, "a buffer at https://a.b/c");
}

#[test]
fn indices_out_of_range_stay_so() {
    let text = file(r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":2}]}]"#);
    let two_points = text.replacen("\"count\":4", "\"count\":2", 1);
    let d = document(two_points, Gltf);
    assert_eq!((d.soup.triangles, d.polygons_out_of_range), (vec![[0, 1, u32::MAX]], vec![0]));
}

#[test]
fn a_file_may_have_the_extension_of_the_other_kind() {
    let mesh = small_tetrahedron();
    assert_eq!(document(write_bytes(&mesh, Glb).unwrap(), Gltf), document(write_bytes(&mesh, Gltf).unwrap(), Glb));
}

#[test]
fn faults_are_told() {
    let ok = file(TRIANGLE);
    let with = |from: &str, to: &str| ok.replacen(from, to, 1);
    assert!(read_bytes(ok.as_bytes(), Gltf).is_ok());
    check_refused("{", Gltf, None, "gltf: ");
    check_refused(
        with("\"meshes\"", r#""extensionsRequired":["KHR_draco_mesh_compression"],"meshes""#),
        Gltf,
        None,
        "KHR_draco_mesh_compression",
    );
    check_refused(
        with("\"meshes\"", r#""extensionsRequired":["EXT_meshopt_compression"],"meshes""#),
        Gltf,
        None,
        "EXT_meshopt_compression",
    );
    check_refused(with("\"count\":4", "\"count\":4000000000"), Gltf, None, "unfolds to");
    check_refused(with("\"count\":4", "\"count\":18446744073709551615"), Gltf, None, "unfolds to");
    check_refused(with("\"count\":4", "\"count\":5"), Gltf, None, "past the end");
    check_refused(with("\"byteLength\":48", "\"byteLength\":57"), Gltf, None, "past the end");
    check_refused(with("\"byteLength\":48", "\"byteStride\":4,\"byteLength\":48"), Gltf, None, "in steps of 4");
    check_refused(with("\"byteOffset\":48", "\"byteOffset\":18446744073709551615"), Gltf, None, "past the end");
    check_refused(with("\"POSITION\":0", "\"POSITION\":9"), Gltf, None, "accessor that does not exist");
    check_refused(with("\"POSITION\":0", "\"POSITION\":1"), Gltf, None, "1 components instead of 3");
    check_refused(with("\"indices\":2", "\"indices\":1"), Gltf, None, "4 corners, not a multiple of 3");
    check_refused(with("base64,", "base64,!"), Gltf, None, "not base64");
    check_refused(
        with(TRIANGLE, &format!(r#"{TRIANGLE},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"children":[0]}}]"#)),
        Gltf,
        None,
        "its own ancestor",
    );
    check_refused(b"glTF\x02\0\0\0\x01\0\0\0", Glb, None, "header is not complete");
}

#[test]
fn a_small_file_that_unfolds_to_a_giant_is_refused() {
    let nodes = vec![r#"{"mesh":0}"#; 2_000].join(",");
    let text = file(&format!(r#"{TRIANGLE},"nodes":[{nodes}]"#));
    assert_eq!(document(&text, Gltf).soup.triangles.len(), 2_000);
    let many = text.replacen("\"count\":4", "\"count\":100000", 1);
    check_refused(many, Gltf, None, "unfolds to 200006000 vertices and corners");
}

/// A triangle and its subdivision: what knows no levels of detail reads the finest one, and each is a mesh by name.
#[test]
fn levels_are_meshes_of_one_file() {
    let positions = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let coarse = TriMesh::from_slices(&positions[..3], &[[0, 1, 2]]).unwrap();
    let fine = TriMesh::from_slices(&positions, &[[0, 3, 5], [1, 4, 3], [2, 5, 4], [4, 5, 3]]).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let attributes = Attributes::default();
    let write = |path: &Path, levels: &[&TriMesh]| {
        let settings = Settings { attributes: &attributes, lines: &[] };
        write_levels(path, &levels.iter().map(|mesh| Level { mesh, settings }).collect::<Vec<_>>())
    };
    for name in ["levels.glb", "levels.gltf"] {
        let path = folder.path().join(name);
        write(&path, &[&coarse, &fine]).unwrap();
        assert_eq!(read(&path).unwrap().soup, fine.to_soup());
    }
    let json: gltf_json::Root = gltf_json::Root::from_slice(&std::fs::read(folder.path().join("levels.gltf")).unwrap()).unwrap();
    let names: Vec<_> = json.meshes.iter().map(|mesh| mesh.name.clone().unwrap()).collect();
    assert_eq!((names, json.extensions_used), (vec!["level 1".to_owned(), "level 0".to_owned()], vec!["MSFT_lod".to_owned()]));
    // The coarse one alone, as a scene of its own.
    let text = std::fs::read_to_string(folder.path().join("levels.gltf")).unwrap();
    let coarse_alone = document(text.replace(r#""scenes":[{"nodes":[0]}]"#, r#""scenes":[{"nodes":[1]}]"#), Gltf);
    assert_eq!(coarse_alone.soup, coarse.to_soup());
    assert!(matches!(write(&folder.path().join("a.obj"), &[&fine]), Err(WriteError::OneLevel { .. })));
    let moved = coarse.with_positions(coarse.positions().iter().map(|p| *p + 1.0).collect()).unwrap();
    for (levels, level) in [(vec![], 0), (vec![&moved, &fine], 0), (vec![&coarse, &fine, &coarse], 1)] {
        let refused = write(&folder.path().join("a.glb"), &levels);
        assert!(matches!(refused, Err(WriteError::NoLevel { level: l }) if l == level), "{refused:?}");
    }
}

/// A map of normals has its frame in the file, and the bitangent points up in the picture, also where the picture is mirrored. Without such a map
/// there are no tangents.
#[test]
fn maps_of_normals_have_tangents() {
    let square = document(file(r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5}]}]"#), Gltf).soup;
    let mesh = TriMesh::new(square.positions, square.triangles).unwrap();
    let looks =
        |map: &str| document(file(&format!(r#""materials":[{{"{map}":{{"index":0}}}}],{TRIANGLE}"#)), Gltf).attributes.looks;
    for (map, mirrored) in [("normalTexture", 1.0), ("normalTexture", -1.0), ("occlusionTexture", 1.0)] {
        let uv = |p: DVec3| glam::DVec2::new(mirrored * p.x, p.y);
        let uvs = vec![mesh.faces().iter().map(|f| f.map(|v| uv(mesh.position(v)))).collect()];
        let attributes = Attributes { normals: vec![[DVec3::Z; 3]; 2], uvs, looks: looks(map), ..Attributes::default() };
        let bytes = write_bytes_with(&mesh, &Settings { attributes: &attributes, lines: &[] }, Glb).unwrap();
        let glb = gltf::Glb::from_slice(&bytes).unwrap();
        let root: serde_json::Value = serde_json::from_slice(&glb.json).unwrap();
        let accessor = &root["meshes"][0]["primitives"][0]["attributes"]["TANGENT"];
        assert_eq!(accessor.is_null(), map != "normalTexture");
        if let Some(accessor) = accessor.as_u64() {
            let view = &root["bufferViews"][root["accessors"][accessor as usize]["bufferView"].as_u64().unwrap() as usize];
            let start = view["byteOffset"].as_u64().unwrap() as usize;
            let numbers = glb.bin.unwrap()[start..start + view["byteLength"].as_u64().unwrap() as usize].to_vec();
            let numbers: Vec<f32> = numbers.chunks(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
            for tangent in numbers.chunks(4) {
                let along = DVec3::new(tangent[0].into(), tangent[1].into(), tangent[2].into());
                assert!((along - mirrored * DVec3::X).length() < 1e-6, "{tangent:?}");
                let bitangent = DVec3::Z.cross(along) * f64::from(tangent[3]);
                assert!((bitangent - DVec3::Y).length() < 1e-6, "{tangent:?}");
            }
            assert_eq!(numbers.len(), 16);
        }
    }
}
