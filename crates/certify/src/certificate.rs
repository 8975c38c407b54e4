//! [`Certificate`]: what a finished mesh was found to be, and everything that it does not pass.

use crate::component_counts::{self, ComponentCounts};
use crate::connectivity::{ConnectivityError, Hierarchy, connectivity};
use crate::error::MeasureError;
use crate::measures::{MeasureOptions, Measures, measure};
use crate::reference::Reference;
use crate::topology::{Topologies, TopologyCounts};
use mesh_core::{FaceId, IdVec, TriMesh, VertexId};

/// A reason not to call a mesh good.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure {
    /// The faces are not so many subdivisions of a base mesh.
    #[error("no subdivision connectivity: {0}")]
    Connectivity(ConnectivityError),
    /// The number of components is not that of the base mesh.
    #[error("the base mesh has {base} components, the mesh {mesh}")]
    ComponentCount {
        /// Of the base mesh.
        base: usize,
        /// Of the mesh.
        mesh: usize,
    },
    /// A component has not the counts that its part of the base mesh gives.
    #[error("component {component} should have {expected}, but has {counted}")]
    Counts {
        /// Number of the component, in the order of their first faces.
        component: usize,
        /// By the formula.
        expected: ComponentCounts,
        /// As they are.
        counted: ComponentCounts,
    },
    /// Vertices that no face uses.
    #[error("{0} vertices belong to no face")]
    UnusedVertices(usize),
    /// Edges with more than two faces, or vertices with more than one fan of them.
    #[error("not a manifold: {edges} edges have more than two faces, {vertices} vertices more than one fan of faces")]
    NotManifold {
        /// Number of such edges.
        edges: usize,
        /// Number of such vertices.
        vertices: usize,
    },
    /// Neighbouring faces of the output face different ways.
    #[error("neighbouring faces run along their edge in the same direction")]
    NotOriented,
    /// The input does not say which way its surface faces, so nothing can be said of flipped faces.
    #[error("the input is not consistently oriented, so flipped faces cannot be told; clean it first")]
    InputNotOriented,
    /// The output has other components, handles or holes than the input.
    #[error("topology changed: the input has {input}, the output {output}")]
    Topology {
        /// Of the input, as indexed.
        input: TopologyCounts,
        /// Of the output, as indexed.
        output: TopologyCounts,
    },
    /// The topology is right as indexed, but vertices that should be apart are at one position.
    #[error("topology changed by vertices at the same position: welded, the input has {input}, the output {output}")]
    WeldedTopology {
        /// Of the input, welded.
        input: TopologyCounts,
        /// Of the output, welded.
        output: TopologyCounts,
    },
    /// Faces that face the wrong way.
    #[error("{count} faces face against the input, the first is face {first}")]
    Flipped {
        /// How many.
        count: usize,
        /// The first one.
        first: FaceId,
    },
    /// Faces of next to no area.
    #[error("{0} faces are degenerate")]
    Degenerate(usize),
    /// A measure overflowed.
    #[error("{0} is not a finite number")]
    NotFinite(&'static str),
}

/// What is worth saying of a mesh that passes all the same.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Warning {
    /// The output has intersecting faces where the input has none.
    #[error("{0} faces intersect others; the input has no such faces")]
    SelfIntersections(usize),
    /// The input has leaves at the same positions (non-manifold edges that cleaning split), and the output does not meet itself
    /// in the same way.
    #[error(
        "where the input touches itself the output does not do so in the same way: welded, the input has {input}, the output {output}"
    )]
    LeavesApart {
        /// Of the input, welded.
        input: TopologyCounts,
        /// Of the output, welded.
        output: TopologyCounts,
    },
}

/// What a finished mesh was found to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Certificate {
    /// Subdivision levels asked for.
    pub levels: u32,
    /// Base mesh and levels, or why there are none.
    pub hierarchy: Result<Hierarchy, ConnectivityError>,
    /// All measures.
    pub measures: Measures,
    failures: Vec<Failure>,
}

impl Certificate {
    /// Everything that the mesh does not pass. It may be called good only when there is nothing.
    pub fn failures(&self) -> &[Failure] {
        &self.failures
    }

    /// Whether there are no failures.
    pub fn passed(&self) -> bool {
        self.failures.is_empty()
    }

    /// What is worth saying beside the failures.
    pub fn warnings(&self) -> Vec<Warning> {
        let m = &self.measures;
        let mut warnings = Vec::new();
        if m.remeshed_self_intersecting > 0 && m.original_self_intersecting == 0 {
            warnings.push(Warning::SelfIntersections(m.remeshed_self_intersecting));
        }
        if has_leaves(&m.original_topology) && welded_differs(m) {
            let (input, output) = (m.original_topology.welded, m.remeshed_topology.welded);
            warnings.push(Warning::LeavesApart { input, output });
        }
        warnings
    }
}

