//! The node hierarchy of a glTF file.

use crate::Labels;
use crate::error::Fault;
use glam::{DMat4, DQuat, DVec3, Quat, Vec3};
use gltf_json::{Index, Mesh, Node, Root};

/// A use of a mesh in the scene.
pub(super) struct Instance<'a> {
    pub(super) mesh: &'a Mesh,
    /// The number of the mesh in the file.
    pub(super) number: usize,
    /// From its coordinates to those of the scene.
    pub(super) transform: DMat4,
    /// The name of its node, or its own.
    pub(super) name: Option<&'a str>,
    /// The index of that name in the document.
    pub(super) object: u32,
}

/// Every use of a mesh in the scene, in the order of the nodes (parents before children).
///
/// The scene is the default one, else the first, else all nodes without parent, else all meshes where they are.
pub(super) fn instances(root: &Root) -> Result<Vec<Instance<'_>>, Fault> {
    if root.nodes.is_empty() {
        let alone =
            |(number, mesh)| Instance { mesh, number, transform: DMat4::IDENTITY, name: mesh_name(mesh), object: Labels::NONE };
        return Ok(root.meshes.iter().enumerate().map(alone).collect());
    }
    let mut found = Vec::new();
    let mut seen = vec![false; root.nodes.len()];
    let mut stack: Vec<(Index<Node>, DMat4)> = top_nodes(root)?.into_iter().rev().map(|n| (n, DMat4::IDENTITY)).collect();
    while let Some((index, parent)) = stack.pop() {
        let node = root.get(index).ok_or_else(|| Fault::data("gltf: a node that does not exist"))?;
        if std::mem::replace(&mut seen[index.value()], true) {
            return Err(Fault::data(format!("gltf: node {} has two parents or is its own ancestor", index.value())));
        }
        let transform = match local_transform(node) {
            Some(local) => parent * local,
            None => parent,
        };
        if let Some(index) = node.mesh {
            let mesh = root.get(index).ok_or_else(|| Fault::data("gltf: a mesh that does not exist"))?;
            let name = node.name.as_deref().or(mesh_name(mesh));
            found.push(Instance { mesh, number: index.value(), transform, name, object: Labels::NONE });
        }
        stack.extend(node.children.iter().flatten().rev().map(|&child| (child, transform)));
    }
    Ok(found)
}

fn mesh_name(mesh: &Mesh) -> Option<&str> {
    mesh.name.as_deref()
}

fn top_nodes(root: &Root) -> Result<Vec<Index<Node>>, Fault> {
    if let Some(scene) = root.scene {
        return Ok(root.get(scene).ok_or_else(|| Fault::data("gltf: a scene that does not exist"))?.nodes.clone());
    }
    if let Some(scene) = root.scenes.first() {
        return Ok(scene.nodes.clone());
    }
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|n| n.children.iter().flatten()) {
        if let Some(flag) = is_child.get_mut(child.value()) {
            *flag = true;
        }
    }
    Ok((0..root.nodes.len()).filter(|&i| !is_child[i]).map(|i| Index::new(i as u32)).collect())
}

/// The transform of a node, `None` for one that has none.
fn local_transform(node: &Node) -> Option<DMat4> {
    if let Some(matrix) = node.matrix {
        return Some(DMat4::from_cols_array(&matrix.map(f64::from)));
    }
    if node.translation.is_none() && node.rotation.is_none() && node.scale.is_none() {
        return None;
    }
    let scale = node.scale.map_or(DVec3::ONE, |s| Vec3::from(s).as_dvec3());
    let translation = node.translation.map_or(DVec3::ZERO, |t| Vec3::from(t).as_dvec3());
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |r| unit(Quat::from_array(r.0).as_dquat()));
    Some(DMat4::from_scale_rotation_translation(scale, rotation, translation))
}

/// The quaternion made of length 1: in the file it is so to f32 only. One without length turns nothing.
fn unit(q: DQuat) -> DQuat {
    if q.length_squared() > 0.0 { q.normalize() } else { DQuat::IDENTITY }
}
