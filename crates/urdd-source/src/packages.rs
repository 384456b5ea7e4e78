//! Finds ROS packages: those that are named or known, and those around a URDF, which it is in or which are beside them.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::ffi::OsString;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;
use urdd_format::escape;
use urdd_format::nearest::nearest;

use crate::files::{Files, is_broad};
use crate::folder_facts::FolderFacts;

/// Maximum depth of the search for packages below `ROS_PACKAGE_PATH`.
const CRAWL_DEPTH: usize = 5;
/// Maximum number of folders to visit in one search below `ROS_PACKAGE_PATH`, and in one of a workspace.
const MOST_FOLDERS: usize = 20_000;
const MOST_OF_WORKSPACE: usize = 2000;
/// Maximum number of entries of a folder.
pub(super) const MOST_NAMES: usize = 1000;
const MOST_INSTALLED: usize = 2000;
/// Files that say that a folder has no packages for others. colcon's own folders, `build`, `install` and `log`, have one.
pub(super) const IGNORED: [&str; 3] = ["COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"];

/// The variables of Gazebo that list folders of models.
const MODEL_PATHS: [&str; 4] =
    ["GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH"];

/// A `--package` that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum PackagePathError {
    #[error("`{0}`: write NAME=PATH, the name of the package and its folder")]
    NoEquals(String),
    #[error("package `{name}`: {} is not a folder", path.display())]
    NoFolder { name: String, path: PathBuf },
}

/// Where to search for packages.
#[derive(Debug, Clone, Default)]
pub struct Packages {
    given: BTreeMap<String, PathBuf>,
    /// Those beside what was given, and those in the folders of a run: they count where none nearer has the name.
    known: Arc<BTreeMap<String, PathBuf>>,
    ros_package_path: Vec<PathBuf>,
    ament_prefix_path: Vec<PathBuf>,
    model_path: Vec<PathBuf>,
}

impl Packages {
    /// Only the packages around the URDF.
    pub fn none() -> Self {
        Self::default()
    }

    /// The search paths of the environment: `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH`; for `model://` also
    /// `GAZEBO_MODEL_PATH`, `GZ_SIM_RESOURCE_PATH`, `IGN_GAZEBO_RESOURCE_PATH` and `SDF_PATH`.
    pub fn from_environment(variable: impl Fn(&str) -> Option<OsString>) -> Self {
        let paths = |name: &str| -> Vec<PathBuf> {
            let value = variable(name).unwrap_or_default();
            let paths = std::env::split_paths(&value);
            paths.filter(|path| !path.as_os_str().is_empty()).collect()
        };
        Self {
            given: BTreeMap::new(),
            known: Arc::default(),
            ros_package_path: paths("ROS_PACKAGE_PATH"),
            ament_prefix_path: paths("AMENT_PREFIX_PATH"),
            model_path: MODEL_PATHS.iter().flat_map(|name| paths(name)).collect(),
        }
    }

    /// Adds `NAME=PATH`, and knows the packages beside it. A later entry replaces an earlier one with the same name.
    ///
    /// # Errors
    /// If the argument does not have this form, or the path is not a folder.
    pub fn add(&mut self, argument: &str) -> Result<(), PackagePathError> {
        let split =
            argument.split_once('=').filter(|(name, path)| !name.is_empty() && !path.is_empty());
        let Some((name, path)) = split else {
            return Err(PackagePathError::NoEquals(argument.to_owned()));
        };
        let path = PathBuf::from(path);
        if !path.is_dir() {
            let name = name.to_owned();
            return Err(PackagePathError::NoFolder { name, path });
        }
        let parent = path.canonicalize().ok().and_then(|path| Some(path.parent()?.to_owned()));
        if let Some(parent) = parent.filter(|parent| !is_broad(parent)) {
            self.know(beside(&parent));
        }
        self.put(name, path);
        Ok(())
    }

    /// Adds packages that count where none nearer has their name.
    pub fn know(&mut self, packages: impl IntoIterator<Item = (String, PathBuf)>) {
        let known = Arc::make_mut(&mut self.known);
        for (name, folder) in packages {
            known.entry(name).or_insert(folder);
        }
    }

    pub(super) fn known(&self) -> &BTreeMap<String, PathBuf> {
        &self.known
    }

    /// Adds the folder of a package, which is not looked at.
    pub fn put(&mut self, name: &str, folder: PathBuf) {
        self.given.insert(name.to_owned(), folder);
    }

    /// The packages named by the user, and their folders.
    pub fn given(&self) -> impl Iterator<Item = (&str, &Path)> {
        self.given.iter().map(|(name, path)| (name.as_str(), path.as_path()))
    }

