//! Writing usda, the text form of OpenUSD: the control mesh of a subdivision surface.
//!
//! The packages that write usda either link the C++ library or write a mesh without creases, so the few lines are written here.

mod runs;

use crate::error::WriteError;
use crate::single_precision::single_precision;
use mesh_core::TriMesh;
use runs::runs;
use std::fmt::{Display, Write as _};

/// A mesh whose subdivision is meant, with what stays sharp in it. Borders are sharp by themselves.
#[derive(Clone, Copy, Debug)]
pub struct ControlMesh<'a> {
    /// Its positions and triangles.
    pub mesh: &'a TriMesh,
    /// Sharp edges, each once, as pairs of vertices.
    pub creases: &'a [[u32; 2]],
    /// Vertices that subdivision leaves where they are.
    pub corners: &'a [u32],
}

/// The sharpness that OpenUSD takes for infinite.
const INFINITE: u32 = 10;

/// The bytes of a usda file with one `Mesh`, to be subdivided by Loop's scheme. Positions are rounded to f32, as the format has them.
///
/// Fails where a crease or corner is at a vertex that is not there, and where a coordinate is too large for f32.
pub fn usda_bytes(control: &ControlMesh) -> Result<Vec<u8>, WriteError> {
    let ControlMesh { mesh, creases, corners } = *control;
    let vertices = mesh.n_vertices();
    if let Some(&vertex) = creases.iter().flatten().chain(corners).find(|&&v| v as usize >= vertices) {
        return Err(WriteError::NoSuchVertex { vertex, vertices });
    }
    let points = single_precision(mesh)?;
    let runs = runs(creases, corners, vertices);
    let mut text = String::from(HEAD);
    let mut attribute = |name: &str, list: String| {
        // Writing to a string does not fail.
        let _ = writeln!(text, "    {name} = [{list}]");
    };
    attribute("float3[] extent", extent(&points));
    attribute("int[] faceVertexCounts", joined(mesh.faces().iter().map(|_| 3)));
    attribute("int[] faceVertexIndices", joined(mesh.faces().iter().flatten().map(|v| v.0)));
    attribute("point3f[] points", joined(points.iter().map(triple)));
    attribute("int[] creaseIndices", joined(runs.iter().flatten()));
    attribute("int[] creaseLengths", joined(runs.iter().map(Vec::len)));
    attribute("float[] creaseSharpnesses", joined(runs.iter().map(|_| INFINITE)));
    attribute("int[] cornerIndices", joined(corners.iter()));
    attribute("float[] cornerSharpnesses", joined(corners.iter().map(|_| INFINITE)));
    text += "}\n";
    Ok(text.into_bytes())
}

const HEAD: &str = r#"#usda 1.0
(
    defaultPrim = "Base"
)

def Mesh "Base"
{
    uniform token subdivisionScheme = "loop"
    token interpolateBoundary = "edgeAndCorner"
"#;

fn joined(items: impl Iterator<Item = impl Display>) -> String {
    let mut text = String::new();
    for (i, item) in items.enumerate() {
        let _ = write!(text, "{}{item}", if i == 0 { "" } else { ", " });
    }
    text
}

fn triple([x, y, z]: &[f32; 3]) -> String {
    format!("({x}, {y}, {z})")
}

/// The lower and the upper corner of the box around points; none without points.
fn extent(points: &[[f32; 3]]) -> String {
    let Some(first) = points.first() else { return String::new() };
    let (mut low, mut high) = (*first, *first);
    for point in points {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    joined([low, high].iter().map(triple))
}
