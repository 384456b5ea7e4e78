//! What a file is by its content that is no XML: the one list of such signs. It is asked where a file cannot be taken.

use std::fmt;

/// What a file is that was taken for another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Foreign {
    /// What it is: `a zip archive`.
    pub what: &'static str,
    /// What to do.
    pub advice: &'static str,
}

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "this is {}: {}", self.what, self.advice)
    }
}

/// How a pointer of Git LFS begins.
pub const LFS_POINTER: &[u8] = b"version https://git-lfs";

const FETCH: &str = "`git lfs pull` fetches the file that it stands for";
const UNPACK: &str = "unpack it, and give what is in it";
const PACKED: &str = "unpack it; if it is a packed URDD, `urdd validate`, `view`, `diff` and `export` take it as it is";
const MESH: &str = "a mesh belongs into a description of a robot, as `<mesh filename=\"...\"/>`";
const CONVERT: &str = "convert it to STL, COLLADA, OBJ, glTF or GLB";
const OTHER: &str = "give the file that is meant";

/// How files begin, whatever is in them.
const SIGNATURES: [(&[u8], &str, &str); 21] = [
    (LFS_POINTER, "a Git LFS pointer", FETCH),
    (b"PK\x03\x04", "a zip archive", PACKED),
    (b"PK\x05\x06", "a zip archive", PACKED),
    (b"\x1f\x8b", "a gzip archive", UNPACK),
    (b"BZh", "a bzip2 archive", UNPACK),
    (b"\xfd7zXZ", "an xz archive", UNPACK),
    (b"7z\xbc\xaf", "a 7z archive", UNPACK),
    (b"\x89PNG", "a PNG image", OTHER),
    (b"\xff\xd8\xff", "a JPEG image", OTHER),
    (b"GIF8", "a GIF image", OTHER),
    (b"%PDF-", "a PDF document", OTHER),
    (b"glTF", "a mesh in GLB", MESH),
    (b"Kaydara FBX", "a mesh in FBX", CONVERT),
    (b"BLENDER", "a Blender file", CONVERT),
    (b"ISO-10303-21", "a CAD model in STEP", CONVERT),
    (b"#VRML", "a mesh in VRML", CONVERT),
    (b"ply\n", "a mesh in PLY", CONVERT),
    (b"ply\r", "a mesh in PLY", CONVERT),
    (b"OFF\n", "a mesh in OFF", CONVERT),
    (b"OFF\r", "a mesh in OFF", CONVERT),
    (b"\x7fELF", "a program", OTHER),
];

/// What a file is that begins with a sign of its format.
pub fn signature(bytes: &[u8]) -> Option<Foreign> {
    let (_, what, advice) = SIGNATURES.iter().find(|(sign, ..)| bytes.starts_with(sign))?;
    Some(Foreign { what, advice })
}

/// What a file is that is no XML, as far as its content says.
pub fn foreign(bytes: &[u8]) -> Option<Foreign> {
    if let Some(found) = signature(bytes) {
        return Some(found);
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let begins = |word: &str| {
        text.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word.as_bytes()))
    };
    let (what, advice) = if text.is_empty() {
        ("an empty file", "write or fetch it again")
    } else if is_binary_stl(bytes) || begins("solid") {
        ("a mesh in STL", MESH)
    } else if begins("<!doctype html") || begins("<html") {
        ("a web page", "download the file itself, not the page that shows it")
    } else if begins("{") {
        ("JSON", OTHER)
    } else if ["v ", "vn ", "mtllib "].into_iter().any(begins) {
        ("a mesh in OBJ", MESH)
    } else {
        return None;
    };
    Some(Foreign { what, advice })
}

/// Whether a file is as long as a binary STL of its number of triangles.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    count.is_some_and(|count| 84 + 50 * u64::from(count) == bytes.len() as u64)
}
