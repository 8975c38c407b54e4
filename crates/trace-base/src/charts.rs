//! The regions between traced edges as charts: every base face is a triangle in the plane, its edges straight.

use crate::Untraced;
use crate::cut_mesh::CutMesh;
use crate::paths::Paths;
use glam::{DVec2, DVec3};
use mesh_core::{FaceId, Id as _, IdVec, TriMesh};
use rayon::prelude::*;
use region_map::{BaseMap, Chart, ChartFace, ChartId};
use rustc_hash::{FxHashMap, FxHashSet};

/// Where the corners of a base face are in its chart.
const CORNERS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::new(0.5, 0.866_025_403_784_438_6)];

/// Charts all base faces and makes them a map.
pub(crate) fn charts(mut cut: CutMesh, base: &TriMesh, paths: &Paths) -> Result<BaseMap, Untraced> {
    cut.cut_dividing_edges();
    let mut is_used = vec![false; cut.pieces().len()];
    let mut regions = Vec::new();
    for f in base.faces().ids() {
        let border = Border::of(base, paths, f).ok_or(Untraced::Face(f))?;
        let pieces = border.region(&cut, &mut is_used).ok_or(Untraced::Face(f))?;
        regions.push((f, border, pieces));
    }
    let chart = |(f, border, pieces): &(FaceId, Border, Vec<u32>)| border.chart(&cut, pieces).ok_or(Untraced::Chart(*f));
    let charts = regions.par_iter().map(chart).collect::<Result<Vec<Chart>, Untraced>>()?;
    let faces: Vec<(ChartId, [DVec2; 3])> = (0..charts.len()).map(|i| (ChartId::new(i), CORNERS)).collect();
    // There is a chart for every face, so this cannot fail.
    BaseMap::new(IdVec::from_vec(charts), &faces).map_err(|_| Untraced::NotFinite)
}

/// The three paths round a base face, counter-clockwise, each without its last vertex.
struct Border([Vec<u32>; 3]);

impl Border {
    fn of(base: &TriMesh, paths: &Paths, f: FaceId) -> Option<Self> {
        let corners = base.face(f);
        let side = |k: usize| {
            let mut path = paths.path(corners[k], corners[(k + 1) % 3])?;
            path.pop();
            Some(path)
        };
        Some(Self([side(0)?, side(1)?, side(2)?]))
    }

    /// The pieces inside; `None` when they are not a disk with exactly this border, or in another region already.
    fn region(&self, cut: &CutMesh, is_used: &mut [bool]) -> Option<Vec<u32>> {
        let round: Vec<u32> = self.0.iter().flatten().copied().collect();
        let n = round.len();
        let border: FxHashSet<[u32; 2]> = (0..n).map(|i| [round[i], round[(i + 1) % n]]).collect();
        let start = cut.left(round[0], round[1])?;
        let (mut pieces, mut met) = (vec![start], 0);
        if std::mem::replace(&mut is_used[start as usize], true) {
            return None;
        }
        let mut vertices: FxHashSet<u32> = FxHashSet::default();
        let mut next = 0;
        while let Some(&piece) = pieces.get(next) {
            next += 1;
            let v = cut.pieces()[piece as usize].vertices;
            vertices.extend(v);
            for c in 0..3 {
                let (a, b) = (v[c], v[(c + 1) % 3]);
                if cut.is_wall(a, b) {
                    met += 1;
                    border.contains(&[a, b]).then_some(())?;
                } else if let Some(beyond) = cut.left(b, a)
                    && !std::mem::replace(&mut is_used[beyond as usize], true)
                {
                    pieces.push(beyond);
                }
            }
        }
        // Euler number of a disk, with every inner edge counted at two pieces.
        let edges = (3 * pieces.len() + met) / 2;
        (met == border.len() && met == n && vertices.len() + pieces.len() == edges + 1).then_some(pieces)
    }

    /// The region on a triangle: its border along the sides by length, its inside by a convex combination map.
    fn chart(&self, cut: &CutMesh, region: &[u32]) -> Option<Chart> {
        let mut local: FxHashMap<u32, u32> = FxHashMap::default();
        let mut positions: Vec<DVec3> = Vec::new();
        let mut take = |v: u32| {
            *local.entry(v).or_insert_with(|| {
                positions.push(cut.positions()[v as usize]);
                positions.len() as u32 - 1
            })
        };
        let pieces: Vec<ChartFace> = region
            .iter()
            .map(|&i| {
                let piece = &cut.pieces()[i as usize];
                ChartFace { vertices: piece.vertices.map(&mut take), ..piece.clone() }
            })
            .collect();
        let mut fixed = vec![None; positions.len()];
        for (k, side) in self.0.iter().enumerate() {
            let end = self.0[(k + 1) % 3][0];
            let stops: Vec<DVec3> = side.iter().chain([&end]).map(|&v| cut.positions()[v as usize]).collect();
            let whole: f64 = stops.windows(2).map(|w| w[0].distance(w[1])).sum();
            let mut along = 0.0;
            for (i, v) in side.iter().enumerate() {
                fixed[*local.get(v)? as usize] = Some(CORNERS[k].lerp(CORNERS[(k + 1) % 3], along / whole));
                along += stops[i].distance(stops[i + 1]);
            }
        }
        chart::lay_flat(&positions, pieces, &fixed)
    }
}
