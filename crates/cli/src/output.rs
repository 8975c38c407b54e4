//! The result with what belongs to it: normals, feature curves, and what the input has.

use crate::carry::{Carrier, looks};
use crate::displacement_figures::DisplacementFigures;
use crate::displacement_folder::{self, Contents};
use crate::kept::FeaturesArg;
use crate::outputs::ResultFiles;
use crate::plan::RemeshPlan;
use crate::{load, map_file};
use glam::DVec3;
use mesh_core::{EdgeId, IdVec, Topology, TriMesh, VertexId};
use mesh_io::{Attributes, Document, Extra, Format, Level, Looks, Settings};
use region_map::{ArcKind, Attachment};
use semireg::{Levels, Remeshed};
use std::collections::BTreeMap;
use std::path::Path;

/// What the files of a result are written from.
pub(crate) struct Writer<'a> {
    plan: &'a RemeshPlan,
    document: &'a Document,
    remeshed: &'a Remeshed,
    levels: Levels<'a>,
    /// The level that the output holds.
    level: u32,
    /// The files that are written.
    files: &'a ResultFiles,
    format: Format,
    /// `None` where the input has nothing that the files could have.
    carrier: Option<Carrier<'a>>,
}

/// What came of writing.
pub(crate) struct Written {
    /// Warnings of what the input has and the output does not.
    pub(crate) lost: Vec<String>,
    pub(crate) displacement: Option<DisplacementFigures>,
}

/// A level with what belongs to it.
struct Dressed {
    mesh: TriMesh,
    attributes: Attributes,
    lines: Vec<[u32; 2]>,
}

impl Dressed {
    fn settings(&self) -> Settings<'_> {
        Settings { attributes: &self.attributes, lines: &self.lines }
    }

    fn level(&self) -> Level<'_> {
        Level { mesh: &self.mesh, settings: self.settings() }
    }
}

impl<'a> Writer<'a> {
    /// Makes ready to write the files of a result. Fails where their format is unknown.
    pub(crate) fn new(
        plan: &'a RemeshPlan,
        document: &'a Document,
        remeshed: &'a Remeshed,
        files: &'a ResultFiles,
    ) -> anyhow::Result<Self> {
        let format = files.output.format()?;
        let cleaned = &remeshed.stages.base.cleaned;
        let carrier = if plan.plain { None } else { Carrier::new(document, cleaned, format) };
        let levels = remeshed.levels()?;
        let level = plan.outputs.level.unwrap_or(levels.finest());
        Ok(Self { plan, document, remeshed, levels, level, files, format, carrier })
    }

    /// Writes the files. The output comes last: when anything fails, there is no result beside the error.
    pub(crate) fn write(&self) -> anyhow::Result<Written> {
        let (outputs, files, level) = (&self.plan.outputs, self.files, self.level);
        if let Some(path) = &files.map {
            map_file::write(path, &self.remeshed.map(&self.document.soup, level, outputs.order)?)?;
        }
        let displacement = files.displacement.as_deref().map(|folder| self.write_displacement(folder)).transpose()?;
        let written = self.dressed(level)?;
        let coarser: Vec<Dressed> = match outputs.all_levels {
            true => (0..level).map(|k| self.dressed(k)).collect::<anyhow::Result<_>>()?,
            false => Vec::new(),
        };
        let all: Vec<Level> = coarser.iter().chain([&written]).map(Dressed::level).collect();
        for (path, level) in files.levels.iter().zip(&all) {
            mesh_io::write_with(path, level.mesh, &level.settings)?;
        }
        match files.output.file().filter(|_| outputs.are_in_one(files)) {
            Some(path) => mesh_io::write_levels(path, &all)?,
            None => files.output.write_with(&written.mesh, &written.settings())?,
        }
        Ok(Written { lost: self.lost(&written.attributes), displacement })
    }

    /// Writes the folder of displacements up to the level of the output.
    fn write_displacement(&self, folder: &Path) -> anyhow::Result<DisplacementFigures> {
        let (level, bits) = (self.level, self.plan.outputs.displacement_bits);
        let curves = self.curves(0)?;
        let corners = self.base_corners(&curves)?;
        let creases: Vec<[u32; 2]> = curves.into_keys().map(|ends| ends.map(|v| v.0)).collect();
        let mesh = self.levels.mesh(level)?;
        displacement_folder::write(folder, &Contents { mesh: &mesh, level, bits, creases: &creases, corners: &corners })
    }

    /// Vertices of the base mesh at corners of the network, and where one feature curve ends or several meet. Borders count as curves.
    fn base_corners(&self, curves: &Curves) -> anyhow::Result<Vec<u32>> {
        let base = self.levels.mesh(0)?;
        let topology = Topology::new(base.faces(), base.n_vertices())?;
        let borders = topology.edge_ids().filter(|&e| topology.is_border_edge(e)).map(|e| topology.ends(e));
        let mut n_curves: IdVec<VertexId, usize> = IdVec::filled(0, base.n_vertices());
        borders.chain(curves.keys().copied()).flatten().for_each(|v| n_curves[v] += 1);
        let attachments = &self.remeshed.stages.region.attachments;
        let is_corner = |v: &VertexId| ![0, 2].contains(&n_curves[*v]) || matches!(attachments[*v], Attachment::Corner(_));
        Ok(n_curves.ids().filter(is_corner).map(|v| v.0).collect())
    }

