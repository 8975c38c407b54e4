//! Merging vertices, and dropping what is no triangle before or after that.

use super::draft::Draft;
use super::{CleanOptions, CleanReport};
use crate::{Bounds, IdVec, Soup, VertexId};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// The triangles of a soup with merged vertices, without those that are out of range, not finite or collapsed.
pub(super) fn weld(soup: &Soup, options: &CleanOptions, report: &mut CleanReport) -> Draft {
    let mut merged = merge_equal(&soup.positions);
    report.merged_exactly = count_merged(&merged);
    if let Some(share) = options.weld_tolerance {
        merge_near(&soup.positions, share, &mut merged);
        report.merged_by_tolerance = count_merged(&merged) - report.merged_exactly;
    }
    // Adding 0 makes 0 of -0, here and below.
    let mut draft = Draft { positions: soup.positions.iter().map(|&p| p + 0.0).collect(), ..Draft::default() };
    draft.source_vertex = (0..soup.positions.len() as u32).collect();
    for (i, triangle) in soup.triangles.iter().enumerate() {
        if triangle.iter().any(|&v| v as usize >= soup.positions.len()) {
            report.bad_index += 1;
        } else if triangle.iter().any(|&v| !is_usable(soup.positions[v as usize])) {
            report.not_finite += 1;
        } else {
            let [a, b, c] = triangle.map(|v| VertexId(merged[v as usize]));
            if a == b || b == c || c == a {
                report.collapsed += 1;
            } else {
                draft.faces.push([a, b, c]);
                draft.source_face.push(i as u32);
            }
        }
    }
    draft.turned = IdVec::filled(false, draft.faces.len());
    draft
}

fn count_merged(merged: &[u32]) -> usize {
    merged.iter().enumerate().filter(|&(i, &m)| m as usize != i).count()
}

/// Coordinates beyond this are taken for not finite: products of four of them would be.
const LARGEST_COORDINATE: f64 = 1e75;

/// True for a position that can be computed with.
pub(crate) fn is_usable(p: DVec3) -> bool {
    p.is_finite() && p.abs().max_element() <= LARGEST_COORDINATE
}

/// For every vertex the first one at exactly the same position (0 and -0 are the same, what is not usable stays alone).
pub(crate) fn merge_equal(positions: &[DVec3]) -> Vec<u32> {
    let mut first: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    first.reserve(positions.len());
    let merge = |(i, p): (usize, &DVec3)| {
        let i = i as u32;
        if is_usable(*p) { *first.entry(p.to_array().map(|x| (x + 0.0).to_bits())).or_insert(i) } else { i }
    };
    positions.iter().enumerate().map(merge).collect()
}

/// A smaller tolerance merges nothing: it is below the rounding of coordinates, and cells of this size could not be numbered.
const LEAST_SHARE: f64 = 1e-15;

/// Merges every vertex into the nearest earlier one that stands for itself and is within the tolerance, the first of several.
/// So no vertex moves further than the tolerance.
fn merge_near(positions: &[DVec3], share: f64, merged: &mut [u32]) {
    let usable = positions.iter().copied().filter(|&p| is_usable(p));
    let Some(bounds) = Bounds::of(usable) else { return };
    let tolerance = share * bounds.diagonal();
    if !(share >= LEAST_SHARE && tolerance > 0.0 && tolerance.is_finite()) {
        return;
    }
    let cell = |p: DVec3| ((p - bounds.min) / tolerance).floor().to_array().map(|x| x as i64);
    let mut standing: FxHashMap<[i64; 3], Vec<u32>> = FxHashMap::default();
    for i in 0..positions.len() {
        let p = positions[i];
        if !is_usable(p) {
            continue;
        }
        if merged[i] as usize != i {
            merged[i] = merged[merged[i] as usize];
            continue;
        }
        let near = cells_around(cell(p)).filter_map(|c| standing.get(&c)).flatten();
        let by_distance = near.map(|&j| (positions[j as usize].distance(p), j)).filter(|&(d, _)| d <= tolerance);
        match by_distance.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))) {
            Some((_, j)) => merged[i] = j,
            None => standing.entry(cell(p)).or_default().push(i as u32),
        }
    }
}

fn cells_around([x, y, z]: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    (0..27).map(move |i| [x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1])
}
