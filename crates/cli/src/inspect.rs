//! `semireg inspect INPUT`: what is it?

use crate::args::InspectArgs;
use crate::figures::{Shape, surface_words};
use crate::print::{self, Table};
use crate::repairs::Repairs;
use crate::verdict::Verdict;
use certify::SharpEdges;
use features::FeatureOptions;
use mesh_core::{CleanOptions, Cleaned, Inspection};
use mesh_io::Document;
use region_map::{ArcKind, CreaseLengths};
use serde::Serialize;

#[derive(Serialize)]
struct Inspected {
    input: String,
    counts: Counts,
    /// What else the file holds, in words.
    also_holds: Vec<String>,
    /// Repairs that remeshing would begin with.
    repairs: Repairs,
    /// After these repairs; none where nothing is left to work on.
    cleaned: Option<Surface>,
}

/// As read, and after merging vertices at exactly the same position.
#[derive(Serialize)]
struct Counts {
    polygons: usize,
    polygons_above_3: usize,
    triangles: usize,
    vertices: usize,
    merged_vertices: usize,
    components: usize,
    boundary_loops: usize,
    genus: Option<i64>,
    non_manifold_edges: usize,
    non_manifold_vertices: usize,
    inconsistent_edges: usize,
    zero_area: usize,
    repeated: usize,
    bad_index: usize,
    not_finite: usize,
}

#[derive(Serialize)]
struct Surface {
    vertices: usize,
    triangles: usize,
    components: usize,
    boundary_loops: usize,
    genus: i64,
    diagonal: f64,
    area: f64,
    features: Features,
    #[serde(flatten)]
    shape: Shape,
}

/// Edges that bend by 40 degrees or more, in the units of the file; nothing simplified.
#[derive(Serialize)]
struct Features {
    crease_length: f64,
    border_length: f64,
    /// Length of the edges that a person sees as sharp.
    sharp_length: f64,
    arcs: usize,
    corners: usize,
}

/// Prints counts, defects, features and quality of a file.
pub(crate) fn run(args: &InspectArgs) -> anyhow::Result<()> {
    let source = args.stream.source(&args.input)?;
    let document = source.read()?;
    let cleaned = mesh_core::clean(&document.soup, &CleanOptions::default());
    let inspected = Inspected {
        input: source.to_string(),
        counts: counts(&document, mesh_core::inspect(&document.soup)),
        also_holds: document.extras.iter().map(ToString::to_string).collect(),
        repairs: cleaned.as_ref().ok().map(|c| Repairs::new(&c.report).only_made()).unwrap_or_default(),
        cleaned: cleaned.as_ref().ok().map(surface).transpose()?,
    };
    let Err(e) = cleaned else {
        return print::report(args.talk, &inspected, || summary(&inspected), || table(&inspected));
    };
    // The counts are worth showing, but there is nothing to remesh.
    let failure = anyhow::Error::from(e).context(inspected.input.clone());
    Err(print::failed(args.talk, &inspected, failure, || summary(&inspected), || table(&inspected)))
}

fn counts(document: &Document, seen: Inspection) -> Counts {
    Counts {
        polygons: document.n_polygons,
        polygons_above_3: document.n_polygons_above_3,
        triangles: seen.triangles,
        vertices: seen.vertices,
        merged_vertices: seen.merged_vertices,
        components: seen.components,
        boundary_loops: seen.boundary_loops,
        genus: seen.genus,
        non_manifold_edges: seen.non_manifold_edges,
        non_manifold_vertices: seen.non_manifold_vertices,
        inconsistent_edges: seen.inconsistent_edges,
        zero_area: seen.zero_area,
        repeated: seen.repeated,
        bad_index: seen.bad_index,
        not_finite: seen.not_finite,
    }
}

fn surface(cleaned: &Cleaned) -> anyhow::Result<Surface> {
    let (mesh, topology) = (&cleaned.mesh, &cleaned.topology);
    Ok(Surface {
        vertices: mesh.n_vertices(),
        triangles: mesh.n_faces(),
        components: topology.components().1,
        boundary_loops: topology.border_loops().len(),
        genus: topology.genus(),
        diagonal: mesh.diagonal(),
        area: mesh.total_area(),
        features: features(cleaned)?,
        shape: Shape::from(&certify::quality(mesh)),
    })
}

