//! A displacement as arrays for numpy and back, as docs/displacement.md lists them.

use crate::arrays::{floats, int32, ints, one};
use crate::failure::{Failure, Kind};
use displacement::{Coefficients, Displacement, LevelDisplacement};
use glam::DVec3;
use mesh_core::TriMesh;
use mesh_io::{Array, Numbers};
use std::collections::HashMap;
use std::path::Path;

const POSITIONS: &str = "base_positions";
const FACES: &str = "base_faces";
/// The names of the arrays of a level, before its number.
const SCALAR: Names = Names { numbers: "scalar_", step: "scalar_step_", width: 1 };
const RESIDUAL: Names = Names { numbers: "residual_", step: "residual_step_", width: 2 };

/// What to do about a file that is not what it should be.
const REMEDY: &str = "write the folder again with remesh --displacement";

struct Names {
    numbers: &'static str,
    /// Of the step, where the numbers are quantised.
    step: &'static str,
    /// Numbers for each vertex.
    width: usize,
}

/// All arrays of a displacement.
pub(crate) fn arrays(displacement: &Displacement) -> Vec<Array<'_>> {
    let positions = displacement.base.position_arrays().into_flattened();
    let mut arrays = vec![
        Array { name: POSITIONS.to_owned(), shape: vec![positions.len() / 3, 3], values: Numbers::Float(positions.into()) },
        ints(FACES, 3, displacement.base.face_arrays().as_flattened()),
    ];
    for (level, LevelDisplacement { scalar, residual }) in (1..).zip(&displacement.levels) {
        SCALAR.push(&mut arrays, level, scalar);
        RESIDUAL.push(&mut arrays, level, residual);
    }
    arrays
}

impl Names {
    fn push<'a>(&self, arrays: &mut Vec<Array<'a>>, level: u32, coefficients: &'a Coefficients) {
        let name = format!("{}{level}", self.numbers);
        match coefficients {
            Coefficients::Exact(values) => arrays.push(floats(&name, self.width, values)),
            Coefficients::Quantised { multiples, step } => {
                arrays.push(int32(&name, self.width, multiples));
                arrays.push(one(&format!("{}{level}", self.step), *step));
            }
        }
    }
}

/// The displacement that the arrays of a file hold. Fails where one is missing or of another kind or shape.
pub(crate) fn displacement(path: &Path, arrays: Vec<Array<'static>>) -> Result<Displacement, Failure> {
    let arrays = arrays.into_iter().map(|array| (array.name.clone(), array)).collect();
    let file = File { path, arrays };
    let levels = (1..=file.finest()).map(|level| {
        let [scalar, residual] = [SCALAR, RESIDUAL].map(|names| file.coefficients(&names, level));
        Ok(LevelDisplacement { scalar: scalar?, residual: residual? })
    });
    Ok(Displacement { base: file.base()?, levels: levels.collect::<Result<_, Failure>>()? })
}

/// A file that was read.
struct File<'a> {
    path: &'a Path,
    arrays: HashMap<String, Array<'static>>,
}

