//! Inspects mesh files: their content, which matches their use or is not stored, and the files that they reference.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use memchr::memchr_iter;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_geometry::read::{Format, NoteCode, Scene, read};

use crate::roots::{Place, Roots};

/// A mesh file after inspection. A file is opened only once: the inspected bytes are those that are stored.
#[derive(Debug, Clone)]
pub struct Inspected {
    /// The file's bytes; `None` if it cannot be read or is not a mesh, and is thus not stored.
    pub bytes: Option<Arc<Vec<u8>>>,
    /// The stored files that the mesh references (`.mtl`, `.bin`, textures).
    pub side_files: BTreeMap<PathBuf, SideFile>,
    /// Its content, or the reason why it has no usable surface.
    pub scene: Result<Arc<Scene>, String>,
    /// Referenced files that are not stored, as written in the mesh, and why.
    pub left_out: Vec<(String, String)>,
    /// What was repaired or ignored while reading.
    pub remarks: Vec<String>,
}

/// A file that a mesh references.
#[derive(Debug, Clone)]
pub struct SideFile {
    /// Its bytes.
    pub bytes: Arc<Vec<u8>>,
    /// The allowed folder that contains it.
    pub place: Place,
}

/// File extensions of meshes; not all are read.
const MESHES: &[&str] = &["stl", "dae", "obj", "gltf", "glb", "ply", "msh"];

/// File extensions that a mesh may reference; the images are last.
const SIDE_FILES: &[&str] = &[
    "mtl", "bin", "png", "jpg", "jpeg", "tga", "bmp", "dds", "gif", "tif", "tiff", "webp", "hdr",
    "exr", "ktx2", "ppm", "pgm",
];

/// Notes that are not remarks. `NoTriangles` is the reason why the mesh is unusable, `SideFileMissing` is reported for each
/// file, and the others are normal for such files.
const NOT_SAID: &[NoteCode] = &[
    NoteCode::NoTriangles,
    NoteCode::NodeTransform,
    NoteCode::ReadOtherwise,
    NoteCode::SideFileMissing,
    NoteCode::TurnedToZUp,
    NoteCode::UnitApplied,
    NoteCode::UnusedVertices,
    NoteCode::UpAxisIgnored,
    NoteCode::WrongBounds,
    NoteCode::WrongNormals,
];

/// Inspects a mesh file, and the files that it references.
pub(crate) fn inspect(mesh: &Path, place: &Place, roots: &Roots) -> Inspected {
    let bytes = match roots.files().read(mesh, MAX_DOCUMENT_BYTES) {
        Ok(bytes) => bytes,
        Err(why) => return Inspected::unusable(None, why.to_string()),
    };
    let name = mesh.file_name().unwrap_or_default().to_string_lossy();
    let beside = Beside { mesh, place, roots, read: RefCell::default() };
    let fetch = |side: &str| {
        let (_, file) = beside.read(side).ok()?;
        Some(file.bytes.as_ref().clone())
    };
    inspect_bytes(bytes, &name, fetch, |side, format| beside.carried(side, format))
}

/// Inspects the bytes of a mesh of which the files that it references are not wanted.
pub fn inspect_alone(bytes: Vec<u8>, name: &str) -> Inspected {
    inspect_bytes(bytes, name, |_| None, |_, _| Err("which is not read".to_owned()))
}

