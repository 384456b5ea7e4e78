//! Accessors of a glTF file: positions, normals and indices; and the buffers that they read: the GLB chunk, data URIs and
//! files.

use base64::Engine as _;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};

use super::json::{Accessor, Root, SparseArray};
use crate::read::assembly::{Assembly, within};
use crate::read::collada::path_of_url;
use crate::read::scene::{Failure, Fault, NoteCode};
use crate::vector::norm;

const BYTE: u32 = 5120;
const UNSIGNED_BYTE: u32 = 5121;
const SHORT: u32 = 5122;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// Maximum number of elements of an accessor without a buffer view, as sparse accessors may have.
const MAX_ZEROS: usize = 1 << 20;

/// The vertex positions of an accessor; or texture coordinates, with the second number twice.
pub(super) fn positions(
    index: usize,
    width: usize,
    buffers: &mut Buffers<'_, '_>,
    assembly: &mut Assembly,
) -> Result<Vec<[f64; 3]>, Failure> {
    let accessor = get(buffers.root, index)?;
    if accessor.shape != format!("VEC{width}") {
        let shape = &accessor.shape;
        return Err(Fault::malformed(format!("positions are {shape} instead of VEC{width}")));
    }
    let (size, read, largest) = reader(accessor.component_type).ok_or_else(|| {
        Fault::malformed(format!("positions of component type {}", accessor.component_type))
    })?;
    let number = |bytes: &[u8]| match largest.filter(|_| accessor.normalized) {
        Some(largest) => (read(bytes) / largest).max(-1.0),
        None => read(bytes),
    };
    let element = |bytes: &[u8]| [0, 1, width - 1].map(|axis| number(&bytes[axis * size..]));
    let mut positions = match accessor.buffer_view {
        Some(view) => {
            let view = buffers.view(view, assembly)?;
            let all = elements(view, accessor.byte_offset, size * width, accessor.count)?;
            all.map(element).collect()
        }
        None => {
            within("elements in an accessor without data", accessor.count, MAX_ZEROS)?;
            vec![[0.0; 3]; accessor.count]
        }
    };
    if let Some(sparse) = &accessor.sparse {
        let places = indices_of(&sparse.indices, sparse.count, buffers, assembly)?;
        let view = buffers.view(sparse.values.buffer_view, assembly)?;
        let values = elements(view, sparse.values.byte_offset, size * width, sparse.count)?;
        for (place, value) in places.iter().zip(values) {
            let position = positions.get_mut(*place as usize);
            *position.ok_or_else(|| Fault::malformed("a sparse index is out of range"))? =
                element(value);
        }
    }
    if width == 3 && accessor.component_type == FLOAT && !bounds_are(accessor, &positions) {
        let text =
            format!("`min` and `max` of accessor {index} are not the bounds of its positions");
        assembly.notes.add(NoteCode::WrongBounds, text);
    }
    Ok(positions)
}

/// Whether an accessor's `min` and `max` match its positions in binary32.
fn bounds_are(accessor: &Accessor, positions: &[[f64; 3]]) -> bool {
    type Pick = fn(f64, f64) -> f64;
    let sides: [(&Vec<f64>, Pick); 2] = [(&accessor.min, f64::min), (&accessor.max, f64::max)];
    sides.into_iter().all(|(given, pick)| {
        let is = |(axis, given): (usize, &f64)| {
            let found = positions.iter().map(|position| position[axis]).reduce(pick);
            found.is_none_or(|found| found as f32 == *given as f32)
        };
        given.is_empty() || (given.len() == 3 && given.iter().enumerate().all(is))
    })
}

