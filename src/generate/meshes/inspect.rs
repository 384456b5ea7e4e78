//! Mesh files: what they hold, and what they need besides themselves.

use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use crate::directory::limits::MAX_DOCUMENT_BYTES;
use crate::generate::bounded::read_file;
use crate::geometry::read::{NoteCode, Scene, read};

/// What is known of a mesh file.
#[derive(Debug, Clone)]
pub(crate) struct Inspected {
    /// The files that the mesh names (`.mtl`, `.bin`, textures), as far as they are there.
    pub side_files: Vec<PathBuf>,
    /// What it holds, or in words why it is no mesh with a surface.
    pub scene: Result<Arc<Scene>, String>,
    /// Files that it names and that are not there, as it names them.
    pub missing: Vec<String>,
    /// What was repaired or left out in reading it.
    pub remarks: Vec<String>,
}

/// Kinds of files that a mesh may bring along. A mesh is a stranger's file: it must not make us
/// carry whatever else lies on this machine.
const SIDE_FILES: &[&str] = &[
    "mtl", "bin", "png", "jpg", "jpeg", "tga", "bmp", "dds", "gif", "tif", "tiff", "webp", "hdr",
    "exr", "ktx", "ktx2", "ppm", "svg", "psd",
];

/// Looks into a mesh file.
pub(crate) fn inspect(mesh: &Path) -> Inspected {
    let unusable = |why: String| Inspected {
        side_files: Vec::new(),
        scene: Err(why),
        missing: Vec::new(),
        remarks: Vec::new(),
    };
    let bytes = match read_file(mesh, MAX_DOCUMENT_BYTES) {
        Ok(bytes) => bytes,
        Err(why) => return unusable(why),
    };
    let name = mesh.file_name().unwrap_or_default().to_string_lossy();
    let beside = |side: &str| side_file(mesh, side);
    let mut fetch = |side: &str| read_file(&beside(side)?, MAX_DOCUMENT_BYTES).ok();
    let scene = match read(&bytes, &name, &mut fetch) {
        Ok(scene) => scene,
        Err(error) => {
            let told = error.to_string();
            let file = format!("{name}: ");
            // Whoever tells this names the file.
            return unusable(told.strip_prefix(&file).unwrap_or(&told).to_owned());
        }
    };
    let (mut side_files, mut missing) = (Vec::new(), Vec::new());
    for side in &scene.side_files {
        match beside(side).filter(|file| file.is_file()) {
            Some(file) => side_files.push(file),
            None => missing.push(side.clone()),
        }
    }
    let told = |code| {
        use NoteCode::{NoTriangles, SideFileMissing, TurnedToZUp, UnitApplied, UpAxisIgnored};
        // The first is said as why the mesh is unusable, the second of each file. The others are how
        // such files are read; to say so of every mesh helps nobody.
        !matches!(
            code,
            NoTriangles | SideFileMissing | TurnedToZUp | UnitApplied | UpAxisIgnored
        )
    };
    let notes = scene.notes.iter().filter(|note| told(note.code));
    let remarks = notes.map(ToString::to_string).collect();
    let has_area = scene.parts.iter().any(|part| part.mesh.area() > 0.0);
    let scene = match has_area {
        true => Ok(Arc::new(scene)),
        false => Err("it holds no triangle with an area".to_owned()),
    };
    Inspected {
        side_files,
        scene,
        missing,
        remarks,
    }
}

/// Where a file is that a mesh names.
fn side_file(mesh: &Path, side: &str) -> Option<PathBuf> {
    let side = side.replace('\\', "/");
    let name = Path::new(&side);
    let is_relative = name.components().all(|part| {
        matches!(
            part,
            Component::Normal(_) | Component::CurDir | Component::ParentDir
        )
    });
    let extension = name.extension()?.to_str()?.to_ascii_lowercase();
    if !is_relative || !SIDE_FILES.contains(&extension.as_str()) {
        return None;
    }
    let file = mesh.parent()?.join(name);
    file.canonicalize().ok()
}
