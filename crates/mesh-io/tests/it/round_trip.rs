//! What is written is read back, to the last bit that the format has room for.

use crate::{document, small_tetrahedron, tetrahedron};
use glam::DVec3;
use mesh_core::{FaceId, TriMesh, VertexId};
use mesh_io::{Format, WriteError, read, read_bytes, write, write_bytes, write_colored_ply};
use proptest::prelude::*;
use std::fs;
use std::path::Path;

const INDEXED: [Format; 5] = [Format::Obj, Format::Ply, Format::Off, Format::Gltf, Format::Glb];

fn bits(positions: &[DVec3]) -> Vec<[u64; 3]> {
    positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

/// Writes and reads in memory; the same bits and indices must come back (in stl: the same corners of each face).
fn check(mesh: &TriMesh, format: Format) {
    let read = document(write_bytes(mesh, format).unwrap(), format);
    if format == Format::Stl {
        let corners: Vec<DVec3> = mesh.faces().iter().flatten().map(|&v| mesh.position(v)).collect();
        assert_eq!(bits(&read.soup.positions), bits(&corners));
        assert!(read.soup.triangles.as_flattened().iter().copied().eq(0..3 * mesh.n_faces() as u32));
    } else {
        let soup = mesh.to_soup();
        assert_eq!(read.soup.triangles, soup.triangles, "{format:?}");
        assert_eq!(bits(&read.soup.positions), bits(&soup.positions), "{format:?}");
    }
    assert!(read.polygon_of.iter().copied().eq(0..mesh.n_faces() as u32));
    assert_eq!((read.n_polygons, read.n_polygons_above_3), (mesh.n_faces(), 0));
    assert!(read.polygons_out_of_range.is_empty());
}

#[test]
fn double_precision_formats_keep_every_bit() {
    for format in [Format::Obj, Format::Ply, Format::Off] {
        check(&tetrahedron(), format);
    }
}

#[test]
fn single_precision_formats_keep_single_precision() {
    for format in Format::ALL {
        check(&small_tetrahedron(), format);
    }
}

#[test]
fn single_precision_formats_refuse_what_does_not_fit() {
    for format in [Format::Stl, Format::Gltf, Format::Glb] {
        let e = write_bytes(&tetrahedron(), format).unwrap_err();
        assert!(matches!(e, WriteError::NotSinglePrecision { vertex: 3 }), "{e}");
    }
}

#[test]
fn vertices_without_faces_and_empty_meshes_return() {
    let p = small_tetrahedron().positions().as_slice().to_vec();
    let one_face = TriMesh::new(p.clone(), vec![[3, 1, 2]]).unwrap();
    for format in INDEXED {
        check(&one_face, format);
    }
    for format in Format::ALL {
        check(&TriMesh::new(vec![], vec![]).unwrap(), format);
    }
    for format in [Format::Obj, Format::Ply, Format::Off] {
        check(&TriMesh::new(p.clone(), vec![]).unwrap(), format);
    }
}

proptest! {
    #[test]
    fn random_meshes_return(
        coordinates in prop::collection::vec(prop::array::uniform3(prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO), 3..40),
        corners in prop::collection::vec(prop::array::uniform3(0u32..1000), 0..60),
    ) {
        let n = coordinates.len() as u32;
        let faces = corners.into_iter().map(|f| f.map(|i| i % n)).filter(|[a, b, c]| a != b && b != c && c != a).collect();
        let mesh = TriMesh::new(coordinates.into_iter().map(DVec3::from).collect(), faces).unwrap();
        for format in [Format::Obj, Format::Ply, Format::Off] {
            check(&mesh, format);
        }
        let single = mesh.positions().iter().map(|p| p.to_array().map(|x| f64::from(x.sin() as f32)).into()).collect();
        let single = mesh.with_positions(single).unwrap();
        for format in Format::ALL {
            if mesh.n_faces() > 0 {
                check(&single, format);
            }
        }
    }
}

#[test]
fn files_are_replaced_and_nothing_else_is_left() {
    let directory = tempfile::tempdir().unwrap();
    for format in Format::ALL {
        let path = directory.path().join(format!("mesh.{}", format.extension().to_uppercase()));
        fs::write(&path, "old").unwrap();
        write(&path, &small_tetrahedron()).unwrap();
        assert_eq!(fs::read(&path).unwrap(), write_bytes(&small_tetrahedron(), format).unwrap());
        assert_eq!(read(&path).unwrap().soup.triangles.len(), 4);
    }
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), Format::ALL.len());
}

