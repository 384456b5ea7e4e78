//! The buffers of a glTF file: the GLB chunk, data URIs and files.

use base64::Engine as _;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};

use super::super::assembly::Assembly;
use super::super::collada::path_of_url;
use super::super::error::{Failure, Fault};
use super::json::Root;

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
        let Some(uri) = &buffer.uri else {
            // Only the first buffer may be the GLB chunk.
            let data = self.data.filter(|_| index == 0);
            return data.ok_or_else(|| {
                Fault::malformed(format!("buffer {index} has neither a file nor data"))
            });
        };
        let slot = &mut self.loaded[index];
        if slot.is_none() {
            let bytes = if is_data(uri) {
                let invalid = || Fault::malformed(format!("buffer {index} is not valid base64"));
                decode(uri).ok_or_else(invalid)?
            } else {
                let path = path_of_url(uri);
                assembly.add_side_file(&path);
                let found = (self.fetch)(&path)
                    .or_else(|| if path == *uri { None } else { (self.fetch)(uri) });
                found.ok_or(Fault::NoSideFile(path))?
            };
            *slot = Some(bytes);
        }
        Ok(slot.as_deref().unwrap_or_default())
    }
}

/// Whether a URI is a data URI.
pub(super) fn is_data(uri: &str) -> bool {
    uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

pub(super) fn decode(uri: &str) -> Option<Vec<u8>> {
    let (head, data) = uri.split_once(',')?;
    head.ends_with(";base64").then(|| BASE64.decode(data.trim()).ok())?
}
