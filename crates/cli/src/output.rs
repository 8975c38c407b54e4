//! The result with what belongs to it: normals, feature curves, and what the input has.

use crate::carry::{carried, looks};
use crate::kept::FeaturesArg;
use crate::outputs::ResultFiles;
use crate::plan::RemeshPlan;
use crate::{load, map_file};
use glam::DVec3;
use mesh_core::{EdgeId, IdVec, Topology, TriMesh, VertexId};
use mesh_io::{Attributes, Document, Extra, Format, Level, Looks, Settings};
use region_map::ArcKind;
use semireg::Remeshed;
use std::collections::BTreeMap;
use std::path::Path;

/// What the files of a result are written from.
pub(crate) struct Writer<'a> {
    pub(crate) plan: &'a RemeshPlan,
    pub(crate) document: &'a Document,
    pub(crate) remeshed: &'a Remeshed,
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
}

impl Writer<'_> {
    /// Writes the files of a result; returns warnings of what the input has and the output does not. The output comes last: when anything
    /// fails, there is no result beside the error.
    pub(crate) fn write(&self, files: &ResultFiles) -> anyhow::Result<Vec<String>> {
        let outputs = &self.plan.outputs;
        if let Some(path) = &files.map {
            map_file::write(path, &self.remeshed.map(&self.document.soup, outputs.level, outputs.order)?)?;
        }
        let format = files.output.format()?;
        let dressed = |k: u32| self.dressed(k, format, files.output.folder());
        for (k, path) in files.levels.iter().enumerate() {
            let level = dressed(k as u32)?;
            mesh_io::write_with(path, &level.mesh, &level.settings())?;
        }
        let finest = match files.output.file().filter(|_| outputs.are_in_one(files)) {
            Some(path) => {
                let levels: Vec<Dressed> = (0..=outputs.level).map(dressed).collect::<anyhow::Result<_>>()?;
                let all: Vec<Level> =
                    levels.iter().map(|level| Level { mesh: &level.mesh, settings: level.settings() }).collect();
                mesh_io::write_levels(path, &all)?;
                levels.into_iter().next_back()
            }
            None => {
                let level = dressed(outputs.level)?;
                files.output.write_with(&level.mesh, &level.settings())?;
                Some(level)
            }
        };
        Ok(self.lost(&finest.map(|level| level.attributes).unwrap_or_default(), format))
    }

    /// A level with what belongs to it, for a file of this format in this folder.
    fn dressed(&self, level: u32, format: Format, folder: &Path) -> anyhow::Result<Dressed> {
        let Self { plan, document, remeshed } = *self;
        let mesh = plan.outputs.order.ordered(&remeshed.level(level)?, level)?;
        if plan.plain {
            return Ok(Dressed { mesh, attributes: Attributes::default(), lines: Vec::new() });
        }
        let mut attributes = carried(document, &remeshed.stages.base.cleaned, &mesh, format);
        attributes.looks = looks(attributes.looks, format, [plan.input.folder(), folder]);
        let curves = curves(remeshed, level)?;
        if format.holds(&Extra::Normals) {
            attributes.normals = normals(plan, &mesh, &curves);
        }
        Ok(Dressed { mesh, attributes, lines: curves.into_keys().map(|ends| ends.map(|v| v.0)).collect() })
    }

    /// Warnings of what the input has and an output with these attributes does not.
    fn lost(&self, attributes: &Attributes, format: Format) -> Vec<String> {
        let document = self.document;
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

/// Edges of a level on creases and marked edges. Borders are seen anyway.
fn curves(remeshed: &Remeshed, level: u32) -> anyhow::Result<Curves> {
    let arcs = &remeshed.stages.surface.network().arcs;
    let spans = remeshed.stages.region.spans.iter().map(|(&ends, span)| (rising(ends), arcs[span.arc].kind));
    let mut curves: Curves = spans.filter(|(_, kind)| *kind != ArcKind::Border).collect();
    for coarser in (level..remeshed.report.certificate.levels).rev() {
        curves = coarser_curves(&remeshed.level(coarser)?, &remeshed.level(coarser + 1)?, &curves);
    }
    Ok(curves)
}

/// The edges of a level both halves of which are on feature curves of the next one.
fn coarser_curves(coarse: &TriMesh, fine: &TriMesh, curves: &Curves) -> Curves {
    let mut found = Curves::new();
    for (f, face) in coarse.faces().iter().enumerate() {
        for side in 0..3 {
            let (v, w) = (face[side], face[(side + 1) % 3]);
            // Child number `side` has that corner of the face first, and then the middle of the side.
            let middle = fine.faces().as_slice()[4 * f + side][1];
            let halves = [rising([v, middle]), rising([middle, w])].map(|half| curves.get(&half));
            if let [Some(&kind), Some(_)] = halves {
                found.insert(rising([v, w]), kind);
            }
        }
    }
    found
}

fn rising([v, w]: [VertexId; 2]) -> [VertexId; 2] {
    [v.min(w), v.max(w)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A feature curve along one side of a triangle is there on the coarse level if both halves of the side have it.
    #[test]
    fn a_coarse_edge_is_a_curve_where_both_halves_are() {
        let positions = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let coarse = TriMesh::from_slices(&positions[..3], &[[0, 1, 2]]).unwrap();
        let fine = TriMesh::from_slices(&positions, &[[0, 3, 5], [1, 4, 3], [2, 5, 4], [4, 5, 3]]).unwrap();
        let curves = |edges: &[[u32; 2]]| -> Curves { edges.iter().map(|e| (e.map(VertexId), ArcKind::Sharp)).collect() };
        assert_eq!(coarser_curves(&coarse, &fine, &curves(&[[0, 3], [1, 3], [1, 4], [3, 4]])), curves(&[[0, 1]]));
    }
}
