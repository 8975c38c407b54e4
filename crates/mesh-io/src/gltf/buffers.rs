//! The buffers of a glTF file, and bounds-checked views of them.

use crate::base64;
use crate::error::Fault;
use gltf_json::{Index, Root, buffer};
use std::borrow::Cow;
use std::fs;
use std::path::Path;

/// A glTF file with all its buffers.
pub(super) struct Buffers<'a> {
    pub(super) root: &'a Root,
    data: Vec<Cow<'a, [u8]>>,
}

/// Elements of the same size at the same distance from each other.
pub(super) struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
}

impl Strided<'_> {
    /// The bytes of every element.
    pub(super) fn iter(&self) -> impl Iterator<Item = &[u8]> {
        self.bytes.chunks(self.stride).map(|chunk| &chunk[..self.size])
    }
}

impl<'a> Buffers<'a> {
    /// Fetches all buffers: `blob` is that of a glb, others are data URIs or files in `directory`.
    pub(super) fn load(root: &'a Root, blob: Option<Cow<'a, [u8]>>, directory: Option<&Path>) -> Result<Self, Fault> {
        let mut blob = blob;
        let fetch = |buffer: &gltf_json::Buffer| match &buffer.uri {
            Some(uri) => resolve(uri, directory).map(Cow::Owned),
            None => blob.take().ok_or_else(|| Fault::data("gltf: a buffer has no URI and there is no binary chunk for it")),
        };
        Ok(Self { root, data: root.buffers.iter().map(fetch).collect::<Result<_, _>>()? })
    }

    /// Number of bytes in all buffers.
    pub(super) fn n_bytes(&self) -> usize {
        self.data.iter().map(|d| d.len()).sum()
    }

    /// The bytes of a view, `None` where it is not there or reaches past its buffer.
    pub(super) fn view(&self, view: Index<buffer::View>) -> Option<&[u8]> {
        let view = self.root.get(view)?;
        slice(self.data.get(view.buffer.value())?, view.byte_offset.unwrap_or_default().0, view.byte_length.0)
    }

    /// `count` elements of `size` bytes, `offset` bytes after the start of a view. All bounds are checked here.
    pub(super) fn elements(&self, view: Index<buffer::View>, offset: u64, count: u64, size: usize) -> Result<Strided<'_>, Fault> {
        let outside = || Fault::data("gltf: an accessor reaches past the end of its buffer");
        let view = self.root.get(view).ok_or_else(|| Fault::data("gltf: a buffer view that does not exist"))?;
        let data = self.data.get(view.buffer.value()).ok_or_else(|| Fault::data("gltf: a buffer that does not exist"))?;
        let view_bytes = slice(data, view.byte_offset.unwrap_or_default().0, view.byte_length.0).ok_or_else(outside)?;
        let stride = match view.byte_stride {
            Some(stride) if stride.0 != 0 => stride.0,
            _ => size,
        };
        if stride < size {
            return Err(Fault::data(format!("gltf: elements of {size} bytes in steps of {stride}")));
        }
        let length = match count {
            0 => 0,
            _ => (count - 1).checked_mul(stride as u64).and_then(|l| l.checked_add(size as u64)).ok_or_else(outside)?,
        };
        let bytes = slice(view_bytes, offset, length).ok_or_else(outside)?;
        Ok(Strided { bytes, stride, size })
    }
}

fn slice(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(offset).ok()?;
    bytes.get(start..start.checked_add(usize::try_from(length).ok()?)?)
}

fn resolve(uri: &str, directory: Option<&Path>) -> Result<Vec<u8>, Fault> {
    if let Some(data) = uri.strip_prefix("data:") {
        let encoded = data.split_once(";base64,").map(|(_, encoded)| encoded);
        return encoded.and_then(base64::decode).ok_or_else(|| Fault::data("gltf: a data URI that is not base64"));
    }
    let name = percent_decoded(uri);
    if uri.contains("://") {
        return Err(Fault::unsupported(format!("a buffer at {uri}"), "fetch it and put it beside the file"));
    }
    let Some(directory) = directory else {
        return Err(Fault::unsupported(format!("a buffer in another file, {name}"), "give a file, or embed the buffer"));
    };
    let path = directory.join(name);
    fs::read(&path).map_err(|source| Fault::Io { path, source })
}

/// A relative URI as a file name: `%20` is a space. A percent sign without two hexadecimal digits stays.
fn percent_decoded(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        let code = tail.get(..2).and_then(|d| std::str::from_utf8(d).ok()).and_then(|d| u8::from_str_radix(d, 16).ok());
        let (byte, after) = match code {
            Some(code) if first == b'%' => (code, &tail[2..]),
            _ => (first, tail),
        };
        bytes.push(byte);
        rest = after;
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
