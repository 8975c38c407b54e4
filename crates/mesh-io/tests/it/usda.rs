//! The control mesh of a subdivision surface, as text of OpenUSD.

use crate::small_tetrahedron;
use mesh_io::{ControlMesh, WriteError, usda_bytes};

#[test]
fn a_control_mesh_says_what_stays_sharp() {
    let mesh = small_tetrahedron();
    let control = ControlMesh { mesh: &mesh, creases: &[[0, 1], [2, 1], [2, 3]], corners: &[2] };
    let text = String::from_utf8(usda_bytes(&control).unwrap()).unwrap();
    assert!(text.starts_with("#usda 1.0\n") && text.ends_with("}\n"), "{text}");
    for line in [
        "def Mesh \"Base\"",
        "    uniform token subdivisionScheme = \"loop\"",
        "    token interpolateBoundary = \"edgeAndCorner\"",
        "    int[] faceVertexCounts = [3, 3, 3, 3]",
        "    int[] creaseIndices = [0, 1, 2, 2, 3]",
        "    int[] creaseLengths = [3, 2]",
        "    float[] creaseSharpnesses = [10, 10]",
        "    int[] cornerIndices = [2]",
        "    float[] cornerSharpnesses = [10]",
    ] {
        assert!(text.lines().any(|l| l == line), "{line} is not in\n{text}");
    }
    let smooth = String::from_utf8(usda_bytes(&ControlMesh { mesh: &mesh, creases: &[], corners: &[] }).unwrap()).unwrap();
    assert!(smooth.contains("creaseIndices = []"));
}

#[test]
fn what_cannot_be_written_is_told() {
    let mesh = small_tetrahedron();
    let beyond = usda_bytes(&ControlMesh { mesh: &mesh, creases: &[[0, 4]], corners: &[] });
    assert!(matches!(beyond, Err(WriteError::NoSuchVertex { vertex: 4, vertices: 4 })));
    let beyond = usda_bytes(&ControlMesh { mesh: &mesh, creases: &[], corners: &[9] });
    assert!(matches!(beyond, Err(WriteError::NoSuchVertex { vertex: 9, .. })));
    let large = mesh.with_positions(mesh.positions().iter().map(|&p| p * 1e200).collect()).unwrap();
    let large = usda_bytes(&ControlMesh { mesh: &large, creases: &[], corners: &[] });
    assert!(matches!(large, Err(WriteError::NotSinglePrecision { .. })));
}
