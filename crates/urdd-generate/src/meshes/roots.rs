//! From which folders the files of meshes may be taken.
//!
//! A URDF is a stranger's file, and a URDD is published: what a URDF names must not make us publish
//! whatever else lies on this machine. So files are taken only from the folders that belong to the
//! robot, and from those that the user allows.

use std::path::{Path, PathBuf};

use super::package::{Packages, package_name};

/// Names of folders that URDFs lie in, beside `meshes`, in a folder of the robot.
const URDF_FOLDERS: &[&str] = &["urdf", "urdfs", "robots", "robot", "xacro"];

/// The folders, links followed.
#[derive(Debug)]
pub(crate) struct Roots {
    /// The URDF's folder, or the folder of the robot that holds it.
    own: PathBuf,
    /// Packages that the user named.
    given: Vec<(String, PathBuf)>,
    /// Folders that the user allowed besides.
    allowed: Vec<PathBuf>,
}

/// The folder that a file is taken from.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Place {
    /// A package, by its name and its folder.
    Package(String, PathBuf),
    /// The robot's own folder.
    Own,
    /// A folder that the user allowed.
    Allowed,
}

impl Roots {
    /// Of a URDF in a folder (links followed).
    pub(crate) fn new(urdf_folder: &Path, packages: &Packages, allowed: &[PathBuf]) -> Self {
        let canonical = |path: &PathBuf| path.canonicalize().ok();
        let given = packages.given().filter_map(|(name, path)| {
            let path = path.canonicalize().ok()?;
            Some((name.to_owned(), path))
        });
        Roots {
            own: own_folder(urdf_folder),
            given: given.collect(),
            allowed: allowed.iter().filter_map(canonical).collect(),
        }
    }

    /// Where a file (links followed) is taken from, or `None` where it may not be taken. `package`
    /// is the package that its name says, and the folder that was found for that.
    pub(crate) fn place(&self, file: &Path, package: Option<(&str, &Path)>) -> Option<Place> {
        if let Some((name, folder)) = package
            && let Ok(folder) = folder.canonicalize()
        {
            let is_package = package_name(&folder).as_deref() == Some(name);
            if file.starts_with(&folder) && (is_package || !is_broad(&folder)) {
                return Some(Place::Package(name.to_owned(), folder));
            }
            // Installed packages may hold links to the files of their sources.
            let mut above = file.ancestors().skip(1);
            if let Some(source) = above.find(|above| package_name(above).as_deref() == Some(name)) {
                return Some(Place::Package(name.to_owned(), source.to_owned()));
            }
        }
        if self.is_own(file) {
            return Some(Place::Own);
        }
        let mut given = self.given.iter();
        if let Some((name, folder)) = given.find(|(_, folder)| file.starts_with(folder)) {
            return Some(Place::Package(name.clone(), folder.clone()));
        }
        let mut allowed = self.allowed.iter();
        let is_allowed = allowed.any(|folder| file.starts_with(folder));
        is_allowed.then_some(Place::Allowed)
    }

    /// Whether a file lies in the robot's own folder.
    pub(crate) fn is_own(&self, file: &Path) -> bool {
        file.starts_with(&self.own)
    }
}

/// The package that a folder lies in, or else the folder that holds `urdf/`, or else the folder.
fn own_folder(urdf_folder: &Path) -> PathBuf {
    let mut above = urdf_folder.ancestors();
    if let Some(package) = above.find(|above| package_name(above).is_some()) {
        return package.to_owned();
    }
    let is_urdf_folder = |folder: &&Path| {
        let name = folder.file_name().and_then(|name| name.to_str());
        name.is_some_and(|name| URDF_FOLDERS.contains(&name))
    };
    let mut above = urdf_folder.ancestors();
    let holds_urdfs = above.find(is_urdf_folder).and_then(Path::parent);
    match holds_urdfs.filter(|folder| !is_broad(folder)) {
        Some(folder) => folder.to_owned(),
        None => urdf_folder.to_owned(),
    }
}

/// Whether a folder holds more than robots: the root of the file system or a folder right in it,
/// the user's folder or one that holds it.
fn is_broad(folder: &Path) -> bool {
    let depth = folder.components().count();
    let home = std::env::home_dir().and_then(|home| home.canonicalize().ok());
    depth <= 2 || home.is_some_and(|home| home.starts_with(folder))
}
