//! The folders from which mesh files may be read.
//!
//! A URDF may come from a stranger, and a URDD gets published. A URDF must not make the user publish arbitrary files of
//! this machine. Files are therefore read only from the robot's own folders, and from those that the user allows.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::files::{Files, is_broad};
use crate::folder_facts::FolderFacts;
use crate::packages::{Neighbours, Packages, around};
use crate::settings::Settings;

/// Names of folders for URDFs, which are siblings of `meshes` in a robot's folder.
const URDF_FOLDERS: &[&str] = &["urdf", "urdfs", "robots", "robot", "xacro"];

/// The allowed folders, with symbolic links resolved.
#[derive(Debug)]
pub struct Roots {
    facts: FolderFacts,
    /// The URDF's folder, or the robot's folder that contains it.
    own: PathBuf,
    /// Packages named by the user.
    given: Vec<(String, PathBuf)>,
    /// Other folders allowed by the user.
    allowed: Vec<PathBuf>,
    around: OnceLock<Neighbours>,
    crawled: OnceLock<BTreeMap<String, PathBuf>>,
}

/// The folder from which a file is read.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// A package: its name and folder.
    Package(String, PathBuf),
    /// The robot's own folder.
    Own,
    /// A folder allowed by the user.
    Allowed,
}

impl Roots {
    /// The folders for a URDF in a folder (symbolic links resolved).
    pub fn new(urdf_folder: &Path, settings: &Settings) -> Self {
        let files = &settings.files;
        let given = settings.packages.given().filter_map(|(name, path)| {
            let path = files.canonicalize(path).ok()?;
            Some((name.to_owned(), path))
        });
        let allowed = settings.allowed_folders.iter();
        let facts = settings.folder_facts();
        Roots {
            own: match files {
                Files::Disk => own_folder(urdf_folder, &facts),
                // All of it was given.
                Files::Memory(_) => PathBuf::from("/"),
            },
            given: given.collect(),
            allowed: allowed.filter_map(|path| files.canonicalize(path).ok()).collect(),
            facts,
            around: OnceLock::new(),
            crawled: OnceLock::new(),
        }
    }

    /// Allows another folder (symbolic links resolved).
    pub(crate) fn allow(&mut self, folder: PathBuf) {
        self.allowed.push(folder);
    }

    pub fn around(&self, urdf_folder: &Path) -> &Neighbours {
        self.around.get_or_init(|| Neighbours::new(around(urdf_folder, &self.facts)))
    }

    /// The folder of a package that is found only by searching deep.
    pub fn crawled(&self, package: &str, packages: &Packages) -> Option<&Path> {
        let all = self.crawled.get_or_init(|| packages.crawl(&self.facts));
        all.get(package).map(PathBuf::as_path)
    }

    pub fn facts(&self) -> &FolderFacts {
        &self.facts
    }

    pub fn files(&self) -> &Files {
        self.facts.files()
    }

    /// The place of a file (symbolic links resolved), or `None` if it may not be read. `package` is the package named
    /// in the reference, and the folder found for it.
    pub fn place(&self, file: &Path, package: Option<(&str, &Path)>) -> Option<Place> {
        if let Some((name, folder)) = package
            && let Ok(folder) = self.files().canonicalize(folder)
        {
            let is_package = self.facts.is_package(&folder, name);
            if file.starts_with(&folder) && (is_package || !is_broad(&folder)) {
                return Some(Place::Package(name.to_owned(), folder));
            }
            // Installed packages may contain symbolic links to their source files.
            let mut above = file.ancestors().skip(1);
            if let Some(source) = above.find(|above| self.facts.is_package(above, name)) {
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

    pub fn is_own(&self, file: &Path) -> bool {
        file.starts_with(&self.own)
    }
}

/// The package that contains the folder, otherwise the parent of a folder such as `urdf/`, otherwise the folder itself.
fn own_folder(urdf_folder: &Path, facts: &FolderFacts) -> PathBuf {
    let mut above = urdf_folder.ancestors();
    if let Some(package) = above.find(|above| facts.package_name(above).is_some()) {
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
