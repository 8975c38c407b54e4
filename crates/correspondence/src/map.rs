//! [`Map`]: from the input to the result and back, and from level to level, in plain arrays.

use crate::levels::Levels;
use crate::result::nearest_points;
use crate::source::{Finder, Over, Start};
use crate::{CorrespondenceError, FaceOrder, Prolongation, Source};
use glam::DVec3;
use mesh_core::{FaceId, Id as _, IdVec, TriMesh, VertexId, vector_area};
use rayon::prelude::*;

/// Where everything of the result is on the input, and the other way round; and how levels hang together.
///
/// Vertices and triangles of the input have the numbers that they have in the soup; those of the result are in its order.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// For every vertex of the result a triangle of the input.
    pub source_face: Vec<u32>,
    /// Barycentric coordinates in that triangle of the foot of the vertex on its plane. They leave 0 to 1 where the vertex is off the
    /// surface beside an edge.
    pub source_barycentric: Vec<[f64; 3]>,
    /// How far the vertex is from its foot, along the normal of the triangle as it was read (the other way where cleaning turned it over),
    /// in the units of the mesh: vertex = foot + offset * unit normal.
    pub offset: Vec<f64>,
    /// For every vertex of the input a face of the result; -1 where a repair took the vertex away.
    pub result_face: Vec<i64>,
    /// Barycentric coordinates in that face, from 0 to 1; not a number where there is none.
    pub result_barycentric: Vec<[f64; 3]>,
    /// For every face of the result the face of the base mesh that it is a part of.
    pub base_face: Vec<u32>,
    /// For every level from 1 on: the two vertices of the level before in whose middle each vertex was put, the lower first; twice the
    /// same number for one that was there.
    pub parents: Vec<Vec<[u32; 2]>>,
    /// For every level from 1 on: the face of the level before that each face is a part of.
    pub face_parents: Vec<Vec<u32>>,
    /// From each level to the next.
    pub prolongations: Vec<Prolongation>,
}

impl Map {
    /// Maps a mesh, whose faces are `levels` subdivisions of a base mesh in our order, to the input.
    ///
    /// The numbers of faces in the map are those that they have in `order`. Fails where the parts of the input do not belong together, where
    /// the mesh has other levels, and where there is not one start for each vertex.
    pub fn new(
        source: &Source,
        result: &TriMesh,
        levels: u32,
        starts: &IdVec<VertexId, Start>,
        order: FaceOrder,
    ) -> Result<Self, CorrespondenceError> {
        check(source, result, starts)?;
        let levels = Levels::new(result, levels)?;
        let finder = Finder::new(source);
        let normals = vertex_normals(result);
        let over = |v: VertexId| finder.over(starts[v], result.position(v), normals[v]);
        let over: Vec<Over> = (0..result.n_vertices()).into_par_iter().map(|v| over(VertexId::new(v))).collect();
        let cleaned_face = over.iter().map(|o| o.face).collect();
        let points = nearest_points(source.cleaned, result, &cleaned_face);
        let on_result: Vec<_> = source.cleaned.vertex_of.iter().map(|v| v.and_then(|v| points[v])).collect();
        let (finest, n_base) = (levels.finest(), levels.faces(0).len());
        let placed = |face: FaceId| order.place(face.index(), finest, n_base) as i64;
        let parent = |level: u32| move |face: usize| order.parent(face, level, n_base) as u32;
        let n_faces = |level: u32| levels.faces(level).len();
        let parents: Vec<_> = (1..=finest).map(|level| levels.parents(level)).collect::<Result<_, _>>()?;
        let n_coarse = (0..finest).map(|level| levels.n_vertices(level));
        Ok(Self {
            source_face: over.iter().map(|o| source.cleaned.source_face[o.face]).collect(),
            source_barycentric: over.iter().map(|o| o.barycentric.to_array()).collect(),
            offset: over.iter().map(|o| o.offset).collect(),
            result_face: on_result.iter().map(|p| p.map_or(-1, |p| placed(p.face))).collect(),
            result_barycentric: on_result.iter().map(|p| p.map_or([f64::NAN; 3], |p| p.barycentric.to_array())).collect(),
            base_face: (0..n_faces(finest)).map(|face| order.base_face(face, finest, n_base) as u32).collect(),
            prolongations: parents.iter().zip(n_coarse).map(|(parents, n)| Prolongation::new(parents, n)).collect(),
            face_parents: (1..=finest).map(|level| (0..n_faces(level)).map(parent(level)).collect()).collect(),
            parents,
        })
    }
}

/// Unit normals at the vertices of a mesh, weighted by area; 0 where they have no direction.
fn vertex_normals(mesh: &TriMesh) -> IdVec<VertexId, DVec3> {
    let mut sums = IdVec::filled(DVec3::ZERO, mesh.n_vertices());
    for f in mesh.faces().ids() {
        let area = vector_area(mesh.triangle(f));
        mesh.face(f).into_iter().for_each(|v| sums[v] += area);
    }
    sums.iter().map(|sum| sum.normalize_or_zero()).collect()
}

fn check(source: &Source, result: &TriMesh, starts: &IdVec<VertexId, Start>) -> Result<(), CorrespondenceError> {
    let Source { soup, cleaned } = source;
    if (cleaned.vertex_of.len(), cleaned.face_of.len()) != (soup.positions.len(), soup.triangles.len()) {
        return Err(CorrespondenceError::OtherSoup);
    }
    if starts.len() != result.n_vertices() {
        return Err(CorrespondenceError::StartCount { starts: starts.len(), vertices: result.n_vertices() });
    }
    let is_there = |start: &Start| start.face.index() < cleaned.mesh.n_faces() && start.position.is_finite();
    match starts.enumerate().find(|(_, start)| !is_there(start)) {
        Some((v, start)) => Err(CorrespondenceError::NoStart(v, start.face)),
        None => Ok(()),
    }
}
