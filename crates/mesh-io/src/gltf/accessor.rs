//! Numbers from glTF accessors.

use super::buffers::{Buffers, Strided};
use crate::error::Fault;
use gltf_json::accessor::{ComponentType, sparse};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index};

/// The elements of an accessor of `N` components each, sparse ones included. `f64` holds every component type exactly.
///
/// Positions are read in all types, normalised ones too, as the extension KHR_mesh_quantization wants.
pub(super) fn numbers<const N: usize>(buffers: &Buffers, index: Index<Accessor>) -> Result<Vec<[f64; N]>, Fault> {
    let accessor = buffers.root.get(index).ok_or_else(|| Fault::data("gltf: an accessor that does not exist"))?;
    let (Checked::Valid(component), Checked::Valid(kind)) = (&accessor.component_type, &accessor.type_) else {
        return Err(Fault::data("gltf: an accessor of unknown type"));
    };
    if kind.multiplicity() != N {
        return Err(Fault::data(format!("gltf: an accessor with {} components instead of {N}", kind.multiplicity())));
    }
    let decoder = Decoder { component: component.0, normalized: accessor.normalized };
    let mut values = match accessor.buffer_view {
        Some(view) => {
            let offset = accessor.byte_offset.unwrap_or_default().0;
            decoder.all(&buffers.elements(view, offset, accessor.count.0, N * component.0.size())?)
        }
        None => zeros(buffers, accessor.count.0)?,
    };
    if let Some(sparse) = &accessor.sparse {
        replace_some(buffers, sparse, decoder, &mut values)?;
    }
    Ok(values)
}

/// Elements without a view are 0 until the sparse part replaces them. There is no use in more of them than the file has bytes.
fn zeros<const N: usize>(buffers: &Buffers, count: u64) -> Result<Vec<[f64; N]>, Fault> {
    match usize::try_from(count) {
        Ok(count) if count <= buffers.n_bytes() => Ok(vec![[0.0; N]; count]),
        _ => Err(Fault::data(format!("gltf: an accessor of {count} elements without data"))),
    }
}

fn replace_some<const N: usize>(
    buffers: &Buffers,
    sparse: &sparse::Sparse,
    decoder: Decoder,
    values: &mut [[f64; N]],
) -> Result<(), Fault> {
    let Checked::Valid(index_type) = &sparse.indices.component_type else {
        return Err(Fault::data("gltf: sparse indices of unknown type"));
    };
    let index_decoder = Decoder { component: index_type.0, normalized: false };
    let (at, by) = (&sparse.indices, &sparse.values);
    let indices = buffers.elements(at.buffer_view, at.byte_offset.0, sparse.count.0, index_type.0.size())?;
    let replacements = buffers.elements(by.buffer_view, by.byte_offset.0, sparse.count.0, N * decoder.component.size())?;
    for ([index], value) in index_decoder.all::<1>(&indices).into_iter().zip(decoder.all(&replacements)) {
        let slot = values.get_mut(index as usize);
        *slot.ok_or_else(|| Fault::data(format!("gltf: sparse index {index} is out of range")))? = value;
    }
    Ok(())
}

/// How the components of an accessor become numbers.
#[derive(Clone, Copy)]
struct Decoder {
    component: ComponentType,
    normalized: bool,
}

impl Decoder {
    fn all<const N: usize>(self, elements: &Strided) -> Vec<[f64; N]> {
        let size = self.component.size();
        elements.iter().map(|bytes| std::array::from_fn(|i| self.one(&bytes[i * size..(i + 1) * size]))).collect()
    }

    /// One component, given exactly its bytes. Normalised integers as section 3.11 of the glTF 2.0 specification has them.
    fn one(self, bytes: &[u8]) -> f64 {
        let mut little_endian = [0; 4];
        little_endian[..bytes.len()].copy_from_slice(bytes);
        let bits = u32::from_le_bytes(little_endian);
        let (value, largest) = match self.component {
            ComponentType::I8 => (f64::from(bits as i8), 127.0),
            ComponentType::U8 => (f64::from(bits as u8), 255.0),
            ComponentType::I16 => (f64::from(bits as i16), 32767.0),
            ComponentType::U16 => (f64::from(bits as u16), 65535.0),
            ComponentType::U32 => return f64::from(bits),
            ComponentType::F32 => return f64::from(f32::from_bits(bits)),
        };
        if self.normalized { (value / largest).max(-1.0) } else { value }
    }
}
