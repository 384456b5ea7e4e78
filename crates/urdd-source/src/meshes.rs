//! A URDF with its mesh files, without anything generated: for programs that compare or show URDFs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::account::AccountError;
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::{Geometry, UrdfModule};
use urdd_geometry::read::Scene;
use urdd_xml::Xml;

use crate::beside::Beside;
use crate::error::SourceError;
use crate::gate::Gate;
use crate::load::{Source, load, load_xml};
use crate::loops::Said;
use crate::note::SourcePlace;
use crate::packages::NearPackage;
use crate::resolve::{FoundMesh, NotFound, OtherCase};
use crate::settings::Settings;

/// A URDF and the mesh files that it names.
#[derive(Debug)]
pub struct SourceMeshes {
    /// The content of its `urdf_module`.
    pub robot: UrdfModule,
    /// Its mesh references: links in order, visual before collision, elements in order.
    pub meshes: Vec<SourceMesh>,
    /// The text that a URDD carries: the file's, or what xacro made of it, repaired.
    pub text: String,
    /// What is said of the robot's loops.
    pub loops: Option<Said>,
    gate: Gate,
    found: BTreeMap<PathBuf, FoundMesh>,
    /// What an import writes beside its URDF.
    imported: Option<Beside>,
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
    /// The package of a near name that is there instead.
    pub near_package: Option<Box<NearPackage>>,
    /// Why nobody looked to the end: then the rest is not known.
    pub stopped: Option<AccountError>,
}

impl MissingMesh {
    fn cost(&self) -> usize {
        size_of::<MissingMesh>() + self.reason.len()
    }

    /// Whether a package of a near name has the file.
    pub fn is_in_near_package(&self) -> bool {
        self.near_package.as_ref().is_some_and(|near| near.has_file)
    }
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
            near_package: why.near_package,
            stopped: why.stopped,
        }
    }
}

impl SourceMeshes {
    /// Opens a URDF, or what xacro makes of a file, and finds its mesh files.
    ///
    /// # Errors
    /// If it cannot be read or is not a valid robot. A missing mesh is not an error.
    pub fn open(path: &Path, settings: &Settings) -> Result<SourceMeshes, SourceError> {
        SourceMeshes::of(load(path, settings)?, settings, None)
    }

    /// Finds the mesh files of a URDF. A missing mesh is not an error. `imported` is what its import writes beside it, if it has one.
    ///
    /// # Errors
    /// If it takes more to find them than the account of the run has.
    pub fn of(
        source: Source,
        settings: &Settings,
        imported: Option<Beside>,
    ) -> Result<SourceMeshes, SourceError> {
        let gate = Gate::new(&source.folder, settings);
        let found = mesh_files(&source, &gate)?;
        let found = found.into_iter().map(|(name, of)| (name, of.map_err(MissingMesh::from)));
        let found: BTreeMap<&str, Result<FoundMesh, MissingMesh>> = found.collect();
        let mut meshes = Vec::new();
        for (mesh, place) in named(&source.reading.robot).into_iter().zip(&source.mesh_places) {
            let found = &found[mesh.filename];
            // One file may have very many names, and each element has its path.
            let path = |found: &FoundMesh| found.file.as_os_str().len();
            let cost = found.as_ref().map_or_else(MissingMesh::cost, path);
            gate.account().charge(cost).map_err(|why| unfinished(why, place))?;
            meshes.push(SourceMesh {
                link: mesh.link,
                geometry: mesh.geometry,
                element: mesh.element,
                filename: mesh.filename.to_owned(),
                file: found.as_ref().map(|found| found.file.clone()).map_err(Clone::clone),
            });
        }
        let found = found.into_values().flatten();
        let found = found.map(|found| (found.file.clone(), found)).collect();
        Ok(SourceMeshes {
            text: String::from_utf8_lossy(&source.carried).into_owned(),
            robot: source.reading.robot,
            loops: source.loops,
            meshes,
            gate,
            found,
            imported,
        })
    }

