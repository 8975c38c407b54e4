//! Subdivision connectivity, read back from a face list alone.
//!
//! The order that a semi-regular mesh keeps: the children of face `f` = (a, b, c) are `4f..4f+3` = (a, ab, ca) (b, bc, ab)
//! (c, ca, bc) (bc, ca, ab), and the vertices of a level are a prefix of those of the next. So the base mesh and every level
//! between need no storing: this file recovers them, or names the face where the order breaks.

use crate::edges::{Edges, Side};
use crate::topology::n_vertices;
use mesh_core::{FaceId, Id, IdVec, TriMesh, VertexId};

type Faces = IdVec<FaceId, [VertexId; 3]>;

/// Why faces are not `levels` subdivisions of a base mesh. Faces and levels are those of the coarser of the two levels compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ConnectivityError {
    /// The number of faces is not divisible by 4.
    #[error("level {level} would have {faces} / 4 faces; the mesh has fewer subdivision levels")]
    FaceCount {
        /// The level that does not exist.
        level: u32,
        /// Number of faces of the next finer level.
        faces: usize,
    },
    /// Four faces do not fit together as the children of one, in the order of this file's head.
    #[error("faces {}..{} of level {} are not the children of face {face} of level {level} in order", 4 * face.0, 4 * face.0 + 3, level + 1)]
    Children {
        /// Level of the parent.
        level: u32,
        /// The parent.
        face: FaceId,
    },
    /// The two faces at an edge have different midpoints on it.
    #[error("faces {faces:?} of level {level} do not share the midpoint of their edge {} {}", ends[0], ends[1])]
    TwoMidpoints {
        /// Level of the edge.
        level: u32,
        /// Two of its faces.
        faces: [FaceId; 2],
        /// Its ends.
        ends: [VertexId; 2],
    },
    /// A midpoint is a vertex of the coarser level, the midpoint of another edge too, or leaves a gap in the numbering.
    #[error(
        "vertex {vertex}, midpoint of an edge of face {face} of level {level}, breaks the numbering: midpoints must be new and follow the {coarse} coarse vertices"
    )]
    Numbering {
        /// Level of the edge.
        level: u32,
        /// A face at the edge.
        face: FaceId,
        /// The midpoint.
        vertex: VertexId,
        /// Number of vertices of the level.
        coarse: usize,
    },
}

/// The number of vertices and faces of one level.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LevelCounts {
    /// Vertices: the level's are the first ones of the mesh.
    pub vertices: usize,
    /// Faces.
    pub faces: usize,
}

/// A face list taken apart into its levels.
#[derive(Debug, Clone, PartialEq)]
pub struct Hierarchy {
    /// Faces of the base mesh.
    pub base_faces: Faces,
    /// Counts of every level, the base first.
    pub levels: Vec<LevelCounts>,
}

impl Hierarchy {
    /// Number of subdivisions.
    pub fn depth(&self) -> u32 {
        self.levels.len().saturating_sub(1) as u32
    }
    /// Counts of the base mesh.
    pub fn base(&self) -> LevelCounts {
        self.levels.first().copied().unwrap_or_default()
    }
}

/// Recovers the base mesh of a mesh whose faces are `levels` subdivisions of it.
pub fn connectivity(mesh: &TriMesh, levels: u32) -> Result<Hierarchy, ConnectivityError> {
    of_faces(mesh.faces(), levels)
}

fn of_faces(faces: &Faces, levels: u32) -> Result<Hierarchy, ConnectivityError> {
    let mut counts = vec![LevelCounts { vertices: n_vertices(faces), faces: faces.len() }];
    let mut fine = faces.clone();
    for level in (0..levels).rev() {
        fine = coarsen(&fine, level)?;
        counts.push(LevelCounts { vertices: n_vertices(&fine), faces: fine.len() });
    }
    counts.reverse();
    Ok(Hierarchy { base_faces: fine, levels: counts })
}

/// The parents of the faces, which are those of `level`.
fn coarsen(fine: &Faces, level: u32) -> Result<Faces, ConnectivityError> {
    if !fine.len().is_multiple_of(4) || fine.is_empty() {
        return Err(ConnectivityError::FaceCount { level, faces: fine.len() });
    }
    let mut parents = Faces::new();
    // midpoints[f][c] lies on the edge of face f from its corner c to the next.
    let mut midpoints = Faces::new();
    for children in fine.as_slice().chunks_exact(4) {
        let [[a, ab, ca], [b, bc, _], [c, ..], _] = [children[0], children[1], children[2], children[3]];
        let expected = [[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]];
        if children != expected {
            return Err(ConnectivityError::Children { level, face: FaceId::new(parents.len()) });
        }
        parents.push([a, b, c]);
        midpoints.push([ab, bc, ca]);
    }
    check_midpoints(&parents, &midpoints, level)?;
    Ok(parents)
}

