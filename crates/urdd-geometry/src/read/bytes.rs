//! Raw bytes: the mesh format, from the content, or from the extension if the content is ambiguous; and the words and
//! numbers of a text.

use urdd_xml::foreign::{LFS_POINTER, signature};

use super::scene::{Fault, Format};

/// Number of leading bytes searched for format markers. Long comments may precede the root element of XML.
const HEAD: usize = 64 * 1024;
const STL_HEADER: usize = 84;

/// The format of the bytes, or why they are not readable.
pub(super) fn format_of(bytes: &[u8], name: &str) -> Result<Format, Fault> {
    if bytes.is_empty() {
        return Err(Fault::Empty);
    }
    if bytes.starts_with(b"glTF") {
        return Ok(Format::Glb);
    }
    // Check before the text formats: a binary header may begin with "solid", or with anything else.
    if is_whole_binary_stl(bytes) {
        return Ok(Format::StlBinary);
    }
    if let Some(other) = signature(bytes) {
        return Err(Fault::NotSupported(match bytes.starts_with(LFS_POINTER) {
            true => other.to_string(),
            false => format!("this is {}, which is not supported", other.what),
        }));
    }
    let head = &bytes[..bytes.len().min(HEAD)];
    let is_text = looks_like_text(head);
    let text = skip_byte_order_mark(head).trim_ascii_start();
    let extension = extension_format(name);
    if is_utf16(bytes) || (is_text && text.starts_with(b"<")) {
        if is_utf16(bytes) || find(head, b"COLLADA") {
            return Ok(Format::Collada);
        }
        return Err(Fault::NotSupported("this is XML, but not COLLADA".to_owned()));
    }
    if is_text && text.starts_with(b"{") {
        return Ok(Format::Gltf);
    }
    if starts_with_word(text, b"solid")
        && (is_text || extension != Some(Format::StlBinary))
        && (find(head, b"facet") || find(head, b"endsolid"))
    {
        return Ok(Format::StlAscii);
    }
    if is_text && is_obj(text) {
        return Ok(Format::Obj);
    }
    match extension {
        Some(Format::StlBinary) if bytes.len() >= STL_HEADER => Ok(Format::StlBinary),
        Some(Format::StlBinary) => Err(Fault::Truncated(format!(
            "an STL has a header of {STL_HEADER} bytes, but this file has {}",
            bytes.len()
        ))),
        Some(Format::Obj) if is_text => Ok(Format::Obj),
        _ => Err(Fault::UnknownFormat),
    }
}

/// The format of the file extension, ignoring case; binary STL for `.stl`.
pub(super) fn extension_format(name: &str) -> Option<Format> {
    let (_, extension) = name.rsplit_once('.')?;
    match extension.to_ascii_lowercase().as_str() {
        "stl" | "stla" | "stlb" => Some(Format::StlBinary),
        "dae" => Some(Format::Collada),
        "obj" => Some(Format::Obj),
        "gltf" => Some(Format::Gltf),
        "glb" => Some(Format::Glb),
        _ => None,
    }
}

/// Whether the size matches the triangle count in the header of a binary STL exactly.
fn is_whole_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..STL_HEADER).and_then(|count| count.try_into().ok());
    let length = |count| STL_HEADER as u64 + 50 * u64::from(u32::from_le_bytes(count));
    count.is_some_and(|count| bytes.len() as u64 == length(count))
}

/// Whether there are no control characters other than white space. None of the binary formats passes.
fn looks_like_text(head: &[u8]) -> bool {
    head.iter()
        .all(|byte| *byte >= 0x20 || byte.is_ascii_whitespace() || *byte == 0x0b || *byte == 0x1a)
}

pub(super) fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xfe<\0") || bytes.starts_with(b"\xfe\xff\0<")
}

pub(super) fn skip_byte_order_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

fn starts_with_word(text: &[u8], word: &[u8]) -> bool {
    text.len() >= word.len() && text[..word.len()].eq_ignore_ascii_case(word)
}

fn find(head: &[u8], mark: &[u8]) -> bool {
    head.windows(mark.len()).any(|window| window.eq_ignore_ascii_case(mark))
}

/// Whether the first line that is neither empty nor a comment starts with an OBJ keyword.
fn is_obj(text: &[u8]) -> bool {
    const KEYWORDS: [&[u8]; 10] =
        [b"v", b"vt", b"vn", b"f", b"o", b"g", b"s", b"mtllib", b"usemtl", b"vp"];
    text.split(|byte| *byte == b'\n')
        .map(<[u8]>::trim_ascii)
        .find(|line| !line.is_empty() && !line.starts_with(b"#"))
        .and_then(|line| line.split(u8::is_ascii_whitespace).next())
        .is_some_and(|word| KEYWORDS.contains(&word))
}

/// The words of a text, separated by white space.
#[derive(Clone)]
pub(super) struct Words<'a> {
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text }
    }

    /// The next number, rounded to nearest; NaN for a word that is not a number.
    pub(super) fn float(&mut self) -> Option<f64> {
        self.next().map(float)
    }

    /// Skips to the end of the line, unless the last word ended it.
    pub(super) fn skip_line(&mut self) {
        let end = self.rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        self.rest = &self.rest[end.unwrap_or(self.rest.len())..];
    }

    /// The next index; `Some(None)` for a word that is not an index.
    pub(super) fn index(&mut self) -> Option<Option<u32>> {
        let word = self.next()?;
        Some(std::str::from_utf8(word).ok().and_then(|word| word.parse().ok()))
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self.rest.iter().position(|byte| *byte > b' ')?;
        let rest = &self.rest[start..];
        let end = rest.iter().position(|byte| *byte <= b' ').unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        Some(word)
    }
}

/// Parses a number; NaN for any other word (`1.#QNAN`, `-nan(ind)`).
#[inline]
pub(super) fn float(word: &[u8]) -> f64 {
    let word = std::str::from_utf8(word).ok();
    word.and_then(|word| word.parse().ok()).unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_nan() {
        for word in ["", ".", "-", "e5", "1e", "1.2.3", "1.#QNAN", "-nan(ind)", "1,5", "0x10"] {
            assert!(float(word.as_bytes()).is_nan(), "{word}");
        }
    }

    #[test]
    fn indices() {
        let mut words = Words::new(b"4294967295 4294967296 00000000000007 -1");
        assert_eq!(words.index(), Some(Some(u32::MAX)));
        assert_eq!(words.index(), Some(None));
        assert_eq!(words.index(), Some(Some(7)));
        assert_eq!(words.index(), Some(None));
        assert_eq!(words.index(), None);
    }
}
