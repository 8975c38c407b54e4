//! Maps of small meshes: everything is on the sheet where it belongs.

use correspondence::{CorrespondenceError, FaceOrder, Levels, Map, Source, Start};
use glam::DVec3;
use mesh_core::{CleanOptions, Cleaned, FaceId, IdVec, Soup, TriMesh, VertexId, clean};

/// The cleaned mesh of a soup as its own result, its vertices moved, each with a start on one of its own faces.
fn map_of(soup: &Soup, cleaned: &Cleaned, moved: impl Fn(VertexId, FaceId) -> DVec3) -> (TriMesh, Map) {
    let own = |v: VertexId| cleaned.topology.faces_at(v).next().unwrap();
    let starts: IdVec<_, _> =
        cleaned.mesh.positions().enumerate().map(|(v, &position)| Start { face: own(v), position }).collect();
    let positions = cleaned.mesh.positions().ids().map(|v| moved(v, own(v))).collect();
    let result = cleaned.mesh.with_positions(positions).unwrap();
    let map = Map::new(&Source { soup, cleaned }, &result, 0, &starts, FaceOrder::Children).unwrap();
    (result, map)
}

fn cleaned(soup: &Soup) -> Cleaned {
    clean(soup, &CleanOptions::default()).unwrap()
}

fn triangle(soup: &Soup, face: u32) -> [DVec3; 3] {
    soup.triangles[face as usize].map(|v| soup.positions[v as usize])
}

/// Where the map says that a vertex of the result is.
fn rebuilt(soup: &Soup, map: &Map, v: usize) -> DVec3 {
    let corners @ [a, b, c] = triangle(soup, map.source_face[v]);
    let [_, y, z] = map.source_barycentric[v];
    a + y * (b - a) + z * (c - a) + map.offset[v] * mesh_core::normal(corners)
}

fn check_rebuilt(soup: &Soup, result: &TriMesh, map: &Map) {
    for (v, p) in result.positions().iter().enumerate() {
        assert!(rebuilt(soup, map, v).distance(*p) < 1e-12 * result.diagonal(), "vertex {v}");
        assert!((map.source_barycentric[v].iter().sum::<f64>() - 1.0).abs() < 1e-12, "vertex {v}");
    }
}

/// A plate much thinner than its vertices are lifted off it, or pushed through it: the inner ones of each side stay with that side.
#[test]
fn vertices_stay_on_their_side_of_a_thin_plate() {
    let soup = fixtures::cuboid(DVec3::new(1.0, 1.0, 1e-4), 6).to_soup();
    let cleaned = cleaned(&soup);
    for lift in [-0.05, 0.05] {
        let inner = |v: VertexId| {
            let mut faces = cleaned.topology.fan(v).map(|h| cleaned.mesh.normal(h.face()));
            let first = faces.next().unwrap();
            (first.z.abs() > 0.9 && faces.all(|n| n.dot(first) > 0.9)).then_some(first)
        };
        let (result, map) = map_of(&soup, &cleaned, |v, _| cleaned.mesh.position(v) + lift * inner(v).unwrap_or(DVec3::ZERO));
        check_rebuilt(&soup, &result, &map);
        let mut n_inner = 0;
        for v in result.positions().ids() {
            let Some(side) = inner(v) else { continue };
            let normal = mesh_core::normal(triangle(&soup, map.source_face[v.0 as usize]));
            assert!(normal.dot(side) > 0.9 && (map.offset[v.0 as usize] - lift).abs() < 1e-9, "vertex {v}");
            // Back to the vertex that it is, on the same side.
            let face = FaceId(map.result_face[v.0 as usize] as u32);
            assert!(result.normal(face).dot(side) > 0.0, "vertex {v}");
            n_inner += 1;
        }
        assert_eq!(n_inner, 2 * 5 * 5);
    }
}

/// A triangle that was turned over in the file has the offset of the other sign; one that is twice there is known by either.
#[test]
fn repairs_are_accounted_for() {
    let mut soup = fixtures::cube(3).to_soup();
    let n = soup.triangles.len();
    soup.triangles[5].swap(0, 1);
    soup.triangles.push([1, 2, 99]);
    soup.positions.push(DVec3::splat(0.3));
    soup.positions.push(soup.positions[4]);
    let cleaned = cleaned(&soup);
    let out = |v: VertexId, f: FaceId| cleaned.mesh.position(v) + 0.01 * cleaned.mesh.normal(f);
    let (result, map) = map_of(&soup, &cleaned, out);
    check_rebuilt(&soup, &result, &map);
    for (face, offset) in map.source_face.iter().zip(&map.offset) {
        assert!(*offset < 0.0 || *face != 5);
        assert!(*offset > 0.0 || *face == 5);
    }
    let n_vertices = soup.positions.len();
    assert_eq!((map.result_face[n_vertices - 2], map.result_face[n_vertices - 1]), (-1, map.result_face[4]));
    assert!(map.result_barycentric[n_vertices - 2].iter().all(|w| w.is_nan()));
    assert_eq!(map.result_face.iter().filter(|&&f| f < 0).count(), 1);
    assert!(map.source_face.iter().all(|&f| (f as usize) < n));
}

