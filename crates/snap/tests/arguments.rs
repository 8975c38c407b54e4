//! Whatever the arguments are, there is a result or an error.

use glam::DVec3;
use mesh_core::{EdgeId, FaceId, TriMesh, VertexId};
use odd_arguments::{damaged, id, value};
use proptest::prelude::*;
use region_map::{Domain, Network, Surface};
use snap::{LetGo, SnapOptions, snap};

/// A bowl of `n` x `n` cells.
fn grid(n: u32) -> TriMesh {
    let at = |i: u32| [i % (n + 1), i / (n + 1)].map(|k| f64::from(k) / f64::from(n) - 0.5);
    let positions = (0..(n + 1).pow(2)).map(at).map(|[x, y]| DVec3::new(x, y, x * x + y * y)).collect();
    let cells = (0..n * n).map(|i| i / n * (n + 1) + i % n);
    TriMesh::new(positions, cells.flat_map(|a| [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]).collect()).unwrap()
}

/// Options of which any may be nonsense.
fn options() -> impl Strategy<Value = SnapOptions> {
    let any = |default: f64| prop_oneof![3 => Just(default), 1 => Just(0.0), 1 => value()];
    let default = SnapOptions::default();
    let of_pieces = (any(1.0), any(default.most_turn), any(0.0), any(default.seen_length), any(default.seen_turn));
    (any(default.bend), of_pieces, any(default.sharp_turn), any(default.least_quality)).prop_map(
        |(bend, (least_length, most_turn, least_depth, seen_length, seen_turn), sharp_turn, least_quality)| SnapOptions {
            bend,
            least_length,
            most_turn,
            least_depth,
            seen_length,
            seen_turn,
            sharp_turn,
            least_quality,
        },
    )
}

/// A walk over a grid of `n` x `n` cells, with jumps to anywhere.
fn chain(n: u32) -> impl Strategy<Value = Vec<VertexId>> {
    let steps = prop_oneof![9 => 0..4u32, 1 => 4..60u32];
    (0..(n + 1).pow(2), prop::collection::vec(steps, 0..12)).prop_map(move |(start, steps)| {
        let mut chain = vec![VertexId(start)];
        for step in steps {
            let at = chain[chain.len() - 1].0;
            let to = [1, n + 1, n + 2].get(step as usize).map_or_else(|| at.saturating_sub(step - 2), |by| at + by);
            chain.push(VertexId(to % (n + 1).pow(2)));
        }
        chain
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn snapping_gives_a_result_or_an_error(
        kind in 0..24u32,
        i in id(),
        value in value(),
        options in options(),
        minor in prop::collection::vec(prop_oneof![8 => chain(6), 1 => Just(Vec::new())], 0..4),
        let_go in prop::collection::btree_set(id(), 0..6),
        seen in prop::collection::btree_set(id(), 0..60),
        refused in prop::collection::vec(id(), 0..4),
    ) {
        let smooth = Surface::smooth(grid(6)).unwrap();
        let surface = smooth.with_network(Network { minor, ..smooth.network().clone() }).unwrap();
        let domain = damaged(&Domain::identity(&surface), kind, i, value, grid(3));
        let let_go = LetGo {
            bends: let_go.iter().map(|&i| VertexId(i)).collect(),
            minor: let_go.iter().map(|&i| EdgeId(i)).collect(),
        };
        if let Ok(snapped) = snap(&surface, &domain, &seen.into_iter().map(EdgeId).collect(), &let_go, &options) {
            snapped.domain.check(snapped.surface.network()).unwrap();
            let refused: Vec<_> = refused.into_iter().map(FaceId).collect();
            snapped.poor([&domain.mesh, &snapped.domain.mesh], &refused, &options).unwrap();
        }
    }
}
