//! A picture (PNG) and a coloured mesh (PLY) of every stage.

use anyhow::Context as _;
use glam::DVec2;
use mesh_core::{FaceId, Id as _, IdVec, SurfaceIndex, TriMesh, VertexId, aspect_ratio};
use region_map::{ArcKind, BaseMap, Network};
use semireg::{BaseStages, Patches, Remeshed};
use std::fs;
use std::path::{Path, PathBuf};
use view::{Line, Point, Rgb, Scene, ViewOptions, distance_color, palette, quality_color, render, valence_color};

const RED: Rgb = [200, 20, 30];
const BLUE: Rgb = [30, 70, 200];
const GREEN: Rgb = [20, 140, 60];
const ORANGE: Rgb = [240, 150, 30];
const DARK: Rgb = [30, 30, 35];
/// Widths of lines, in pixels.
const THICK: f64 = 3.0;
const MEDIUM: f64 = 2.0;
const THIN: f64 = 1.2;
/// Diameter of dots, in pixels.
const DOT: f64 = 7.0;
/// Triangle edges are drawn on meshes of fewer faces; of more they would cover everything.
const MAX_FACES_WITH_EDGES: usize = 30_000;
/// How much of the side of its cell a chart fills.
const CHART_SHARE: f64 = 0.95;

/// Names of the pictures up to the base mesh.
const BASE_NAMES: [&str; 5] = ["01-input", "02-features", "03-patches", "04-sites", "05-base"];
/// Names of the pictures after it.
const RESULT_NAMES: [&str; 4] = ["06-subdivided", "07-projected", "08-result", "09-distance"];
/// The charts of the base mesh.
const CHARTS: &str = "05-charts.svg";

/// Every file that [`write_base`] may write into a folder, or [`write()`] with the result.
pub(crate) fn files(folder: &Path, with_result: bool) -> Vec<PathBuf> {
    let results = if with_result { &RESULT_NAMES[..] } else { &[] };
    let names = BASE_NAMES.iter().chain(results).flat_map(|name| [format!("{name}.png"), format!("{name}.ply")]);
    names.chain([CHARTS.to_owned()]).map(|name| folder.join(name)).collect()
}

/// Writes `01-input.png`, `01-input.ply` and so on into a folder that exists.
pub(crate) fn write(folder: &Path, remeshed: &Remeshed) -> anyhow::Result<()> {
    let stages = &remeshed.stages;
    write_base(folder, &stages.base)?;
    let pictures = [
        ("06-subdivided", Scene::new(&stages.subdivided)),
        ("07-projected", by_quality(&stages.projected)),
        ("08-result", result(remeshed)),
        ("09-distance", distance(remeshed)),
    ];
    save_all(folder, &pictures)
}

/// Writes `01-input.png` to `05-base.ply`, what the stages up to the base mesh made, and all charts as `05-charts.svg`. Patches, sites
/// and charts are those of the paper's way, where it led to a base mesh, even if another one was the better.
pub(crate) fn write_base(folder: &Path, base: &BaseStages) -> anyhow::Result<()> {
    save_all(folder, &[("01-input", input(base)), ("02-features", features(base)), ("05-base", base_mesh(base))])?;
    if let Some(made) = &base.patches {
        save_all(folder, &[("03-patches", patches(base, made)), ("04-sites", sites(base, made))])?;
    }
    let of_patches = base.patches.as_ref().map(|made| &made.base);
    let Some(mapped) = of_patches.or(base.base.mapped()) else { return Ok(()) };
    let svg = folder.join(CHARTS);
    fs::write(&svg, charts(&mapped.map).to_svg()).with_context(|| format!("cannot write {}", svg.display()))
}

fn save_all(folder: &Path, pictures: &[(&str, Scene)]) -> anyhow::Result<()> {
    pictures.iter().try_for_each(|(name, scene)| save(folder, name, scene).with_context(|| format!("picture of stage {name}")))
}

fn save(folder: &Path, name: &str, scene: &Scene) -> anyhow::Result<()> {
    let edges = scene.mesh.n_faces() < MAX_FACES_WITH_EDGES;
    let path = folder.join(name);
    render(scene, &ViewOptions { edges, ..ViewOptions::default() }).write_png(path.with_extension("png"))?;
    let grey = || vec![[205; 3]; scene.mesh.n_faces()];
    let colors = scene.face_colors.as_ref().map_or_else(grey, |c| c.as_slice().to_vec());
    let points: Vec<_> = scene.points.iter().map(|p| (p.at, p.color)).collect();
    Ok(mesh_io::write_colored_ply(&path.with_extension("ply"), scene.mesh, &colors, &points)?)
}

