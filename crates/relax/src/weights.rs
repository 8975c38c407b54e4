//! Weights of the neighbours in the centroid (paper, section 4.3.2).

use crate::Weights;
use mesh_core::{IdVec, Topology, VertexId};

/// The valence at which a vertex takes the mean of its neighbours' weights.
const IDEAL_VALENCE: usize = 6;
/// The weight of every vertex, positive.
pub(crate) fn vertex_weights(topology: &Topology, weights: Weights) -> IdVec<VertexId, f64> {
    match weights {
        Weights::Uniform => IdVec::filled(1.0, topology.n_vertices()),
        Weights::Adaptive => diffused(topology, &cubed_valences(topology)),
    }
}

fn cubed_valences(topology: &Topology) -> IdVec<VertexId, f64> {
    vertices(topology).map(|v| (topology.valence(v) as f64).powi(3)).collect()
}

/// On vertices of valence 6 the mean of the neighbours' weights. (The paper prints the mean of their valences, which would undo
/// the cube that it has just taken.)
fn diffused(topology: &Topology, weights: &IdVec<VertexId, f64>) -> IdVec<VertexId, f64> {
    let of = |v| match topology.valence(v) {
        IDEAL_VALENCE => topology.one_ring(v).map(|w| weights[w]).sum::<f64>() / IDEAL_VALENCE as f64,
        _ => weights[v],
    };
    vertices(topology).map(of).collect()
}

fn vertices(topology: &Topology) -> impl Iterator<Item = VertexId> + use<> {
    (0..topology.n_vertices() as u32).map(VertexId)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hexagonal fan inside a ring of further triangles has one inner vertex of valence 6.
    #[test]
    fn only_vertices_of_valence_six_take_the_mean_of_their_neighbours() {
        let faces = (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6].map(VertexId)).collect();
        let topology = Topology::new(&faces, 7).unwrap();
        let weights = vertex_weights(&topology, Weights::Adaptive);
        // Rim vertices have valence 3; the centre had 216 and takes their 27.
        assert_eq!(weights.as_slice(), [27.0; 7]);
        assert_eq!(vertex_weights(&topology, Weights::Uniform).as_slice(), [1.0; 7]);
    }
}
