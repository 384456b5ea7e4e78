//! Checks that a file's content matches its use; other files are not stored.

use memchr::memchr_iter;
use urdd_geometry::read::{Format, Scene};

/// How many bytes at the start of a file are searched for format markers.
const HEAD: usize = 64 << 10;

/// Whether a file is a mesh; `scene` is the result of reading it.
pub(crate) fn is_mesh(bytes: &[u8], scene: Option<&Scene>) -> bool {
    match scene {
        Some(scene) if scene.triangle_count() > 0 => true,
        // STL and COLLADA are recognised by markers that arbitrary text does not have.
        Some(scene) if !matches!(scene.format, Format::Obj | Format::Gltf) => true,
        _ => is_marked(bytes),
    }
}

/// The statements of OBJ.
const STATEMENTS: &[&[u8]] =
    &[b"v", b"vt", b"vn", b"vp", b"f", b"l", b"p", b"o", b"g", b"s", b"mg", b"usemtl", b"mtllib"];

/// Bytes of a line in which the white space behind a statement is.
const LONGEST: usize = 8;

/// Whether all of a file is a mesh of the format that its name says, before its numbers are read: binary STL of the length
/// that it states, or statements of OBJ with vertices. Of other meshes the content has to be read.
pub fn is_plain_mesh(extension: &str, bytes: &[u8]) -> bool {
    if extension == "stl" {
        let count = bytes.get(80..84).and_then(|count| count.try_into().ok());
        let count = u64::from(count.map_or(0, u32::from_le_bytes));
        return count > 0 && 84 + 50 * count == bytes.len() as u64;
    }
    let mut has_vertices = false;
    let mut is_statement = |line: &[u8]| {
        let line = line.trim_ascii_start();
        let end = line.iter().take(LONGEST).position(u8::is_ascii_whitespace);
        let word = &line[..end.unwrap_or(line.len())];
        has_vertices |= word == b"v";
        word.is_empty() || word.starts_with(b"#") || STATEMENTS.contains(&word)
    };
    extension == "obj" && lines(bytes).all(&mut is_statement) && has_vertices
}

/// The lines of a file, without the bytes that end them.
pub fn lines(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut start = 0;
    memchr_iter(b'\n', bytes).chain([bytes.len()]).map(move |end| {
        let line = &bytes[start..end];
        start = end + 1;
        line
    })
}

/// Whether a file starts like a mesh, even if it cannot be read.
fn is_marked(bytes: &[u8]) -> bool {
    const MAGIC: &[&[u8]] =
        &[b"glTF", b"ply\n", b"ply\r", b"Kaydara FBX", b"BLENDER", b"OFF\n", b"OFF\r"];
    if MAGIC.iter().any(|magic| bytes.starts_with(magic)) {
        return true;
    }
    let head = &bytes[..bytes.len().min(HEAD)];
    let text = String::from_utf8_lossy(head);
    let text = text.trim_start_matches('\u{feff}').trim_start();
    match text.chars().next() {
        Some('<') => text.contains("<COLLADA"),
        Some('{') => text.contains("\"asset\"") && text.contains("\"version\""),
        Some('s') if text.starts_with("solid") => text.contains("facet"),
        _ => text.lines().any(is_obj_vertex),
    }
}

/// A line of `v` and three numbers.
fn is_obj_vertex(line: &str) -> bool {
    let mut words = line.split_ascii_whitespace();
    let numbers = |words: std::str::SplitAsciiWhitespace| {
        words.take(3).filter(|word| word.parse::<f64>().is_ok()).count()
    };
    words.next() == Some("v") && numbers(words) == 3
}

/// Why a mesh of this format cannot reference such a file; `None` if it can.
pub(super) fn fault_of_side_file(
    extension: &str,
    bytes: &[u8],
    mesh: Format,
) -> Option<&'static str> {
    match extension {
        "mtl" if mesh == Format::Obj => {
            (!is_mtl(bytes)).then_some("which is not a material library (.mtl)")
        }
        // Binary numbers: any bytes are valid.
        "bin" if matches!(mesh, Format::Gltf | Format::Glb) => None,
        "mtl" | "bin" => Some("which is not a file that meshes of this format use"),
        _ => (!is_image(bytes)).then_some("which is not an image of a supported format"),
    }
}

/// Whether a file is an image, by its header and pixel size.
pub fn is_image(bytes: &[u8]) -> bool {
    imagesize::blob_size(bytes).is_ok_and(|size| size.width > 0 && size.height > 0)
}

/// Whether a file is a material library: text that declares a material or has only comments.
pub(crate) fn is_mtl(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else {
        // Material names may be in a legacy encoding.
        return !bytes.contains(&0) && declares_material(&String::from_utf8_lossy(bytes));
    };
    let is_comment = |line: &str| line.trim().is_empty() || line.trim().starts_with('#');
    declares_material(text) || text.lines().all(is_comment)
}

fn declares_material(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim_start);
    lines.any(|line| {
        let mut words = line.split_ascii_whitespace();
        words.next().is_some_and(|word| word.eq_ignore_ascii_case("newmtl"))
    })
}