    /// What stands beside the description at the path that it was opened at, or what its import writes there.
    pub fn beside(&self, path: &Path) -> Beside {
        self.imported.clone().unwrap_or_else(|| Beside::read(path, &self.gate))
    }

    /// As [`SourceMeshes::open`], of a text that others read too. Relative names refer to `folder`; `shown` names it in errors.
    ///
    /// # Errors
    /// If it is not a valid robot.
    pub fn of_xml(
        xml: &Xml<'_>,
        shown: &str,
        folder: &Path,
        settings: &Settings,
    ) -> Result<SourceMeshes, SourceError> {
        // An editor's file may be in a folder that is not there yet, or not any more: then its meshes are missing.
        let folder = settings.files.canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        let source = load_xml(xml, shown, folder)?;
        SourceMeshes::of(source, settings, None)
    }

    /// Reads a file of [`SourceMeshes::meshes`].
    ///
    /// # Errors
    /// The reason why it has no usable surface.
    pub fn read(&self, file: &Path) -> Result<Arc<Scene>, String> {
        self.gate.mesh(self.found.get(file).ok_or("the URDF does not name it")?).scene
    }

    /// Finds another file that the URDF names, such as a texture, as meshes are found.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn find(&self, filename: &str) -> Result<PathBuf, MissingMesh> {
        Ok(self.gate.find(filename)?.file)
    }
}

/// The mesh files of a URDF by their names, or why there is none.
///
/// # Errors
/// If it takes more to find them than the account of the run has.
pub fn mesh_files<'s>(
    source: &'s Source,
    gate: &Gate,
) -> Result<BTreeMap<&'s str, Result<FoundMesh, NotFound>>, SourceError> {
    gate.account().deposit(source.carried.len());
    let mut files: BTreeMap<&str, Result<FoundMesh, NotFound>> = BTreeMap::new();
    for (mesh, place) in named(&source.reading.robot).into_iter().zip(&source.mesh_places) {
        let found = files.entry(mesh.filename).or_insert_with(|| gate.find(mesh.filename));
        let stopped = found.as_ref().err().and_then(|missing| missing.stopped);
        stopped.map_or(Ok(()), |why| Err(unfinished(why, place)))?;
    }
    Ok(files)
}

fn unfinished(why: AccountError, place: &SourcePlace) -> SourceError {
    match why {
        AccountError::Cancelled(why) => why.into(),
        AccountError::Overdrawn(_) => SourceError::Import {
            file: place.file.clone(),
            line: place.line,
            column: place.column,
            fault: format!("the mesh files of the robot cannot all be looked for: {why}"),
        },
    }
}

/// A mesh reference in the URDF.
pub struct NamedMesh<'a> {
    /// Index of the link.
    pub link: usize,
    /// Whether a visual or a collision element names it.
    pub geometry: GeometryKind,
    /// Index of the element among the link's elements of that kind.
    pub element: usize,
    /// The name as the URDF has it.
    pub filename: &'a str,
}

/// The mesh references of a robot: links in order, visual before collision, elements in order.
pub fn named(robot: &UrdfModule) -> Vec<NamedMesh<'_>> {
    let mut named = Vec::new();
    for (link, of) in robot.links.iter().enumerate() {
        let visual = of.visual.iter().map(|visual| visual.geometry.as_ref());
        let collision = of.collision.iter().map(|collision| collision.geometry.as_ref());
        let visual = visual.enumerate().map(|found| (GeometryKind::Visual, found));
        let collision = collision.enumerate().map(|found| (GeometryKind::Collision, found));
        for (geometry, (element, found)) in visual.chain(collision) {
            if let Some(Geometry::Mesh(mesh)) = found {
                named.push(NamedMesh { link, geometry, element, filename: &mesh.filename });
            }
        }
    }
    named
}