/// Checks `output` to be `levels` subdivisions of a base mesh that stands for `input`, from faces and positions alone, and
/// measures it.
///
/// `input` is what was remeshed: the cleaned mesh, whose topology the output must have. Fails with [`MeasureError::Remeshed`] when
/// the output has no surface; everything else that is wrong is in [`Certificate::failures`].
pub fn certify(input: &Reference, output: &TriMesh, levels: u32, options: &MeasureOptions) -> Result<Certificate, MeasureError> {
    let measures = measure(input, output, options)?;
    let hierarchy = connectivity(output, levels);
    let mut failures = match &hierarchy {
        Ok(hierarchy) => count_failures(&hierarchy.base_faces, output, levels),
        Err(error) => vec![Failure::Connectivity(*error)],
    };
    failures.extend(topology_failures(output, &measures));
    failures.extend(shape_failures(&measures));
    Ok(Certificate { levels, hierarchy, measures, failures })
}

fn count_failures(base: &IdVec<FaceId, [VertexId; 3]>, output: &TriMesh, levels: u32) -> Vec<Failure> {
    let (base, fine) = (component_counts::of_faces(base), component_counts::of_faces(output.faces()));
    if base.len() != fine.len() {
        return vec![Failure::ComponentCount { base: base.len(), mesh: fine.len() }];
    }
    let pairs = base.iter().map(|c| c.subdivided(levels)).zip(fine).enumerate();
    pairs
        .filter(|(_, (expected, counted))| expected != counted)
        .map(|(component, (expected, counted))| Failure::Counts { component, expected, counted })
        .collect()
}

fn topology_failures(output: &TriMesh, m: &Measures) -> Vec<Failure> {
    let (input, found) = (&m.original_topology, &m.remeshed_topology);
    let mut failures = Vec::new();
    if output.n_vertices() > found.indexed.vertices {
        failures.push(Failure::UnusedVertices(output.n_vertices() - found.indexed.vertices));
    }
    if !found.indexed.manifold() {
        let TopologyCounts { nonmanifold_edges: edges, nonmanifold_vertices: vertices, .. } = found.indexed;
        failures.push(Failure::NotManifold { edges, vertices });
    }
    if !found.indexed.oriented {
        failures.push(Failure::NotOriented);
    }
    if !found.indexed.same_as(&input.indexed) {
        failures.push(Failure::Topology { input: input.indexed, output: found.indexed });
    } else if !has_leaves(input) && welded_differs(m) {
        failures.push(Failure::WeldedTopology { input: input.welded, output: found.welded });
    }
    failures
}

fn shape_failures(m: &Measures) -> Vec<Failure> {
    let mut failures = Vec::new();
    match m.flipped.as_deref() {
        None => failures.push(Failure::InputNotOriented),
        Some([]) => {}
        Some(flipped) => failures.push(Failure::Flipped { count: flipped.len(), first: flipped[0] }),
    }
    if m.quality.degenerate > 0 {
        failures.push(Failure::Degenerate(m.quality.degenerate));
    }
    let worse = m.distance.worse();
    let figures = [("the mean aspect ratio", m.quality.ar_mean), ("the RMS error", worse.rms), ("the greatest error", worse.max)];
    failures.extend(figures.iter().filter(|(_, x)| !x.is_finite()).map(|(name, _)| Failure::NotFinite(name)));
    failures
}

/// Whether the mesh has different vertices at the same position.
fn has_leaves(t: &Topologies) -> bool {
    t.indexed.vertices != t.welded.vertices
}