fn inspect_bytes(
    bytes: Vec<u8>,
    name: &str,
    mut fetch: impl FnMut(&str) -> Option<Vec<u8>>,
    carried: impl Fn(&str, Format) -> Found,
) -> Inspected {
    let scene = match read(&bytes, name, &mut fetch) {
        Ok(scene) => scene,
        Err(error) => {
            let words = error.to_string();
            let file = format!("{name}: ");
            // The caller's message names the file.
            let words = words.strip_prefix(&file).unwrap_or(&words).to_owned();
            let is_mesh = is_mesh(&bytes, None);
            return Inspected::unusable(is_mesh.then_some(bytes), words);
        }
    };
    if !is_mesh(&bytes, Some(&scene)) {
        return Inspected::unusable(None, "it holds no mesh".to_owned());
    }
    let (mut side_files, mut left_out) = (BTreeMap::new(), Vec::new());
    for side in &scene.side_files {
        match carried(side, scene.format) {
            Ok((path, file)) => {
                side_files.insert(path, file);
            }
            Err(why) => left_out.push((side.clone(), why)),
        }
    }
    let notes = scene.notes.iter().filter(|note| !NOT_SAID.contains(&note.code));
    let remarks = notes.map(ToString::to_string).collect();
    let has_area = scene.parts.iter().any(|part| part.mesh.area() > 0.0);
    let scene = match has_area {
        true => Ok(Arc::new(scene)),
        false => Err("it holds no triangle with an area".to_owned()),
    };
    Inspected { bytes: Some(Arc::new(bytes)), side_files, scene, left_out, remarks }
}

impl Inspected {
    fn unusable(bytes: Option<Vec<u8>>, why: String) -> Self {
        Inspected {
            bytes: bytes.map(Arc::new),
            side_files: BTreeMap::new(),
            scene: Err(why),
            left_out: Vec::new(),
            remarks: Vec::new(),
        }
    }
}

type Found = Result<(PathBuf, SideFile), String>;

/// The files that a mesh references, each read once.
struct Beside<'a> {
    mesh: &'a Path,
    place: &'a Place,
    roots: &'a Roots,
    read: RefCell<BTreeMap<String, Found>>,
}

impl Beside<'_> {
    /// A referenced file whose content fits the mesh format.
    fn carried(&self, side: &str, mesh: Format) -> Found {
        let (path, file) = self.read(side)?;
        let extension = extension(&path).unwrap_or_default();
        match fault_of_side_file(&extension, &file.bytes, mesh) {
            None => Ok((path, file)),
            Some(fault) => Err(fault.to_owned()),
        }
    }

    /// A referenced file with any content.
    fn read(&self, side: &str) -> Found {
        if let Some(found) = self.read.borrow().get(side) {
            return found.clone();
        }
        let found = self.look(side);
        self.read.borrow_mut().insert(side.to_owned(), found.clone());
        found
    }

    fn look(&self, side: &str) -> Found {
        let missing = || "which does not exist".to_owned();
        let name = side.replace('\\', "/");
        let name = Path::new(&name);
        let is_relative = name.components().all(|part| {
            matches!(part, Component::Normal(_) | Component::CurDir | Component::ParentDir)
        });
        if !is_relative {
            return Err("whose path is not relative to the mesh's own folder".to_owned());
        }
        let folder = self.mesh.parent().ok_or_else(missing)?;
        let file = self.roots.files().canonicalize(&folder.join(name)).map_err(|_| missing())?;
        // Check the target of symbolic links: a harmless link name may lead to any file.
        let extension = extension(&file).unwrap_or_default();
        if !self.roots.files().is_file(&file) || !SIDE_FILES.contains(&extension.as_str()) {
            return Err("which is not a kind of file that meshes use".to_owned());
        }
        let package = match self.place {
            Place::Package(name, folder) => Some((name.as_str(), folder.as_path())),
            Place::Own | Place::Allowed => None,
        };
        let Some(place) = self.roots.place(&file, package) else {
            return Err(format!(
                "which is outside of the robot's folders ({}; `--allow-folder` allows it)",
                file.display()
            ));
        };
        let bytes = self.roots.files().read(&file, MAX_DOCUMENT_BYTES);
        let bytes = bytes.map_err(|why| format!("which cannot be read: {why}"))?;
        let bytes = Arc::new(bytes);
        Ok((file, SideFile { bytes, place }))
    }
}

/// Whether a file has the name of a mesh, or of what meshes reference.
pub(crate) fn is_of_mesh(file: &Path) -> bool {
    let extension = extension(file).unwrap_or_default();
    [MESHES, SIDE_FILES].into_iter().flatten().any(|known| *known == extension)
}

fn extension(file: &Path) -> Option<String> {
    Some(file.extension()?.to_str()?.to_ascii_lowercase())
}

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