/// The cleaned input with its sharp edges.
fn input(base: &BaseStages) -> Scene<'_> {
    let (mesh, topology) = (&base.cleaned.mesh, &base.cleaned.topology);
    let sharp = topology.edge_ids().filter(|&e| match topology.edge_faces(e) {
        (f, Some(g)) => mesh.normal(f).angle_between(mesh.normal(g)).to_degrees() > certify::ORIGINAL_CREASE_DEGREES,
        (_, None) => true,
    });
    let lines = sharp.map(|e| line(mesh, topology.ends(e), DARK, THICK)).collect();
    Scene { lines, ..Scene::new(mesh) }
}

/// Arcs by their kind, minor creases thin, corners as dots, sheets in colours.
fn features(base: &BaseStages) -> Scene<'_> {
    let (mesh, network) = (base.surface.mesh(), base.surface.network());
    let colors = network.sheet_of_face.iter().map(|s| pale(palette(s.index()))).collect();
    let minor = network.minor.iter().flat_map(|chain| along(mesh, chain, ORANGE, THIN));
    let lines = minor.chain(arcs(mesh, network)).collect();
    let points = network.corners.iter().map(|&v| dot(mesh, v, DARK)).collect();
    Scene { mesh, face_colors: Some(colors), lines, points }
}

fn arcs<'a>(mesh: &'a TriMesh, network: &'a Network) -> impl Iterator<Item = Line> + 'a {
    network.arcs.iter().flat_map(|arc| along(mesh, &arc.vertices, arc_color(arc.kind), THICK))
}

fn arc_color(kind: ArcKind) -> Rgb {
    match kind {
        ArcKind::Sharp => RED,
        ArcKind::Border => BLUE,
        ArcKind::Marked => GREEN,
    }
}

/// Patches in colours, all their arcs.
fn patches<'a>(base: &'a BaseStages, made: &Patches) -> Scene<'a> {
    let mesh = base.base_surface().mesh();
    let colors = made.segmentation.patch_of_face.iter().map(|p| palette(p.index())).collect();
    let smooth = made.cells.arcs.iter().filter(|arc| arc.on.is_none());
    let lines =
        smooth.flat_map(|arc| along(mesh, &arc.vertices, DARK, THIN)).chain(arcs(mesh, base.base_surface().network())).collect();
    Scene { face_colors: Some(colors), lines, ..Scene::new(mesh) }
}

/// Sites at corners (dark), on arcs (red) and in patches (blue).
fn sites<'a>(base: &'a BaseStages, made: &Patches) -> Scene<'a> {
    let (mesh, cells) = (base.base_surface().mesh(), &made.cells);
    let mut scene = patches(base, made);
    scene.face_colors = scene.face_colors.map(|colors| colors.iter().map(|&c| pale(c)).collect());
    scene.points.extend(cells.corners.iter().map(|&v| dot(mesh, v, DARK)));
    for (arc, lengths) in made.sites.on_arcs.enumerate() {
        let at = |&t: &f64| Point { at: cells.arcs[arc].position(mesh, t), color: RED, width: DOT };
        scene.points.extend(lengths.iter().map(at));
    }
    let inner = made.sites.in_patches.iter().flatten();
    scene.points.extend(inner.map(|site| Point { at: site.position(mesh), color: BLUE, width: DOT }));
    scene
}

/// Every vertex by its valence, a face by that of its corner farthest from 6, and the edges on arcs.
fn base_mesh(base: &BaseStages) -> Scene<'_> {
    let mesh = base.base.mesh();
    let mut valence = IdVec::<VertexId, usize>::filled(0, mesh.n_vertices());
    let mut on_border = IdVec::<VertexId, bool>::filled(false, mesh.n_vertices());
    let topology = &base.base.domain().topology;
    for e in topology.edge_ids() {
        for end in topology.ends(e) {
            valence[end] += 1;
            on_border[end] |= topology.is_border_edge(e);
        }
    }
    // At the border 4 is regular.
    let inner_valence = |v: VertexId| valence[v] + if on_border[v] { 2 } else { 0 };
    let farthest = |f: &[VertexId; 3]| f.map(inner_valence).into_iter().max_by_key(|n| n.abs_diff(6)).unwrap_or(6);
    let colors = mesh.faces().iter().map(|f| pale(valence_color(farthest(f)))).collect();
    let points = mesh.positions().ids().map(|v| dot(mesh, v, valence_color(inner_valence(v)))).collect();
    let arcs = &base.base_surface().network().arcs;
    let spans = base.base.domain().region.spans.iter();
    let lines = spans.map(|(&ends, span)| line(mesh, ends, arc_color(arcs[span.arc].kind), THICK)).collect();
    Scene { mesh, face_colors: Some(colors), lines, points }
}

