//! Packages where xacro finds them: `$(find NAME)`, with or without ROS. Each is laid out as it is installed: as a folder of
//! links to its sources.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{fs, io};

use urdd_directory::outputs;
use urdd_directory::target_lock::Temporary;

use crate::files::Files;
use crate::installed::{self, Installed};
use crate::packages::{Packages, around};

/// The part of ament that xacro needs, for machines without ROS.
const AMENT: &str = include_str!("ament_index_python.py");

/// Packages in layouts that ROS searches: those named by the user before those of the environment, and those that the file is in
/// or that are beside it after them.
pub(super) struct PackageIndex {
    prefix: Temporary,
    linked: Vec<Linked>,
}

struct Linked {
    /// Its place there.
    at: PathBuf,
    folder: PathBuf,
    installed: Installed,
}

/// The layouts, by their folders in the prefix.
const GIVEN: &str = "given";
/// Those of the environment: what is found there is told by its path from what was written so.
const INSTALLED: &str = "installed";
const FOUND: &str = "found";
/// Folders without a `package.xml`, which ROS 1 would search to their ends.
const NAMED: &str = "named";
const PYTHON: &str = "python";

impl PackageIndex {
    pub(super) fn new(packages: &Packages, file: &Path) -> io::Result<Self> {
        let mut index = PackageIndex {
            prefix: Temporary::begin(&std::env::temp_dir(), "packages")?,
            linked: Vec::new(),
        };
        for (name, folder) in packages.given() {
            index.add(GIVEN, name, &folder.canonicalize()?)?;
        }
        for (name, folder) in packages.installed() {
            let _ = index.add(INSTALLED, &name, &folder);
        }
        let file = file.canonicalize()?;
        let mut found: BTreeMap<String, (&str, PathBuf)> = BTreeMap::new();
        for one in around(file.parent().unwrap_or(&file), &Files::Disk) {
            if one.has_manifest || one.is_above {
                let layout = if one.has_manifest { FOUND } else { NAMED };
                found.entry(one.name).or_insert((layout, one.folder));
            }
        }
        let known = packages.known().iter().map(|(name, folder)| (name.clone(), folder.clone()));
        for (name, folder) in known.chain(packages.crawl(&Files::Disk)) {
            found.entry(name).or_insert((FOUND, folder));
        }
        for (name, (layout, folder)) in found {
            // A machine without symbolic links expands what needs no package.
            let _ = index.add(layout, &name, &folder);
        }
        let python = index.prefix.path().join(PYTHON).join("ament_index_python");
        outputs::fresh(&python.join("__init__.py"), b"")?;
        outputs::fresh(&python.join("packages.py"), AMENT.as_bytes())?;
        Ok(index)
    }

    fn add(&mut self, layout: &str, name: &str, folder: &Path) -> io::Result<()> {
        let share = self.prefix.path().join(layout).join("share");
        let index = share.join("ament_index/resource_index/packages");
        let at = share.join(name);
        if at.is_symlink() || at.exists() {
            return Ok(());
        }
        outputs::fresh(&index.join(name), b"")?;
        let installed = installed::installed(folder, &Files::Disk);
        match installed.is_as_source() {
            true => link(folder, &at)?,
            false => lay(&at, folder, &installed)?,
        }
        self.linked.push(Linked { at, folder: folder.to_owned(), installed });
        Ok(())
    }

    /// Puts them around those of the environment; of Python, some before.
    pub(super) fn tell(&self, command: &mut Command, of_python: &[PathBuf]) {
        let inside = |name: &str| self.prefix.path().join(name);
        let share = |name: &str| inside(name).join("share");
        let around = |name, first: &[PathBuf], last: &[PathBuf]| {
            let paths = std::env::var_os(name).unwrap_or_default();
            let paths = std::env::split_paths(&paths).filter(|path| !path.as_os_str().is_empty());
            let all: Vec<PathBuf> =
                first.iter().cloned().chain(paths).chain(last.iter().cloned()).collect();
            // A path that cannot be in a list leaves the variable as it is.
            std::env::join_paths(all).ok().map(|paths| (name, paths))
        };
        command.envs(around(
            "AMENT_PREFIX_PATH",
            &[inside(GIVEN), inside(INSTALLED)],
            &[inside(FOUND), inside(NAMED)],
        ));
        command.envs(around("ROS_PACKAGE_PATH", &[share(GIVEN)], &[share(FOUND)]));
        command.envs(around("PYTHONPATH", of_python, &[inside(PYTHON)]));
    }