/// Two boxes that cut each other: no vertex is taken for one of the other box, though that may be nearer.
#[test]
fn parts_that_pass_through_each_other_are_kept_apart() {
    let soup = fixtures::crossing_boxes(4).to_soup();
    let cleaned = cleaned(&soup);
    let (part, n_parts) = cleaned.topology.components();
    assert_eq!(n_parts, 2);
    let (result, map) = map_of(&soup, &cleaned, |v, f| cleaned.mesh.position(v) + 0.02 * cleaned.mesh.normal(f));
    check_rebuilt(&soup, &result, &map);
    let part_at = |v: VertexId| part[cleaned.topology.fan(v).next().unwrap().face()];
    for v in result.positions().ids() {
        let source = cleaned.face_of[map.source_face[v.0 as usize] as usize].unwrap();
        assert_eq!(part[source], part_at(v));
    }
    for (v, face) in map.result_face.iter().enumerate() {
        assert_eq!(part[FaceId(*face as u32)], part_at(cleaned.vertex_of[v].unwrap()));
    }
}

/// A subdivided triangle pair, whose face order or numbering is then spoilt.
#[test]
fn what_is_no_subdivision_is_refused() {
    let positions =
        [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 1], [1, 2], [0, 1]].map(|[x, y]| [x, y, 0].map(f64::from));
    let faces = [[0, 4, 6], [1, 5, 4], [2, 6, 5], [5, 6, 4], [0, 6, 8], [2, 7, 6], [3, 8, 7], [7, 8, 6]];
    let levels = |faces: &[[u32; 3]]| {
        let mesh = TriMesh::from_slices(&positions, faces).unwrap();
        Levels::new(&mesh, 1).map(|levels| levels.mesh(0).unwrap().face_arrays())
    };
    assert_eq!(levels(&faces).unwrap(), [[0, 1, 2], [0, 2, 3]]);
    let spoilt = |at: usize, face: [u32; 3]| {
        let mut faces = faces;
        faces[at] = face;
        faces
    };
    for (faces, face) in [(spoilt(1, [5, 4, 1]), 0), (spoilt(7, [7, 6, 8]), 1)] {
        assert_eq!(levels(&faces), Err(CorrespondenceError::NotSubdivided { levels: 1, level: 0, face }));
    }
    assert!(levels(&faces[..6]).is_err());
    // The middle of the common edge twice.
    let mut two = faces;
    two[..4].iter_mut().flatten().filter(|v| **v == 6).for_each(|v| *v = 8);
    assert!(levels(&two).is_err());
    let mesh = TriMesh::from_slices(&positions, &faces).unwrap();
    assert_eq!(Levels::new(&mesh, 1).unwrap().mesh(2), Err(CorrespondenceError::NoLevel { level: 2, finest: 1 }));
}

#[test]
fn arguments_that_do_not_fit_are_refused() {
    let soup = fixtures::cube(2).to_soup();
    let cleaned = cleaned(&soup);
    let start = Start { face: FaceId(0), position: DVec3::ZERO };
    let n = cleaned.mesh.n_vertices();
    let map = |soup: &Soup, starts: Vec<Start>| {
        let source = Source { soup, cleaned: &cleaned };
        Map::new(&source, &cleaned.mesh, 0, &IdVec::from_vec(starts), FaceOrder::Children).err()
    };
    assert_eq!(map(&soup, vec![start; n]), None);
    assert_eq!(map(&Soup::default(), vec![start; n]), Some(CorrespondenceError::OtherSoup));
    assert_eq!(map(&soup, vec![start]), Some(CorrespondenceError::StartCount { starts: 1, vertices: n }));
    for odd in [Start { face: FaceId(9999), ..start }, Start { position: DVec3::NAN, ..start }] {
        assert_eq!(map(&soup, vec![odd; n]), Some(CorrespondenceError::NoStart(VertexId(0), odd.face)));
    }
}