    /// Candidate folders for a package, the likeliest first. A folder given by the user is the only candidate.
    pub(super) fn folders(
        &self,
        name: &str,
        urdf_folder: &Path,
        is_model: bool,
        facts: &FolderFacts,
    ) -> Vec<PathBuf> {
        if let Some(path) = self.given.get(name) {
            return vec![path.clone()];
        }
        let mut folders = Vec::new();
        // The URDF's own package, found by its package.xml or its folder name, or a package next to it.
        let listed = self.ros_package_path.iter().map(PathBuf::as_path);
        for folder in urdf_folder.ancestors().chain(listed) {
            if facts.is_package(folder, name) || is_named(folder, name) {
                folders.push(folder.to_owned());
            }
            folders.push(folder.join(name));
        }
        folders.extend(self.known.get(name).cloned());
        for prefix in &self.ament_prefix_path {
            folders.push(prefix.join("share").join(name));
        }
        if is_model {
            folders.extend(self.model_path.iter().map(|folder| folder.join(name)));
        }
        folders
    }

    /// The packages deep below `ROS_PACKAGE_PATH`, by name, as ROS finds them. Slow, so only used when everything else has
    /// failed, and once.
    pub(super) fn crawl(&self, facts: &FolderFacts) -> BTreeMap<String, PathBuf> {
        let (mut left, mut found) = (MOST_FOLDERS, BTreeMap::new());
        for folder in &self.ros_package_path {
            crawl(folder, CRAWL_DEPTH, &mut left, &mut found, facts);
        }
        found
    }

    /// The packages that are installed, as ament lists them: name and folder, the first of a name first.
    pub(super) fn installed(&self) -> Vec<(String, PathBuf)> {
        let mut found = Vec::new();
        for share in self.ament_prefix_path.iter().map(|prefix| prefix.join("share")) {
            let names = Files::Disk.names(&share.join("ament_index/resource_index/packages"));
            let names = names.into_iter().filter_map(|name| name.into_string().ok());
            found.extend(names.map(|name| (name.clone(), share.join(name))));
        }
        found.truncate(MOST_INSTALLED);
        found
    }
}

fn is_named(folder: &Path, name: &str) -> bool {
    folder.file_name().is_some_and(|found| found == name)
}

/// The packages right in a folder, by name.
fn beside(folder: &Path) -> Vec<(String, PathBuf)> {
    let mut names = Files::Disk.names(folder);
    names.truncate(MOST_NAMES);
    let folders = names.into_iter().map(|name| folder.join(name));
    let facts = FolderFacts::new(&Files::Disk);
    folders.filter_map(|folder| Some((facts.package_name(&folder)?.to_string(), folder))).collect()
}

/// The packages below the sources of a workspace.
pub(super) fn of_workspace(folder: &Path, facts: &FolderFacts) -> BTreeMap<String, PathBuf> {
    let (mut left, mut found) = (MOST_OF_WORKSPACE, BTreeMap::new());
    crawl(folder, CRAWL_DEPTH, &mut left, &mut found, facts);
    found
}

fn crawl(
    folder: &Path,
    depth: usize,
    left: &mut usize,
    found: &mut BTreeMap<String, PathBuf>,
    facts: &FolderFacts,
) {
    let files = facts.files();
    if *left == 0 || IGNORED.iter().any(|name| files.exists(&folder.join(name))) {
        return;
    }
    *left -= 1;
    if let Some(name) = facts.package_name(folder) {
        // Packages are not nested. The first of a name counts.
        found.entry(name.to_string()).or_insert_with(|| folder.to_owned());
        return;
    }
    if depth == 0 {
        return;
    }
    let mut names = files.names(folder);
    names.retain(|name| !name.to_string_lossy().starts_with('.'));
    names.truncate(MOST_NAMES);
    let below = names.into_iter().map(|name| folder.join(name));
    let below: Vec<PathBuf> = below.filter(|path| files.is_dir(path)).collect();
    below.iter().for_each(|folder| crawl(folder, depth - 1, left, found, facts));
}

/// How many folders above a URDF are searched for packages beside it.
const LEVELS: usize = 4;

/// A folder that may be a package.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Around {
    /// The name in its `package.xml`, otherwise that of the folder.
    pub name: String,
    /// The folder.
    pub folder: PathBuf,
    /// Whether it has a `package.xml`.
    pub has_manifest: bool,
    /// Whether the URDF is in it.
    pub is_above: bool,
}

/// A package whose name is near to one that is not there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NearPackage {
    /// The package.
    pub package: Around,
    /// Whether the file that was looked for is in it.
    pub has_file: bool,
}

impl NearPackage {
    /// What to do about a package `name` that is not there.
    pub fn in_words(&self, name: &str) -> String {
        let Around { name: near, has_manifest, .. } = &self.package;
        let file = if self.has_file { ", which has this file" } else { "" };
        let (there, rename) = match has_manifest {
            true => ("package", String::new()),
            false => ("folder", format!(", rename the folder to `{name}`")),
        };
        format!(
            "there is no package `{name}`, but there is the {there} `{near}`{file}; write `{near}`{rename}, or say --package {}=FOLDER",
            escape::shell(name)
        )
    }
}