fn features(cleaned: &Cleaned) -> anyhow::Result<Features> {
    let strong = FeatureOptions::default().strong_angle;
    let options = FeatureOptions { weak_angle: strong, ..FeatureOptions::default() };
    let network = features::detect(&cleaned.mesh, &cleaned.topology, &[], 0.0, &options)?;
    let CreaseLengths { kept, minor } = network.crease_lengths(&cleaned.mesh);
    Ok(Features {
        crease_length: kept + minor,
        border_length: network.arcs.iter().filter(|arc| arc.kind == ArcKind::Border).map(|arc| arc.length()).sum(),
        sharp_length: SharpEdges::new(&cleaned.mesh, certify::mean_edge(&cleaned.mesh)).length(),
        arcs: network.arcs.len(),
        corners: network.corners.len(),
    })
}

/// What is wrong as read: how many, and of what.
fn defects(c: &Counts) -> Vec<String> {
    [
        ("edges of more than 2 triangles", c.non_manifold_edges),
        ("vertices that are not manifold", c.non_manifold_vertices),
        ("edges of inconsistent orientation", c.inconsistent_edges),
        ("triangles without area", c.zero_area),
        ("repeated triangles", c.repeated),
        ("triangles with a bad index", c.bad_index),
        ("coordinates that are not finite", c.not_finite),
    ]
    .into_iter()
    .filter(|(_, count)| *count > 0)
    .map(|(name, count)| format!("{count} {name}"))
    .collect()
}

/// What matters, in at most ten lines.
fn summary(inspected: &Inspected) -> Table {
    let (mut table, c) = (Table::default(), &inspected.counts);
    table.row("file", format!("{} (-v shows all figures)", inspected.input));
    table.row("as read", format!("{} vertices, {} triangles", c.vertices, c.triangles));
    let defects = defects(c);
    let told = match defects.as_slice() {
        [] => format!("{}: none", Verdict::Good),
        [only] => only.clone(),
        [first, others @ ..] => format!("{first}, and {} other kinds", others.len()),
    };
    let verdict = if inspected.cleaned.is_some() { Verdict::Fair } else { Verdict::Poor };
    table.row("defects", if defects.is_empty() { told } else { format!("{verdict}: {told}") });
    if let Some(s) = &inspected.cleaned {
        let repaired = format!("{} vertices, {} triangles", s.vertices, s.triangles);
        table.row_if("after repair", (!defects.is_empty()).then_some(repaired));
        table.row("surface", surface_words(s.components, s.boundary_loops, Some(s.genus)));
        table.row("size", format!("diagonal {:.6}, area {:.6}", s.diagonal, s.area));
        s.shape.summary(&mut table);
        let Features { sharp_length, border_length, .. } = s.features;
        table.row(
            "sharp edges",
            if sharp_length > 0.0 { format!("length {sharp_length:.6}") } else { "none that stand out".into() },
        );
        table.row_if("open borders", (border_length > 0.0).then(|| format!("length {border_length:.6}")));
    }
    also_holds_row(&mut table, inspected);
    table
}

fn also_holds_row(table: &mut Table, inspected: &Inspected) {
    table.row_if("also holds", (!inspected.also_holds.is_empty()).then(|| inspected.also_holds.join(", ")));
}

/// All figures, one line each.
fn table(inspected: &Inspected) -> Table {
    let (mut table, c) = (Table::default(), &inspected.counts);
    table.row("file", &inspected.input);
    table.row("as read", format!("{} vertices, {} triangles", c.vertices, c.triangles));
    table.row_if(
        "polygons",
        (c.polygons_above_3 > 0).then(|| format!("{}, {} of more than 3 sides", c.polygons, c.polygons_above_3)),
    );
    table.row("merged", format!("{} vertices at different positions", c.merged_vertices));
    let genus = c.genus.map_or("unknown".to_owned(), |g| g.to_string());
    table.row("topology", format!("{} components, {} border loops, genus {genus}", c.components, c.boundary_loops));
    for defect in defects(c) {
        table.row("defect", defect);
    }
    inspected.repairs.rows(&mut table);
    if let Some(s) = &inspected.cleaned {
        table.row("repaired", format!("{} vertices, {} triangles", s.vertices, s.triangles));
        let Surface { components, boundary_loops, genus, .. } = s;
        table.row("topology", format!("{components} components, {boundary_loops} border loops, genus {genus}"));
        table.row("size", format!("diagonal {:.6}, area {:.6}", s.diagonal, s.area));
        let f = &s.features;
        table.row(
            "creases",
            format!("length {:.6} in {} arcs with {} corners (borders included)", f.crease_length, f.arcs, f.corners),
        );
        table.row("sharp edges", format!("length {:.6} that a person sees as sharp", f.sharp_length));
        table.row_if("border", (f.border_length > 0.0).then(|| format!("length {:.6}", f.border_length)));
        s.shape.rows(&mut table);
    }
    also_holds_row(&mut table, inspected);
    table
}
