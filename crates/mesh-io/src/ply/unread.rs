//! What a ply file holds that is not read.

use super::header::{Element, Property};
use crate::extra::{Extra, Extras};

/// Notes the properties of an element that are not read, or the element as a whole.
pub(super) fn note(element: &Element, extras: &mut Extras) {
    if element.count == 0 || element.properties.is_empty() {
        return;
    }
    let read: &[&str] = match element.name.as_str() {
        "vertex" => &["x", "y", "z"],
        "face" | "tristrips" => &["vertex_indices", "vertex_index"],
        // Their lines are read.
        "edge" => return,
        other => return extras.property(other.to_owned()),
    };
    for property in element.properties.iter().filter(|p| !read.contains(&p.name.as_str())) {
        extras.note(extra(property));
    }
}

/// What a property means, by the names that programs use.
fn extra(property: &Property) -> Extra {
    match property.name.as_str() {
        "nx" | "ny" | "nz" => Extra::Normals,
        "red" | "green" | "blue" | "alpha" | "r" | "g" | "b" | "a" | "diffuse_red" | "diffuse_green" | "diffuse_blue" => {
            Extra::Colors
        }
        "s" | "t" | "u" | "v" | "texture_u" | "texture_v" | "texcoord" | "texnumber" => Extra::TextureCoordinates,
        name => Extra::Properties(vec![name.to_owned()]),
    }
}