#[test]
fn failed_writes_leave_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let taken = directory.path().join("a directory.obj");
    fs::create_dir(&taken).unwrap();
    assert!(matches!(write(&taken, &tetrahedron()), Err(WriteError::Io { .. })));
    let nowhere = directory.path().join("none").join("mesh.obj");
    assert!(matches!(write(&nowhere, &tetrahedron()), Err(WriteError::Io { .. })));
    let unknown = directory.path().join("mesh.step");
    assert!(matches!(write(&unknown, &tetrahedron()), Err(WriteError::UnknownFormat { .. })));
    let too_large = directory.path().join("mesh.stl");
    assert!(matches!(write(&too_large, &tetrahedron()), Err(WriteError::NotSinglePrecision { .. })));
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
}

#[test]
fn missing_and_unknown_files_are_named() {
    assert!(read(Path::new("no/such.obj")).unwrap_err().to_string().starts_with("cannot read no/such.obj;"));
    assert!(read(Path::new("a.step")).unwrap_err().to_string().starts_with("a.step: the extension"));
}

#[test]
fn colours_go_with_their_faces() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("colours.ply");
    let mesh = tetrahedron();
    let colors = [[1, 2, 3], [4, 5, 6], [7, 8, 9], [10, 11, 12]];
    write_colored_ply(&path, &mesh, &colors, &[]).unwrap();
    let bytes = fs::read(&path).unwrap();
    assert_eq!(read_bytes(&bytes, Format::Ply).unwrap().soup, mesh.to_soup());
    let row = 1 + 12 + 3;
    for (f, color) in colors.iter().enumerate() {
        let start = bytes.len() - row * (4 - f);
        assert_eq!(bytes[start + 13..start + row], color[..]);
        assert_eq!(bytes[start + 1..start + 5], mesh.face(FaceId(f as u32))[0].0.to_le_bytes());
    }
    assert_eq!(mesh.face(FaceId(3))[0], VertexId(3));
    let e = write_colored_ply(&path, &mesh, &colors[..3], &[]).unwrap_err();
    assert!(matches!(e, WriteError::ColorCount { colors: 3, faces: 4 }));
}

#[test]
fn coloured_points_come_after_the_vertices() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("points.ply");
    let mesh = tetrahedron();
    let point = (DVec3::new(0.5, 0.25, 3.0), [250, 251, 252]);
    write_colored_ply(&path, &mesh, &[[0; 3]; 4], &[point]).unwrap();
    let soup = read(&path).unwrap().soup;
    assert_eq!((&soup.triangles, soup.positions[4]), (&mesh.to_soup().triangles, point.0));
    assert!(fs::read(&path).unwrap().windows(3).any(|w| w == point.1));
}

/// Several files are all replaced, or none is.
#[test]
fn files_are_written_together() {
    let folder = tempfile::tempdir().unwrap();
    let names = || {
        let mut names: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
        names.sort();
        names
    };
    let file = |name: &str, text: &str| (folder.path().join(name), text.as_bytes().to_vec());
    mesh_io::write_files(&[file("a", "1"), file("b", "2")]).unwrap();
    let error = mesh_io::write_files(&[file("a", "3"), file("no/such", "4")]).unwrap_err();
    assert!(error.to_string().contains("such"), "{error}");
    assert_eq!(names(), ["a", "b"]);
    assert_eq!(fs::read(folder.path().join("a")).unwrap(), b"1");
    mesh_io::write_files(&[file("a", "3"), file("b", "4")]).unwrap();
    assert_eq!(fs::read(folder.path().join("b")).unwrap(), b"4");
}