fn welded_differs(m: &Measures) -> bool {
    let (input, output) = (&m.original_topology.welded, &m.remeshed_topology.welded);
    // Where sheets meet in a line, a finer mesh has more edges on it.
    !output.same_as(input) || (output.nonmanifold_edges > 0 && input.nonmanifold_edges == 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{cube, icosahedron, joined, moved, sphere, square, subdivide, with_face_turned};
    use glam::DVec3;

    fn check(input: &TriMesh, output: &TriMesh, levels: u32) -> Certificate {
        certify(&Reference::new(input.clone()).unwrap(), output, levels, &MeasureOptions { samples: 1000 }).unwrap()
    }

    fn failures(input: &TriMesh, output: &TriMesh, levels: u32) -> Vec<Failure> {
        check(input, output, levels).failures().to_vec()
    }

    #[test]
    fn good_meshes_pass() {
        let both = joined(&sphere(2), &moved(&cube(), |p| p + 3.0 * DVec3::X));
        let base = joined(&icosahedron(), &moved(&cube(), |p| p + 3.0 * DVec3::X));
        for (input, output) in
            [(sphere(3), sphere(2)), (square(), subdivide(&subdivide(&square()))), (both, subdivide(&subdivide(&base)))]
        {
            let certificate = check(&input, &output, 2);
            assert_eq!(certificate.failures(), []);
            assert!(certificate.passed() && certificate.warnings().is_empty());
            assert_eq!(certificate.hierarchy.unwrap().depth(), 2);
        }
    }

    #[test]
    fn a_turned_face_is_named_in_three_ways() {
        let found = failures(&sphere(2), &with_face_turned(&sphere(2), 7), 2);
        assert!(matches!(found[0], Failure::Connectivity(ConnectivityError::Children { level: 1, face: FaceId(1) })));
        assert!(found.contains(&Failure::NotOriented));
        assert!(found.contains(&Failure::Flipped { count: 1, first: FaceId(7) }));
    }

    #[test]
    fn an_inside_out_mesh_is_flipped_everywhere() {
        let inside_out = moved(&sphere(1), |p| p * DVec3::new(-1.0, 1.0, 1.0));
        assert_eq!(failures(&sphere(2), &inside_out, 1), [Failure::Flipped { count: 80, first: FaceId(0) }]);
    }

    #[test]
    fn other_topology_is_found() {
        let two = joined(&sphere(1), &moved(&sphere(1), |p| 0.5 * p));
        assert!(matches!(failures(&two, &sphere(1), 1)[..], [Failure::Topology { .. }]));
        assert!(matches!(failures(&sphere(2), &square(), 0)[0], Failure::Topology { .. }));
    }

    #[test]
    fn a_vertex_on_top_of_another_is_found() {
        // Two squares side by side that become one by position.
        let beside = |x: f64| moved(&square(), |p| p + x * DVec3::X);
        let (apart, touching) = (joined(&square(), &beside(1.001)), joined(&square(), &beside(1.0)));
        assert!(matches!(failures(&apart, &touching, 0)[..], [Failure::WeldedTopology { .. }]));
        // Where the input touches itself, it is a warning when the output does not.
        let certificate = check(&touching, &apart, 0);
        assert!(certificate.passed());
        assert!(matches!(certificate.warnings()[..], [Warning::LeavesApart { .. }]));
    }

    /// Two squares that stand across a third one's side: the finer mesh has two edges of three faces, the input one.
    #[test]
    fn three_sheets_that_meet_in_a_line_may_have_more_edges_on_it() {
        let across = |turns: f64| moved(&square(), |p| DVec3::new(p.x * turns.cos(), p.y, p.x * turns.sin()));
        let book = |mesh: fn(&TriMesh) -> TriMesh| {
            [2.0, 4.0].iter().fold(mesh(&square()), |all, &turns| joined(&all, &mesh(&across(turns))))
        };
        let (input, output) = (book(|m| m.clone()), book(subdivide));
        assert!(check(&input, &output, 1).warnings().is_empty(), "{:?}", check(&input, &output, 1).warnings());
    }

    #[test]
    fn degenerate_faces_and_unused_vertices_are_found() {
        let mut soup = subdivide(&square()).to_soup();
        soup.positions[0] = soup.positions[4] + 1e-4 * DVec3::Y;
        soup.positions.push(DVec3::ZERO);
        let output = TriMesh::new(soup.positions, soup.triangles).unwrap();
        let found = failures(&square(), &output, 1);
        assert!(found.contains(&Failure::UnusedVertices(1)));
        assert!(found.iter().any(|f| matches!(f, Failure::Degenerate(_))), "{found:?}");
    }

    #[test]
    fn self_intersections_warn() {
        let crossing = joined(&cube(), &moved(&cube(), |p| p + DVec3::splat(0.5)));
        let apart = joined(&cube(), &moved(&cube(), |p| p + DVec3::splat(1.5)));
        assert!(matches!(check(&apart, &crossing, 0).warnings()[..], [Warning::SelfIntersections(_)]));
        assert!(check(&crossing, &crossing, 0).warnings().is_empty());
    }

    #[test]
    fn an_input_that_faces_both_ways_cannot_be_certified_against() {
        assert!(failures(&with_face_turned(&cube(), 0), &cube(), 0).contains(&Failure::InputNotOriented));
    }

    #[test]
    fn nothing_to_measure_is_an_error() {
        let flat = moved(&square(), |p| p * DVec3::X);
        let square = Reference::new(square()).unwrap();
        assert!(matches!(certify(&square, &flat, 0, &MeasureOptions::default()), Err(MeasureError::Remeshed(_))));
        assert!(matches!(Reference::new(flat), Err(MeasureError::Original(_))));
    }

    #[test]
    fn an_interrupted_measurement_is_an_error() {
        let interrupt = mesh_core::Interrupt::default();
        let reference = Reference::new(cube()).unwrap().with_interrupt(interrupt.clone());
        assert!(certify(&reference, &cube(), 0, &MeasureOptions { samples: 1000 }).is_ok());
        interrupt.set();
        assert!(matches!(certify(&reference, &cube(), 0, &MeasureOptions { samples: 1000 }), Err(MeasureError::Interrupted)));
    }
}