impl File<'_> {
    fn broken(&self, what: impl std::fmt::Display) -> Failure {
        Failure::new(Kind::Parse, format!("{}: {what}; {REMEDY}", self.path.display()))
    }

    /// The greatest number of a level of which there is anything.
    fn finest(&self) -> u32 {
        let level = |name: &String| [SCALAR.numbers, RESIDUAL.numbers].iter().find_map(|n| name.strip_prefix(n)?.parse().ok());
        self.arrays.keys().filter_map(level).max().unwrap_or(0)
    }

    /// The array of a name, in rows of so many; with one, an array of one dimension.
    fn array(&self, name: &str, width: usize) -> Result<&Array<'static>, Failure> {
        let array = self.arrays.get(name).ok_or_else(|| self.broken(format!("there is no array {name}")))?;
        let fits = match array.shape[..] {
            [_] => width == 1,
            [_, columns] => width > 1 && columns == width,
            _ => false,
        };
        let wanted = if width == 1 { "one dimension".to_owned() } else { format!("rows of {width}") };
        let found = || self.broken(format!("the array {name} has the shape {:?} where {wanted} are needed", array.shape));
        if fits { Ok(array) } else { Err(found()) }
    }

    fn wrong_kind(&self, name: &str, wanted: &str) -> Failure {
        self.broken(format!("the array {name} holds other numbers than {wanted}"))
    }

    fn base(&self) -> Result<TriMesh, Failure> {
        let (positions, faces) = (self.array(POSITIONS, 3)?, self.array(FACES, 3)?);
        let Numbers::Float(positions) = &positions.values else { return Err(self.wrong_kind(POSITIONS, "float64")) };
        let Numbers::Int(faces) = &faces.values else { return Err(self.wrong_kind(FACES, "int64")) };
        let vertex = |&v: &i64| u32::try_from(v).map_err(|_| self.broken(format!("the array {FACES}: {v} is no vertex")));
        let faces: Vec<u32> = faces.iter().map(vertex).collect::<Result<_, _>>()?;
        let positions = positions.as_chunks::<3>().0.iter().copied().map(DVec3::from).collect();
        TriMesh::new(positions, faces.as_chunks::<3>().0.to_vec()).map_err(|e| self.broken(format!("the base mesh: {e}")))
    }

    fn coefficients(&self, names: &Names, level: u32) -> Result<Coefficients, Failure> {
        let name = format!("{}{level}", names.numbers);
        match &self.array(&name, names.width)?.values {
            Numbers::Float(values) => Ok(Coefficients::Exact(values.to_vec())),
            Numbers::Int32(multiples) => {
                let step = self.step(&format!("{}{level}", names.step))?;
                Ok(Coefficients::Quantised { multiples: multiples.to_vec(), step })
            }
            Numbers::Int(_) => Err(self.wrong_kind(&name, "float64 or int32")),
        }
    }

    fn step(&self, name: &str) -> Result<f64, Failure> {
        match self.arrays.get(name).map(|array| &array.values) {
            Some(Numbers::Float(values)) if values.len() == 1 => Ok(values[0]),
            _ => Err(self.broken(format!("there is no array {name} with one number, the step of what is quantised"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example(bits: bool) -> Displacement {
        let base = TriMesh::from_slices(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]).unwrap();
        let numbers = |n: usize| match bits {
            true => Coefficients::Quantised { multiples: (0..n as i32).collect(), step: 0.25 },
            false => Coefficients::Exact((0..n).map(|i| i as f64).collect()),
        };
        let levels = [3, 9].map(|n| LevelDisplacement { scalar: numbers(n), residual: numbers(2 * n) });
        Displacement { base, levels: levels.into() }
    }

    fn owned(displacement: &Displacement) -> Vec<Array<'static>> {
        mesh_io::read_arrays_bytes(&mesh_io::array_bytes(&arrays(displacement)).unwrap()).unwrap()
    }

    #[test]
    fn displacements_come_back() {
        for bits in [false, true] {
            assert_eq!(displacement(Path::new("a.npz"), owned(&example(bits))).unwrap(), example(bits));
        }
    }

    #[test]
    fn every_array_is_needed_in_its_shape() {
        for bits in [false, true] {
            let all = owned(&example(bits));
            for i in 0..all.len() {
                let mut fewer = all.clone();
                let gone = fewer.remove(i);
                let told = displacement(Path::new("a.npz"), fewer).unwrap_err();
                assert!(told.to_string().contains(&format!("there is no array {}", gone.name)), "{told}");
                let mut other = all.clone();
                other[i].shape = vec![1, 1, 1];
                other[i].values = Numbers::Int(vec![-1].into());
                let told = displacement(Path::new("a.npz"), other).unwrap_err().to_string();
                assert!(told.contains(&gone.name) && told.ends_with(REMEDY), "{told}");
            }
        }
    }

    #[test]
    fn faces_without_vertices_are_told() {
        for v in [-1, 3, 1 << 40] {
            let mut all = owned(&example(false));
            all[1].values = Numbers::Int(vec![0, 1, v].into());
            let told = displacement(Path::new("a.npz"), all).unwrap_err();
            assert_eq!(told.kind(), Kind::Parse, "{told}");
        }
    }
}
