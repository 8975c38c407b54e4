//! Bytes in a buffer, with the views and accessors that say what they are.

use serde_json::{Value, json};
use std::ops::Range;

/// `componentType` of f32.
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
/// `target` of a view of what vertices have.
pub(super) const TARGET_VERTICES: u32 = 34962;
/// `target` of a view of indices.
const TARGET_INDICES: u32 = 34963;
/// The least index that 16 bits do not hold: the greatest number is no index (glTF 2.0, section 3.7.2.1).
const TOO_MUCH_FOR_16_BITS: usize = 65535;

/// A buffer in the making.
#[derive(Default)]
pub(super) struct Packer {
    pub(super) bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

/// A view of indices.
#[derive(Clone, Copy)]
pub(super) struct IndexView {
    view: usize,
    component: u32,
    size: usize,
}

impl Packer {
    /// Appends bytes as a view; returns its number. Views begin at multiples of 4.
    pub(super) fn view(&mut self, bytes: impl IntoIterator<Item = u8>, target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
        self.views.len() - 1
    }

    /// Appends values of `N` numbers each; returns their accessor.
    pub(super) fn floats<const N: usize>(&mut self, values: &[[f32; N]], target: u32) -> usize {
        let view = self.view(values.iter().flatten().flat_map(|x| x.to_le_bytes()), Some(target));
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.accessor(json!({ "bufferView": view, "componentType": FLOAT, "count": values.len(), "type": kind }))
    }

    /// Says between which numbers the values of an accessor are.
    pub(super) fn bound<const N: usize>(&mut self, accessor: usize, values: &[[f32; N]]) {
        let bound = |pick: fn(f32, f32) -> f32| {
            let all = values.iter().copied().reduce(|a, b| std::array::from_fn(|i| pick(a[i], b[i])));
            Value::from(all.map(|bound| bound.to_vec()).unwrap_or_default())
        };
        self.accessors[accessor]["min"] = bound(f32::min);
        self.accessors[accessor]["max"] = bound(f32::max);
    }

    /// Appends indices of so many vertices; returns their accessor.
    pub(super) fn indices(&mut self, indices: impl Iterator<Item = u32>, n_vertices: usize) -> usize {
        let view = self.index_view(indices, n_vertices);
        let length = self.views[view.view]["byteLength"].as_u64().unwrap_or(0) as usize;
        self.some_indices(view, 0..length / view.size)
    }

    /// Appends indices of so many vertices, in 16 bits where these are enough.
    pub(super) fn index_view(&mut self, indices: impl Iterator<Item = u32>, n_vertices: usize) -> IndexView {
        if n_vertices <= TOO_MUCH_FOR_16_BITS {
            let view = self.view(indices.flat_map(|i| (i as u16).to_le_bytes()), Some(TARGET_INDICES));
            return IndexView { view, component: UNSIGNED_SHORT, size: 2 };
        }
        let view = self.view(indices.flat_map(u32::to_le_bytes), Some(TARGET_INDICES));
        IndexView { view, component: UNSIGNED_INT, size: 4 }
    }

    /// The accessor of some of the indices of a view.
    pub(super) fn some_indices(&mut self, indices: IndexView, range: Range<usize>) -> usize {
        let IndexView { view, component, size } = indices;
        let offset = range.start * size;
        let (count, kind) = (range.len(), "SCALAR");
        self.accessor(
            json!({ "bufferView": view, "byteOffset": offset, "componentType": component, "count": count, "type": kind }),
        )
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds buffer, views and accessors to a document.
    pub(super) fn end(&mut self, root: &mut Value) {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        root["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        root["bufferViews"] = std::mem::take(&mut self.views).into();
        root["accessors"] = std::mem::take(&mut self.accessors).into();
    }
}