/// Checks an accessor's normals: finite, of unit length, one per position.
pub(super) fn check_normals(
    index: usize,
    count: usize,
    buffers: &mut Buffers<'_, '_>,
    assembly: &mut Assembly,
) -> Result<(), Failure> {
    let accessor = get(buffers.root, index)?;
    let plain = accessor.component_type == FLOAT && accessor.shape == "VEC3";
    let (Some(view), true, None) = (accessor.buffer_view, plain, &accessor.sparse) else {
        // Quantized or sparse normals are not checked: meshes of robots do not have them.
        return Ok(());
    };
    let view = buffers.view(view, assembly)?;
    let wrong = elements(view, accessor.byte_offset, 12, accessor.count)?
        .map(|bytes| [0, 4, 8].map(|at| float(&bytes[at..])))
        .filter(|normal| !(norm(*normal) - 1.0).abs().le(&UNIT_NORMAL))
        .count();
    let text = "a normal is not of unit length";
    assembly.notes.add_many(NoteCode::WrongNormals, text, wrong);
    if accessor.count != count {
        let text = format!("{} normals for {count} positions", accessor.count);
        assembly.notes.add(NoteCode::WrongNormals, text);
    }
    Ok(())
}

/// Tolerance for the length of a normal, which must be 1.
const UNIT_NORMAL: f64 = 1e-3;

pub(super) fn indices(
    index: usize,
    buffers: &mut Buffers<'_, '_>,
    assembly: &mut Assembly,
) -> Result<Vec<u32>, Failure> {
    let accessor = get(buffers.root, index)?;
    if accessor.shape != "SCALAR" || accessor.sparse.is_some() {
        return Err(Fault::malformed("indices are not a plain list of numbers"));
    }
    let Some(buffer_view) = accessor.buffer_view else {
        return Err(Fault::malformed("indices without data"));
    };
    let &Accessor { byte_offset, component_type, count, .. } = accessor;
    let array = SparseArray { buffer_view, byte_offset, component_type };
    indices_of(&array, count, buffers, assembly)
}

fn indices_of(
    array: &SparseArray,
    count: usize,
    buffers: &mut Buffers<'_, '_>,
    assembly: &mut Assembly,
) -> Result<Vec<u32>, Failure> {
    let (size, read): (usize, fn(&[u8]) -> u32) = match array.component_type {
        UNSIGNED_BYTE => (1, |bytes| u32::from(bytes[0])),
        UNSIGNED_SHORT => (2, |bytes| u32::from(u16::from_le_bytes([bytes[0], bytes[1]]))),
        UNSIGNED_INT => (4, |bytes| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])),
        other => return Err(Fault::malformed(format!("indices of component type {other}"))),
    };
    let view = buffers.view(array.buffer_view, assembly)?;
    Ok(elements(view, array.byte_offset, size, count)?.map(read).collect())
}

fn get(root: &Root, index: usize) -> Result<&Accessor, Failure> {
    root.accessors.get(index).ok_or_else(|| Fault::malformed("it does not exist"))
}

/// `count` elements of `size` bytes of a buffer view, which has bytes and a stride. Fails unless all are inside it.
fn elements(
    (bytes, stride): (&[u8], Option<usize>),
    offset: usize,
    size: usize,
    count: usize,
) -> Result<impl Iterator<Item = &[u8]>, Failure> {
    let stride = stride.unwrap_or(size);
    if stride < size {
        let text = format!("elements of {size} bytes have a stride of {stride} bytes");
        return Err(Fault::malformed(text));
    }
    let length = match count {
        0 => Some(0),
        _ => stride.checked_mul(count - 1).and_then(|length| length.checked_add(size)),
    };
    let end = length.and_then(|length| length.checked_add(offset));
    let bytes = end.and_then(|end| bytes.get(offset..end));
    let bytes = bytes.ok_or_else(|| {
        Fault::Truncated(format!("{count} elements do not fit into the buffer view"))
    })?;
    // The last chunk may lack the padding between elements, but contains a whole element.
    Ok(bytes.chunks(stride))
}

fn float(bytes: &[u8]) -> f64 {
    f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
}

type Reader = (usize, fn(&[u8]) -> f64, Option<f64>);