/// All charts in rows, the pieces in the colours of the patches, and the base triangles before any improvement.
fn charts(map: &BaseMap) -> view::Chart {
    let mut drawing = view::Chart::default();
    let columns = (map.charts().len() as f64).sqrt().ceil().max(1.0) as usize;
    for (id, chart) in map.charts().enumerate() {
        let cell = DVec2::new((id.index() % columns) as f64, -((id.index() / columns) as f64));
        let fold = |pick: fn(DVec2, DVec2) -> DVec2| chart.uv().iter().copied().reduce(pick).unwrap_or(DVec2::ZERO);
        let (low, high) = (fold(DVec2::min), fold(DVec2::max));
        let place = |p: DVec2| cell + CHART_SHARE * (p - low) / (high - low).max_element().max(f64::MIN_POSITIVE);
        for piece in chart.faces() {
            drawing.polygon(piece.vertices.map(|v| place(chart.uv()[v as usize])), pale(palette(id.index())));
        }
        for [a, b, c] in map.first_faces(id).map(|corners| corners.map(place)) {
            drawing.line(a, b, DARK).line(b, c, DARK).line(c, a, DARK);
        }
    }
    drawing
}

fn by_quality(mesh: &TriMesh) -> Scene<'_> {
    let colors = mesh.faces().ids().map(|f| quality_color(aspect_ratio(mesh.triangle(f)))).collect();
    Scene { face_colors: Some(colors), ..Scene::new(mesh) }
}

/// Quality, the edges of the base mesh, and on top of them what lies on arcs.
fn result(remeshed: &Remeshed) -> Scene<'_> {
    let mesh = &remeshed.mesh;
    let mut scene = by_quality(mesh);
    let base_edges = sides_of_base(remeshed.stages.base.base.mesh().n_faces(), remeshed.report.certificate.levels);
    let ends = |(face, side): (usize, usize)| {
        let corners = mesh.face(FaceId::new(face));
        [corners[side], corners[(side + 1) % 3]]
    };
    scene.lines.extend(base_edges.into_iter().map(|side| line(mesh, ends(side), DARK, MEDIUM)));
    let arcs = &remeshed.stages.surface.network().arcs;
    let spans = remeshed.stages.region.spans.iter();
    scene.lines.extend(spans.map(|(&ends, span)| line(mesh, ends, arc_color(arcs[span.arc].kind), THICK)));
    scene
}

/// The sides of finest faces that lie on sides of base faces. By the order of children, side `i` of a face is side 0 of its
/// child `i` and side 2 of the next child.
fn sides_of_base(n_base_faces: usize, levels: u32) -> Vec<(usize, usize)> {
    let mut sides: Vec<(usize, usize)> = (0..n_base_faces).flat_map(|f| [0, 1, 2].map(|i| (f, i))).collect();
    for _ in 0..levels {
        sides = sides.iter().flat_map(|&(f, i)| [(4 * f + i, 0), (4 * f + (i + 1) % 3, 2)]).collect();
    }
    sides
}

/// The distance of every face's middle to the input.
fn distance(remeshed: &Remeshed) -> Scene<'_> {
    let (mesh, original) = (&remeshed.mesh, &remeshed.stages.base.cleaned.mesh);
    let (index, diagonal) = (SurfaceIndex::new(original), original.diagonal());
    let off = |f| index.closest(mesh.centroid(f)).map_or(0.0, |c| c.distance / diagonal);
    let colors = mesh.faces().ids().map(|f| distance_color(off(f))).collect();
    Scene { face_colors: Some(colors), ..Scene::new(mesh) }
}

/// Half way to white.
fn pale(color: Rgb) -> Rgb {
    color.map(|c| 128 + c / 2)
}

fn line(mesh: &TriMesh, ends: [VertexId; 2], color: Rgb, width: f64) -> Line {
    let [from, to] = ends.map(|v| mesh.position(v));
    Line { from, to, color, width }
}

fn along(mesh: &TriMesh, chain: &[VertexId], color: Rgb, width: f64) -> impl Iterator<Item = Line> {
    chain.windows(2).map(move |w| line(mesh, [w[0], w[1]], color, width))
}

fn dot(mesh: &TriMesh, v: VertexId, color: Rgb) -> Point {
    Point { at: mesh.position(v), color, width: DOT }
}

#[cfg(test)]
mod tests {
    use super::{files, sides_of_base};
    use std::path::Path;

    #[test]
    fn every_stage_has_two_files_and_the_charts_one() {
        let all = files(Path::new("a"), true);
        assert_eq!((all.len(), files(Path::new("a"), false).len()), (19, 11));
        assert!(all.contains(&"a/08-result.png".into()) && all.contains(&"a/05-charts.svg".into()));
    }

    #[test]
    fn sides_double_with_every_level_and_stay_in_their_base_face() {
        let sides = sides_of_base(2, 3);
        assert_eq!(sides.len(), 2 * 3 * 8);
        assert!(sides[..24].iter().all(|s| s.0 < 64) && sides[24..].iter().all(|s| (64..128).contains(&s.0)));
        // (a,ab,ca) (b,bc,ab) (c,ca,bc): side ab is a-ab of the first and ab-b of the second child.
        assert_eq!(sides_of_base(1, 1)[..2], [(0, 0), (1, 2)]);
    }
}