    /// A text whose paths outlive the layouts. `file://$(find NAME)` becomes `package://NAME`, which no machine's folders are in.
    pub(super) fn lasting(&self, text: &str) -> String {
        let prefix = self.prefix.path().to_str();
        if prefix.is_none_or(|prefix| !text.contains(prefix)) {
            return text.to_owned();
        }
        self.linked.iter().fold(text.to_owned(), |text, one| one.lasting(text))
    }

    /// What to do where xacro did not find a file of a package whose installation is not known.
    pub(super) fn advice(&self, words: &str) -> Option<String> {
        let is_in =
            |one: &&Linked| one.at.to_str().is_some_and(|at| words.contains(&format!("{at}/")));
        self.linked.iter().filter(is_in).find_map(|one| {
            let why = one.installed.by_variables(&one.folder)?;
            let folder = one.folder.display();
            Some(format!(
                "{why}; if this is one of them, build {folder} and source its install/setup.bash"
            ))
        })
    }
}

impl Linked {
    fn lasting(&self, text: String) -> String {
        let name = self.at.file_name().and_then(|name| name.to_str());
        let (Some(at), Some(name), Some(to)) = (self.at.to_str(), name, self.folder.to_str())
        else {
            return text;
        };
        let inside = format!("{at}/");
        if !text.contains(&inside) {
            return text;
        }
        // Many write `file:///$(find NAME)`, with one slash too many.
        let as_package = format!("package://{name}/");
        let text = text.replace(&format!("file:///{inside}"), &as_package);
        let text = text.replace(&format!("file://{inside}"), &as_package);
        let mut parts = text.split(&inside);
        let mut made = parts.next().unwrap_or_default().to_owned();
        for rest in parts {
            let end = rest.find(ENDS_PATH).unwrap_or(rest.len());
            let is_there = |path: &String| self.folder.join(path).exists();
            let source = self.installed.sources(&rest[..end]).find(is_there);
            let source = source.as_deref().unwrap_or(&rest[..end]);
            made += &format!("{to}/{source}{}", &rest[end..]);
        }
        made
    }
}

/// What ends a path in a text of xacro.
const ENDS_PATH: [char; 9] = ['"', '\'', '<', '>', ' ', '\n', ')', ',', ';'];

const MOST_LINKS: usize = 10_000;

/// Lays out the package in `folder` at a path where nothing is: what it installs, and for the rest its sources as they are.
pub fn lay(at: &Path, folder: &Path, installed: &Installed) -> io::Result<()> {
    let mut tree = Tree { left: MOST_LINKS };
    fs::create_dir_all(at)?;
    for rule in &installed.rules {
        // What is not there is said when it is asked for.
        if let Ok(source) = folder.join(&rule.source).canonicalize() {
            tree.put(at, &rule.target, &source)?;
        }
    }
    tree.put(at, "", folder)
}

struct Tree {
    left: usize,
}

impl Tree {
    /// Puts a file or folder at a path below `root`. What is there already stays.
    fn put(&mut self, root: &Path, path: &str, source: &Path) -> io::Result<()> {
        let mut at = root.to_owned();
        let (above, last) = path.rsplit_once('/').unwrap_or(("", path));
        for part in above.split('/').filter(|part| !part.is_empty()) {
            at.push(part);
            self.open(&at)?;
        }
        let at = if last.is_empty() { at } else { at.join(last) };
        self.merge(&at, source)
    }

    fn merge(&mut self, at: &Path, source: &Path) -> io::Result<()> {
        if !at.exists() {
            self.left = self.left.checked_sub(1).ok_or(io::ErrorKind::StorageFull)?;
            return link(source, at);
        }
        if !(at.is_dir() && source.is_dir()) || at.canonicalize()? == source.canonicalize()? {
            return Ok(());
        }
        self.open(at)?;
        for entry in fs::read_dir(source)? {
            let entry = entry?;
            self.merge(&at.join(entry.file_name()), &entry.path())?;
        }
        Ok(())
    }

    /// Makes a folder of a link to one, with links to what is in that.
    fn open(&mut self, at: &Path) -> io::Result<()> {
        let Ok(target) = fs::read_link(at) else { return fs::create_dir_all(at) };
        fs::remove_file(at)?;
        fs::create_dir(at)?;
        if target.is_dir() { self.merge(at, &target) } else { Ok(()) }
    }
}

#[cfg(unix)]
pub fn link(folder: &Path, at: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(folder, at)
}

#[cfg(windows)]
pub fn link(folder: &Path, at: &Path) -> io::Result<()> {
    std::os::windows::fs::symlink_dir(folder, at)
}

/// WebAssembly starts no program.
#[cfg(not(any(unix, windows)))]
pub fn link(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