/// The bytes of a component, the function that reads it, and the largest integer. `KHR_mesh_quantization` allows integer positions.
/// Normalized integers are fractions of the largest, as the glTF specification defines.
fn reader(component: u32) -> Option<Reader> {
    Some(match component {
        FLOAT => (4, float, None),
        BYTE => (1, |bytes| f64::from(i8::from_le_bytes([bytes[0]])), Some(127.0)),
        UNSIGNED_BYTE => (1, |bytes| f64::from(bytes[0]), Some(255.0)),
        SHORT => (2, |bytes| f64::from(i16::from_le_bytes([bytes[0], bytes[1]])), Some(32767.0)),
        UNSIGNED_SHORT => {
            (2, |bytes| f64::from(u16::from_le_bytes([bytes[0], bytes[1]])), Some(65535.0))
        }
        _ => return None,
    })
}

/// Returns the bytes of a side file.
pub(super) type Fetch<'f> = &'f mut dyn FnMut(&str) -> Option<Vec<u8>>;

/// Buffers, loaded on first use.
pub(super) struct Buffers<'r, 'f> {
    pub(super) root: &'r Root,
    data: Option<&'r [u8]>,
    fetch: Fetch<'f>,
    loaded: Vec<Option<Vec<u8>>>,
}

/// Some writers omit the padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

impl<'r, 'f> Buffers<'r, 'f> {
    pub(super) fn new(root: &'r Root, data: Option<&'r [u8]>, fetch: Fetch<'f>) -> Self {
        Self { root, data, fetch, loaded: root.buffers.iter().map(|_| None).collect() }
    }

    /// The bytes of a buffer view, and its stride.
    pub(super) fn view(
        &mut self,
        view: usize,
        assembly: &mut Assembly,
    ) -> Result<(&[u8], Option<usize>), Failure> {
        let missing = || Fault::malformed(format!("buffer view {view} does not exist"));
        let found = self.root.buffer_views.get(view).ok_or_else(missing)?;
        let bytes = self.buffer(found.buffer, assembly)?;
        let end = found.byte_offset.checked_add(found.byte_length);
        let slice = end.and_then(|end| bytes.get(found.byte_offset..end));
        let slice = slice.ok_or_else(|| {
            Fault::Truncated(format!("buffer view {view} extends beyond its buffer"))
        })?;
        Ok((slice, found.byte_stride.filter(|stride| *stride > 0)))
    }

    fn buffer(&mut self, index: usize, assembly: &mut Assembly) -> Result<&[u8], Failure> {
        let missing = || Fault::malformed(format!("buffer {index} does not exist"));
        let buffer = self.root.buffers.get(index).ok_or_else(missing)?;
        let whole = |bytes: &[u8]| match bytes.len() < buffer.byte_length {
            true => Err(Fault::Truncated(format!(
                "buffer {index} has {} bytes, but states {}",
                bytes.len(),
                buffer.byte_length
            ))),
            false => Ok(()),
        };
        let Some(uri) = &buffer.uri else {
            // Only the first buffer may be the GLB chunk.
            let data = self.data.filter(|_| index == 0);
            let data = data.ok_or_else(|| {
                Fault::malformed(format!("buffer {index} has neither a file nor data"))
            })?;
            whole(data)?;
            return Ok(data);
        };
        let slot = &mut self.loaded[index];
        if slot.is_none() {
            let bytes = if is_data(uri) {
                let invalid =
                    || Fault::malformed(format!("the data URI of buffer {index} is broken"));
                decode(uri).ok_or_else(invalid)?
            } else {
                let path = path_of_url(uri);
                assembly.add_side_file(&path);
                let found = (self.fetch)(&path)
                    .or_else(|| if path == *uri { None } else { (self.fetch)(uri) });
                found.ok_or(Fault::NoSideFile(path))?
            };
            whole(&bytes)?;
            *slot = Some(bytes);
        }
        Ok(slot.as_deref().unwrap_or_default())
    }
}

pub(super) fn is_data(uri: &str) -> bool {
    uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

pub(super) fn decode(uri: &str) -> Option<Vec<u8>> {
    let (head, data) = uri.split_once(',')?;
    let data: Vec<u8> = percent_encoding::percent_decode_str(data).collect();
    match head.ends_with(";base64") {
        true => BASE64.decode(data.trim_ascii()).ok(),
        false => Some(data),
    }
}
