//! What a mesh has beside positions is read, and comes back when it was written.

use crate::{document, small_tetrahedron};
use glam::{DVec2, DVec3};
use mesh_core::TriMesh;
use mesh_io::Format::{Glb, Gltf, Obj, Ply};
use mesh_io::{Attributes, Document, Extra, Format, Labels, Settings, ValueKind, Values, WriteError, write_bytes_with};

/// Two triangles that share an edge, each with a normal, texture coordinates and a material of its own.
fn roof() -> (TriMesh, Attributes) {
    let positions = vec![DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(-0.5, 0.0, -1.0), DVec3::splat(9.0)];
    let mesh = TriMesh::new(positions, vec![[1, 0, 2], [0, 1, 3]]).unwrap();
    let uv = |x: f64| [DVec2::new(x, 0.25), DVec2::new(x + 0.5, 0.25), DVec2::new(x, 0.75)];
    let attributes = Attributes {
        normals: vec![[DVec3::Z; 3], [DVec3::NEG_X; 3]],
        uvs: vec![vec![uv(0.0), uv(0.5)]],
        materials: Labels { names: vec!["red paint".to_owned(), "tin".to_owned()], of_face: vec![1, 0] },
        ..Attributes::default()
    };
    (mesh, attributes)
}

fn written(mesh: &TriMesh, attributes: &Attributes, format: Format) -> Document {
    document(write_bytes_with(mesh, &Settings { attributes, lines: &[[0, 1]] }, format).unwrap(), format)
}

#[test]
fn of_corners_come_back_and_vertices_keep_their_order() {
    let (mesh, attributes) = roof();
    for format in [Obj, Gltf, Glb] {
        let read = written(&mesh, &attributes, format);
        assert_eq!(read.soup, mesh.to_soup(), "{format:?}");
        assert_eq!((&read.attributes.normals, &read.attributes.uvs), (&attributes.normals, &attributes.uvs), "{format:?}");
        let name = |f| read.attributes.materials.name(f);
        assert_eq!((name(0), name(1)), (Some("tin"), Some("red paint")), "{format:?}");
        assert!(read.extras.contains(&Extra::PointsOrLines));
    }
    assert_eq!(written(&mesh, &attributes, Obj).lines, [[0, 1]]);
}

#[test]
fn a_gltf_has_copies_of_vertices_after_all_others() {
    let (mesh, attributes) = roof();
    let text = write_bytes_with(&mesh, &Settings { attributes: &attributes, lines: &[] }, Gltf).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains(r#""copy_of":[0,1]"#), "the vertices of the shared edge: {text}");
    // Of a file whose copies are elsewhere they are vertices like all others.
    let wrong = text.replace(r#""copy_of":[0,1]"#, r#""copy_of":[0,2]"#);
    assert_eq!(document(wrong, Gltf).soup.positions.len(), 7);
    let nonsense = text.replace(r#""copy_of":[0,1]"#, r#""copy_of":[0,-1,900,"x"]"#);
    assert_eq!(document(nonsense, Gltf).soup.positions.len(), 7);
}

#[test]
fn a_ply_has_normals_where_each_vertex_has_one() {
    let (mesh, attributes) = roof();
    let split = written(&mesh, &attributes, Ply);
    assert_eq!((&split.attributes.normals, &split.attributes.uvs), (&Vec::new(), &attributes.uvs));
    assert_eq!((&split.soup, &split.lines), (&mesh.to_soup(), &vec![[0, 1]]));
    let smooth = Attributes { normals: vec![[DVec3::Y; 3]; 2], ..Attributes::default() };
    assert_eq!(written(&mesh, &smooth, Ply).attributes, smooth);
}

#[test]
fn values_and_labels_of_a_ply_come_back() {
    let values = |name: &str, kind, values: Vec<f64>| Values { name: name.to_owned(), kind, values };
    let attributes = Attributes {
        colors: vec![[1.0, 0.0, 51.0 / 255.0, 1.0], [0.0, 0.0, 0.0, 0.2], [1.0; 4], [0.0; 4]],
        face_colors: vec![[0.2, 0.4, 0.6, 1.0]; 4],
        vertex_values: vec![
            values("heat", ValueKind::Single, vec![0.5, -1.0, 2.0, 3.0]),
            values("depth", ValueKind::Double, vec![0.1, 0.2, 0.3, 0.4]),
        ],
        face_values: vec![
            values("part", ValueKind::Label, vec![-7.0, 1.0, 2.0, 3.0]),
            values("id", ValueKind::Label, vec![4294967295.0, 1.0, 2.0, 3.0]),
        ],
        ..Attributes::default()
    };
    let read = written(&small_tetrahedron(), &attributes, Ply).attributes;
    assert_eq!((&read.vertex_values, &read.face_values), (&attributes.vertex_values, &attributes.face_values));
    assert_eq!((&read.colors, &read.face_colors), (&attributes.colors, &attributes.face_colors));
}

#[test]
fn an_obj_says_what_holds_for_each_face() {
    let text = "mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nvn nan x 0\n\
                g part one\ns 3\nf 1/1/1 2/2/2 3/-1/1\ng\nusemtl a\ns off\nf 1 2 4 3\n";
    let Document { attributes: a, soup, .. } = document(text, Obj);
    assert_eq!(soup.triangles.len(), 3);
    assert_eq!(a.uvs[0][0], [DVec2::ZERO, DVec2::X, DVec2::Y]);
    assert!(a.uvs[0][1..].as_flattened().iter().all(|uv| uv.is_nan()) && a.normals[0][1].is_nan());
    assert_eq!((a.normals[0][0], a.smoothing), (DVec3::Z, vec![3, 0, 0]));
    assert_eq!((a.materials.name(0), a.materials.name(2), a.groups.name(0)), (None, Some("a"), Some("part one")));
    assert_eq!(a.colors, [[1.0, 0.0, 0.0, 1.0], [1.0; 4], [1.0; 4], [1.0; 4]]);
}

#[test]
fn small_meshes_have_small_indices() {
    let bytes = |n: usize| {
        let mut positions = small_tetrahedron().position_arrays();
        positions.resize(n, [0.0; 3]);
        let mesh = TriMesh::from_slices(&positions, &small_tetrahedron().face_arrays()).unwrap();
        let text = write_bytes_with(&mesh, &Settings { attributes: &Attributes::default(), lines: &[] }, Gltf).unwrap();
        assert_eq!(document(&text, Gltf).soup, mesh.to_soup());
        String::from_utf8(text).unwrap().contains("5123")
    };
    assert_eq!((bytes(65535), bytes(65536)), (true, false));
}

#[test]
fn arrays_of_another_mesh_are_refused() {
    let (mesh, mut attributes) = roof();
    attributes.normals.pop();
    let refused =
        |attributes: &Attributes, lines: &[[u32; 2]]| write_bytes_with(&mesh, &Settings { attributes, lines }, Obj).unwrap_err();
    assert!(matches!(refused(&attributes, &[]), WriteError::AttributeCount { found: 1, expected: 2, .. }));
    let none = Attributes::default();
    assert!(matches!(refused(&none, &[[0, 5]]), WriteError::NoSuchVertex { vertex: 5, vertices: 5 }));
}
