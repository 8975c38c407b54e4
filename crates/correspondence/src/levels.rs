//! The levels of a semi-regular mesh, read from the order of its faces.
//!
//! The children of face `f` = (a, b, c) are `4f..4f+3` = (a, ab, ca) (b, bc, ab) (c, ca, bc) (bc, ca, ab), and the vertices of a level
//! are the first ones of the next. So the first corner of child `k` of a face is its corner `k`.

use crate::CorrespondenceError;
use mesh_core::{Id as _, TriMesh, VertexId};

type Face = [VertexId; 3];

/// The faces of every level of a mesh, the base first.
#[derive(Clone, Debug)]
pub struct Levels<'a> {
    mesh: &'a TriMesh,
    faces: Vec<Vec<Face>>,
    n_vertices: Vec<usize>,
}

impl<'a> Levels<'a> {
    /// Takes a mesh apart whose faces are `levels` subdivisions of a base mesh. Fails where they are not.
    pub fn new(mesh: &'a TriMesh, levels: u32) -> Result<Self, CorrespondenceError> {
        let mut faces = vec![mesh.faces().as_slice().to_vec()];
        for level in (0..levels).rev() {
            let coarser = coarser(&faces[faces.len() - 1]);
            faces.push(coarser.map_err(|face| CorrespondenceError::NotSubdivided { levels, level, face })?);
        }
        faces.reverse();
        let used = |faces: &Vec<Face>| faces.iter().flatten().max().map_or(0, |v| v.index() + 1);
        let n_vertices: Vec<usize> = faces.iter().map(used).collect();
        let levels = Self { mesh, faces, n_vertices };
        levels.check_midpoints()?;
        Ok(levels)
    }

    /// The number of the finest level.
    pub fn finest(&self) -> u32 {
        self.faces.len() as u32 - 1
    }

    /// The mesh of a level: the first vertices of the finest one, where they are there. Fails where there is no such level.
    pub fn mesh(&self, level: u32) -> Result<TriMesh, CorrespondenceError> {
        let finest = self.finest();
        if level > finest {
            return Err(CorrespondenceError::NoLevel { level, finest });
        }
        if level == finest {
            return Ok(self.mesh.clone());
        }
        let positions = self.mesh.positions().as_slice()[..self.n_vertices(level)].to_vec();
        let faces = self.faces(level).iter().map(|face| face.map(|v| v.0)).collect();
        // A part of a mesh is one; an error would be that of faces that are not what they were a moment ago.
        TriMesh::new(positions, faces).map_err(|_| CorrespondenceError::NotSubdivided { levels: finest, level, face: 0 })
    }

    /// How many vertices a level has.
    pub(crate) fn n_vertices(&self, level: u32) -> usize {
        self.n_vertices[level as usize]
    }

    /// The faces of a level.
    pub(crate) fn faces(&self, level: u32) -> &[Face] {
        &self.faces[level as usize]
    }

    /// For every vertex of a level the two ends of the edge of the level before in whose middle it was put, the lower first; twice itself for
    /// one that was there, as all of level 0 were. Fails where there is no such level.
    pub fn parents(&self, level: u32) -> Result<Vec<[u32; 2]>, CorrespondenceError> {
        let finest = self.finest();
        if level > finest {
            return Err(CorrespondenceError::NoLevel { level, finest });
        }
        let mut parents: Vec<[u32; 2]> = (0..self.n_vertices(level) as u32).map(|v| [v; 2]).collect();
        let coarse = level.checked_sub(1).map_or(&[][..], |coarser| self.faces(coarser));
        for (&[a, b, c], children) in coarse.iter().zip(self.faces(level).chunks_exact(4)) {
            let [bc, ca, ab] = children[3];
            for (middle, [p, q]) in [(ab, [a, b]), (bc, [b, c]), (ca, [c, a])] {
                parents[middle.index()] = [p.min(q).0, p.max(q).0];
            }
        }
        Ok(parents)
    }

    /// Every midpoint is new and of one edge, and every new vertex is a midpoint.
    fn check_midpoints(&self) -> Result<(), CorrespondenceError> {
        let broken = |level, face| CorrespondenceError::NotSubdivided { levels: self.finest(), level, face };
        for level in 1..=self.finest() {
            let (parents, before) = (self.parents(level)?, self.n_vertices(level - 1));
            if parents[before.min(parents.len())..].iter().any(|[a, b]| a == b) {
                return Err(broken(level - 1, 0));
            }
            for (face, (&[a, b, c], children)) in self.faces(level - 1).iter().zip(self.faces(level).chunks_exact(4)).enumerate()
            {
                let [bc, ca, ab] = children[3];
                let fits = |middle: VertexId, [p, q]: [VertexId; 2]| {
                    middle.index() >= before && parents[middle.index()] == [p.min(q).0, p.max(q).0]
                };
                if !(fits(ab, [a, b]) && fits(bc, [b, c]) && fits(ca, [c, a])) {
                    return Err(broken(level - 1, face));
                }
            }
        }
        Ok(())
    }
}

/// The parents of some faces; the first one whose children are not those of a face as an error.
fn coarser(faces: &[Face]) -> Result<Vec<Face>, usize> {
    if !faces.len().is_multiple_of(4) {
        return Err(faces.len() / 4);
    }
    let parent = |(f, children): (usize, &[Face])| {
        let [[a, ab, ca], [b, bc, _], [c, ..], _] = [children[0], children[1], children[2], children[3]];
        let expected = [[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]];
        if children == expected { Ok([a, b, c]) } else { Err(f) }
    };
    faces.chunks_exact(4).enumerate().map(parent).collect()
}