    /// A level with what belongs to it.
    fn dressed(&self, level: u32) -> anyhow::Result<Dressed> {
        let plan = self.plan;
        let mesh = plan.outputs.order.ordered(&self.levels.mesh(level)?, level)?;
        if plan.plain {
            return Ok(Dressed { mesh, attributes: Attributes::default(), lines: Vec::new() });
        }
        let mut attributes = self.carrier.as_ref().map(|carrier| carrier.carried(&mesh)).unwrap_or_default();
        attributes.looks = looks(attributes.looks, self.format, [plan.input.folder(), self.files.output.folder()]);
        let curves = self.curves(level)?;
        if self.format.holds(&Extra::Normals) {
            attributes.normals = normals(plan, &mesh, &curves);
        }
        Ok(Dressed { mesh, attributes, lines: curves.into_keys().map(|ends| ends.map(|v| v.0)).collect() })
    }

    /// Edges of a level on creases and marked edges. Borders are seen anyway.
    fn curves(&self, level: u32) -> anyhow::Result<Curves> {
        let stages = &self.remeshed.stages;
        let kind = |arc| stages.surface.network().arcs[arc].kind;
        let spans = stages.region.spans.iter().map(|(&[v, w], span)| (rising(v, w), kind(span.arc)));
        let finest: Curves = spans.filter(|(_, kind)| *kind != ArcKind::Border).collect();
        let mut finer = (level + 1..=self.levels.finest()).rev();
        finer.try_fold(finest, |curves, finer| Ok(coarser_curves(&self.levels.parents(finer)?, &curves)))
    }

    /// Warnings of what the input has and an output with these attributes does not.
    fn lost(&self, attributes: &Attributes) -> Vec<String> {
        let Self { document, format, .. } = *self;
        if self.plan.plain {
            return load::lost(&document.extras).into_iter().collect();
        }
        let lost: Vec<Extra> = document.extras.iter().filter_map(|extra| not_carried(extra, attributes, format)).collect();
        let names_alone =
            !attributes.materials.is_empty() && document.attributes.looks != Looks::Unknown && attributes.looks == Looks::Unknown;
        let names_alone = names_alone.then(|| "of the materials only the names are carried over to this format".to_owned());
        load::lost(&lost).into_iter().chain(names_alone).collect()
    }
}

/// What of something that the input has the output does not have.
fn not_carried(extra: &Extra, attributes: &Attributes, format: Format) -> Option<Extra> {
    match extra {
        Extra::Properties(names) => {
            let is_there =
                |name: &String| attributes.vertex_values.iter().chain(&attributes.face_values).any(|v| v.name == *name);
            let lost: Vec<String> = names.iter().filter(|name| !is_there(name)).cloned().collect();
            (!lost.is_empty()).then_some(Extra::Properties(lost))
        }
        Extra::Textures(_) if attributes.looks == Looks::Unknown => Some(extra.clone()),
        _ => (!format.holds(extra)).then(|| extra.clone()),
    }
}

/// Normals of a level, smooth but across its hard edges.
fn normals(plan: &RemeshPlan, mesh: &TriMesh, curves: &Curves) -> Vec<[DVec3; 3]> {
    let Ok(topology) = Topology::new(mesh.faces(), mesh.n_vertices()) else { return Vec::new() };
    let mut is_hard: IdVec<EdgeId, bool> = IdVec::filled(false, topology.n_edges());
    for (&[v, w], &kind) in curves {
        let Some(e) = topology.find_edge(v, w) else { continue };
        let is_bent = || match topology.edge_faces(e) {
            (f, Some(g)) => {
                let angle = mesh.normal(f).angle_between(mesh.normal(g));
                angle.to_degrees() >= plan.options.features.strong_angle
            }
            (_, None) => false,
        };
        // What the user marked is hard where it is a crease by its angle, too, or because the file's normals mark it.
        is_hard[e] = kind == ArcKind::Sharp || plan.marks.features == FeaturesArg::Normals || is_bent();
    }
    let normals = attributes::corner_normals(mesh, &topology, &is_hard);
    normals.into_iter().map(|t| t.map(DVec3::from)).collect()
}

/// Edges on feature curves, by their ends in rising order.
type Curves = BTreeMap<[VertexId; 2], ArcKind>;

/// The edges of a level both halves of which are on feature curves of the next one, whose vertices have these parents.
fn coarser_curves(parents: &[[u32; 2]], curves: &Curves) -> Curves {
    let edge = |(middle, &[v, w]): (usize, &[u32; 2])| {
        let [v, w, middle] = [v, w, middle as u32].map(VertexId);
        let halves = [v, w].map(|end| curves.get(&rising(end, middle)));
        if let [Some(&kind), Some(_)] = halves { Some((rising(v, w), kind)) } else { None }
    };
    parents.iter().enumerate().filter_map(edge).collect()
}

fn rising(v: VertexId, w: VertexId) -> [VertexId; 2] {
    [v.min(w), v.max(w)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A feature curve along one side of a triangle is there on the coarse level if both halves of the side have it.
    #[test]
    fn a_coarse_edge_is_a_curve_where_both_halves_are() {
        // A triangle 0 1 2, with vertices 3, 4 and 5 in the middles of its sides.
        let parents = [[0, 0], [1, 1], [2, 2], [0, 1], [1, 2], [0, 2]];
        let curves = |edges: &[[u32; 2]]| -> Curves { edges.iter().map(|e| (e.map(VertexId), ArcKind::Sharp)).collect() };
        assert_eq!(coarser_curves(&parents, &curves(&[[0, 3], [1, 3], [1, 4], [3, 4]])), curves(&[[0, 1]]));
    }
}