/// The name of the folder of a workspace that has its sources.
const SOURCES: &str = "src";

/// The folders above a URDF's folder, nearest first, then those beside them, then other packages of the workspace or
/// repository.
pub fn around(urdf_folder: &Path, facts: &FolderFacts) -> Vec<Around> {
    let files = facts.files();
    let of = |folder: &Path, is_above| {
        let written = facts.package_name(folder).filter(|name| is_plain(name));
        let has_manifest = written.is_some();
        let plain = || Some(folder.file_name()?.to_str()?.to_owned());
        let name = written.map(|name| name.to_string()).or_else(plain)?;
        Some(Around { name, folder: folder.to_owned(), has_manifest, is_above })
    };
    let mut found: Vec<Around> =
        urdf_folder.ancestors().filter_map(|folder| of(folder, true)).collect();
    for above in urdf_folder.ancestors().take(LEVELS) {
        let mut names = files.names(above);
        names.truncate(MOST_NAMES);
        let beside = names.into_iter().map(|name| above.join(name));
        let beside =
            beside.filter(|folder| !urdf_folder.starts_with(folder) && files.is_dir(folder));
        found.extend(beside.filter_map(|folder| of(&folder, false)));
    }
    if let (Files::Disk, Some(root)) = (files, workspace(urdf_folder)) {
        let known: HashSet<PathBuf> = found.iter().map(|one| one.folder.clone()).collect();
        let others = of_workspace(root, facts).into_iter();
        let others = others.filter(|(name, folder)| is_plain(name) && !known.contains(folder));
        found.extend(others.map(|(name, folder)| {
            let is_above = urdf_folder.starts_with(&folder);
            Around { name, folder, has_manifest: true, is_above }
        }));
    }
    found
}

/// The highest folder above a URDF that has the sources of a workspace, or is a repository.
fn workspace(urdf_folder: &Path) -> Option<&Path> {
    let is_root = |folder: &&Path| {
        let has_sources = folder.file_name().is_some_and(|name| name == SOURCES);
        !is_broad(folder) && (has_sources || folder.join(".git").exists())
    };
    let home = std::env::home_dir();
    let above = urdf_folder.ancestors().take_while(|folder| home.as_deref() != Some(*folder));
    above.filter(is_root).last()
}

/// The folders of [`around`], by their names.
#[derive(Debug)]
pub struct Neighbours {
    all: Vec<Around>,
    /// The first package of each name.
    named: HashMap<String, usize>,
    /// By names in small letters without what parts words.
    bare: HashMap<String, Vec<usize>>,
}

fn bare(name: &str) -> String {
    name.to_lowercase().replace(['-', '_', ' ', '.'], "")
}

impl Neighbours {
    pub fn new(all: Vec<Around>) -> Self {
        let (mut named, mut by_bare) = (HashMap::new(), HashMap::<_, Vec<usize>>::new());
        for (place, one) in all.iter().enumerate() {
            by_bare.entry(bare(&one.name)).or_default().push(place);
            if one.has_manifest {
                named.entry(one.name.clone()).or_insert(place);
            }
        }
        Neighbours { all, named, bare: by_bare }
    }

    /// The package of a name.
    pub fn package(&self, name: &str) -> Option<&Around> {
        self.named.get(name).map(|place| &self.all[*place])
    }

    /// The package whose name differs from `name` in case, `-`, `_`, `.` and spaces alone; or one around the URDF that has the
    /// file `rest`, with a near name and the same numbers. `has_file` looks for that file in a folder.
    pub fn near(&self, name: &str, has_file: impl Fn(&Path) -> bool) -> Option<NearPackage> {
        let has_file = |one: &Around| has_file(&one.folder);
        let same = self.bare.get(&bare(name)).into_iter().flatten().map(|place| &self.all[*place]);
        // The first of the best.
        let same = same.rev().max_by_key(|one| has_file(one));
        let misspelt = || {
            let is_near = |one: &&Around| {
                nearest(std::iter::once(one.name.as_str()), name).is_some()
                    && digits(&one.name) == digits(name)
            };
            // Those above come first.
            let above = self.all.iter().take_while(|one| one.is_above);
            above.filter(|one| has_file(one)).find(is_near)
        };
        let package = same.or_else(misspelt)?.clone();
        Some(NearPackage { has_file: has_file(&package), package })
    }
}

fn digits(name: &str) -> String {
    name.chars().filter(char::is_ascii_digit).collect()
}

/// Whether a name is a single part of a path.
pub fn is_plain(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    matches!(parts.next(), Some(Component::Normal(_))) && parts.next().is_none()
}
