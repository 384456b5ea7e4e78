//! A URDF with its mesh files, without anything generated: for programs that compare or show URDFs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::GenerateError;
use super::meshes::inspect::inspect;
use super::meshes::original::named;
use super::meshes::package::Packages;
pub use super::meshes::resolve::OtherCase;
use super::meshes::resolve::{FoundMesh, NotFound, resolve};
use super::meshes::roots::{Place, Roots};
use super::settings::Settings;
use super::source::repair::mend_xml;
use super::source::{self, Source};
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::UrdfModule;
use urdd_geometry::read::Scene;

/// A URDF and the mesh files that it names.
#[derive(Debug)]
pub struct SourceMeshes {
    /// The content of its `urdf_module`.
    pub robot: UrdfModule,
    /// Its mesh references: links in order, visual before collision, elements in order.
    pub meshes: Vec<SourceMesh>,
    /// The text that a URDD carries: the file's, or what xacro made of it, repaired.
    pub text: String,
    folder: PathBuf,
    packages: Packages,
    roots: Roots,
    places: BTreeMap<PathBuf, Place>,
}

/// A mesh reference of a URDF.
#[derive(Debug, Clone)]
pub struct SourceMesh {
    /// Index of the link.
    pub link: usize,
    /// Whether a visual or a collision element names it.
    pub geometry: GeometryKind,
    /// Index of the element among the link's elements of that kind.
    pub element: usize,
    /// The name as the URDF has it.
    pub filename: String,
    /// The file with symbolic links resolved, or why there is none.
    pub file: Result<PathBuf, MissingMesh>,
}

/// Why a mesh reference has no file.
#[derive(Debug, Clone)]
pub struct MissingMesh {
    /// The reason, for people.
    pub reason: String,
    /// A file whose path differs in case alone.
    pub other_case: Option<Box<OtherCase>>,
    /// The file, which is outside of the folders that it may be in.
    pub outside: Option<PathBuf>,
    /// The package, if there is none of this name.
    pub no_package: Option<String>,
}

impl From<NotFound> for MissingMesh {
    fn from(why: NotFound) -> Self {
        MissingMesh {
            reason: match &why.outside {
                Some(path) => format!(
                    "{} is outside of the folders of the robot and its packages; `--allow-folder` allows its folder",
                    path.display()
                ),
                None => why.in_words(),
            },
            other_case: why.other_case,
            outside: why.outside,
            no_package: why.no_package,
        }
    }
}

/// The text of a URDF file as an author sees it.
#[derive(Debug, Clone)]
pub struct SourceText {
    /// The text: of the file, or what xacro made of it. Nothing is repaired.
    pub text: String,
    /// Whether it was expanded.
    pub is_expanded: bool,
    /// The folder that relative names refer to, with symbolic links resolved.
    pub folder: PathBuf,
}

impl SourceMeshes {
    /// Reads a file of [`SourceMeshes::meshes`].
    ///
    /// # Errors
    /// The reason why it has no usable surface.
    pub fn read(&self, file: &Path) -> Result<Arc<Scene>, String> {
        let place = self.places.get(file).ok_or("the URDF does not name it")?;
        inspect(file, place, &self.roots).scene
    }

    /// Finds another file that the URDF names, such as a texture, as meshes are found.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn find(&self, filename: &str) -> Result<PathBuf, MissingMesh> {
        let found = resolve(filename, &self.folder, &self.packages, &self.roots)?;
        Ok(found.file)
    }
}

/// Opens a URDF and finds its mesh files, in the folders where [`generate`](super::generate) finds them.
///
/// # Errors
/// If the URDF cannot be read or is not a valid robot. A missing mesh is not an error.
pub fn open_source(path: &Path, settings: &Settings) -> Result<SourceMeshes, GenerateError> {
    let packages = &settings.packages;
    let source = source::load(path, &settings.xacro, packages, &settings.cancellation)?;
    Ok(with_meshes(source, settings))
}

/// As [`open_source`], from a text. Relative names refer to `folder`; `shown` names it in errors.
///
/// # Errors
/// If it is not a valid robot.
pub fn open_source_text(
    text: &str,
    shown: &str,
    folder: &Path,
    settings: &Settings,
) -> Result<SourceMeshes, GenerateError> {
    // An editor's file may be in a folder that is not there yet, or not any more: then its meshes are missing.
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let source = source::load_text_in(text.as_bytes().to_owned(), shown, folder)?;
    Ok(with_meshes(source, settings))
}

/// A text with what keeps it from being XML mended, and the number of lines that this takes from its beginning. See SPEC
/// 6.1.8.
pub fn well_formed(text: &str) -> (String, u32) {
    let (text, _, lines) = mend_xml(text.to_owned());
    (text, lines)
}

/// Reads the text of a URDF, or expands a xacro file to one.
///
/// # Errors
/// If it cannot be read or expanded.
pub fn read_source(path: &Path, settings: &Settings) -> Result<SourceText, GenerateError> {
    let shown = path.display().to_string();
    let packages = &settings.packages;
    let found = source::find(path, &shown)?;
    let read = source::read(
        path,
        &shown,
        &found.bytes,
        &settings.xacro,
        packages,
        &settings.cancellation,
        &mut Vec::new(),
    )?;
    Ok(SourceText { text: read.text, is_expanded: read.is_expanded, folder: found.folder })
}

fn with_meshes(source: Source, settings: &Settings) -> SourceMeshes {
    let packages = &settings.packages;
    let roots = Roots::new(&source.folder, packages, &settings.allowed_folders);
    let mut found: BTreeMap<&str, Result<FoundMesh, MissingMesh>> = BTreeMap::new();
    let mut meshes = Vec::new();
    for mesh in named(&source.reading.robot) {
        let found = found.entry(mesh.filename).or_insert_with(|| {
            resolve(mesh.filename, &source.folder, packages, &roots).map_err(MissingMesh::from)
        });
        meshes.push(SourceMesh {
            link: mesh.link,
            geometry: mesh.geometry,
            element: mesh.element,
            filename: mesh.filename.to_owned(),
            file: found.as_ref().map(|found| found.file.clone()).map_err(Clone::clone),
        });
    }
    let places = found.into_values().flatten();
    let places = places.map(|found| (found.file, found.place)).collect();
    SourceMeshes {
        text: String::from_utf8_lossy(&source.carried).into_owned(),
        robot: source.reading.robot,
        meshes,
        folder: source.folder,
        packages: packages.clone(),
        roots,
        places,
    }
}