/// Every edge has one midpoint, and the midpoints are numbered without gap or repetition behind the coarse vertices.
fn check_midpoints(parents: &Faces, midpoints: &Faces, level: u32) -> Result<(), ConnectivityError> {
    let edges = Edges::of(parents);
    let n_edges = edges.iter().count();
    let coarse = n_vertices(parents);
    let mut taken = vec![false; n_edges];
    for sides in edges.iter() {
        let (face, ends) = (sides[0].face, sides[0].ends);
        let midpoint = |side: &Side| midpoints[side.face][side.corner()];
        let vertex = midpoint(&sides[0]);
        if let Some(other) = sides.iter().find(|side| midpoint(side) != vertex) {
            return Err(ConnectivityError::TwoMidpoints { level, faces: [face, other.face], ends });
        }
        let slot = vertex.index().checked_sub(coarse).and_then(|i| taken.get_mut(i));
        match slot {
            Some(taken) if !*taken => *taken = true,
            _ => return Err(ConnectivityError::Numbering { level, face, vertex, coarse }),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{icosahedron, subdivide};

    fn fine() -> Faces {
        subdivide(&subdivide(&icosahedron())).faces().clone()
    }

    /// `fine` with one change must be refused.
    fn refused(change: impl FnOnce(&mut [[VertexId; 3]])) -> ConnectivityError {
        let mut faces = fine();
        change(faces.as_mut_slice());
        of_faces(&faces, 2).unwrap_err()
    }

    #[test]
    fn levels_are_recovered() {
        let hierarchy = of_faces(&fine(), 2).unwrap();
        assert_eq!(&hierarchy.base_faces, icosahedron().faces());
        let counts: Vec<_> = hierarchy.levels.iter().map(|l| (l.vertices, l.faces)).collect();
        assert_eq!(counts, [(12, 20), (42, 80), (162, 320)]);
        assert_eq!(hierarchy.depth(), 2);
        assert_eq!(of_faces(&fine(), 0).unwrap().base().faces, 320);
    }

    #[test]
    fn more_levels_than_there_are_end_in_an_error() {
        assert_eq!(of_faces(&fine(), 3).unwrap_err(), ConnectivityError::Children { level: 0, face: FaceId(0) });
        let three_faces: Faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1]].map(|f| f.map(VertexId)).into_iter().collect();
        assert_eq!(of_faces(&three_faces, 1).unwrap_err(), ConnectivityError::FaceCount { level: 0, faces: 3 });
        assert!(of_faces(&Faces::new(), 1).is_err());
    }

    #[test]
    fn every_swap_rotation_and_reversal_of_one_face_is_found() {
        for f in 0..320 {
            refused(|faces| faces[f].rotate_left(1));
            refused(|faces| faces[f].rotate_right(1));
            refused(|faces| faces[f].swap(0, 1));
            refused(|faces| faces.swap(f, (f + 1) % 320));
            let parent = FaceId::new(f / 4);
            let error = refused(|faces| faces[f].rotate_left(1));
            assert_eq!(error, ConnectivityError::Children { level: 1, face: parent });
        }
    }

    #[test]
    fn vertices_of_two_levels_swapped_are_found() {
        for (coarse, new) in [(0, 12), (3, 41), (5, 42), (11, 161), (12, 42), (41, 161)] {
            let (coarse, new) = (VertexId(coarse), VertexId(new));
            let error = refused(|faces| {
                for v in faces.iter_mut().flatten() {
                    *v = if *v == coarse {
                        new
                    } else if *v == new {
                        coarse
                    } else {
                        *v
                    };
                }
            });
            assert!(matches!(error, ConnectivityError::Numbering { .. }), "{coarse} {new}: {error}");
        }
    }

    #[test]
    fn a_crack_at_a_midpoint_is_found() {
        // Vertex 42 + k is a midpoint; give one parent its own copy of it.
        let error = refused(|faces| {
            let torn = VertexId(100);
            let f = faces.iter().position(|f| f.contains(&torn)).unwrap() / 4 * 4;
            for v in faces[f..f + 4].iter_mut().flatten().filter(|v| **v == torn) {
                *v = VertexId(162);
            }
        });
        assert!(matches!(error, ConnectivityError::TwoMidpoints { level: 1, .. }), "{error}");
    }
}
