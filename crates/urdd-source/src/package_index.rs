//! Packages where xacro finds them: `$(find NAME)`, with or without ROS. Each is laid out as it is installed: as a folder of
//! links to its sources.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::{fs, io};

use urdd_directory::account::Account;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::outputs;
use urdd_directory::target_lock::Temporary;

use crate::files::Files;
use crate::folder_facts::FolderFacts;
use crate::installed::Installed;
use crate::packages::{Packages, around};

/// The part of ament that xacro needs, for machines without ROS.
const AMENT: &str = include_str!("ament_index_python.py");

/// Packages in layouts that ROS searches: those named by the user before those of the environment, and those that the file is in
/// or that are beside it after them.
pub(super) struct PackageIndex {
    prefix: Temporary,
    /// By their places there.
    linked: HashMap<PathBuf, Linked>,
    account: Account,
}

struct Linked {
    folder: PathBuf,
    installed: Arc<Installed>,
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
    pub(super) fn new(
        packages: &Packages,
        file: &Path,
        cancellation: &Cancellation,
    ) -> io::Result<Self> {
        let mut index = PackageIndex {
            prefix: Temporary::begin(&std::env::temp_dir(), "packages")?,
            linked: HashMap::new(),
            account: Account::new(cancellation),
        };
        let facts = &FolderFacts::new(&Files::Disk);
        for (name, folder) in packages.given() {
            index.add(GIVEN, name, &folder.canonicalize()?, facts)?;
        }
        for (name, folder) in packages.installed() {
            let _ = index.add(INSTALLED, &name, &folder, facts);
        }
        let file = file.canonicalize()?;
        let mut found: BTreeMap<String, (&str, PathBuf)> = BTreeMap::new();
        for one in around(file.parent().unwrap_or(&file), facts) {
            if one.has_manifest || one.is_above {
                let layout = if one.has_manifest { FOUND } else { NAMED };
                found.entry(one.name).or_insert((layout, one.folder));
            }
        }
        let known = packages.known().iter().map(|(name, folder)| (name.clone(), folder.clone()));
        for (name, folder) in known.chain(packages.crawl(facts)) {
            found.entry(name).or_insert((FOUND, folder));
        }
        for (name, (layout, folder)) in found {
            // A machine without symbolic links expands what needs no package.
            let _ = index.add(layout, &name, &folder, facts);
        }
        let python = index.prefix.path().join(PYTHON).join("ament_index_python");
        outputs::fresh(&python.join("__init__.py"), b"")?;
        outputs::fresh(&python.join("packages.py"), AMENT.as_bytes())?;
        Ok(index)
    }

    fn add(
        &mut self,
        layout: &str,
        name: &str,
        folder: &Path,
        facts: &FolderFacts,
    ) -> io::Result<()> {
        let share = self.prefix.path().join(layout).join("share");
        let index = share.join("ament_index/resource_index/packages");
        let at = share.join(name);
        if at.is_symlink() || at.exists() {
            return Ok(());
        }
        outputs::fresh(&index.join(name), b"")?;
        let installed = facts.installed(folder);
        match installed.is_as_source() {
            true => link(folder, &at)?,
            false => lay(&at, folder, &installed)?,
        }
        self.linked.insert(at, Linked { folder: folder.to_owned(), installed });
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
        let Some(prefix) = self.prefix.path().to_str() else { return text.to_owned() };
        let prefix = format!("{prefix}/");
        self.account.deposit(text.len());
        let mut parts = text.split(&prefix);
        let mut made = parts.next().unwrap_or_default().to_owned();
        for rest in parts {
            let Some((name, one, rest)) = self.linked(rest) else {
                made += &prefix;
                made += rest;
                continue;
            };
            // Many write `file:///$(find NAME)`, with one slash too many.
            let of_uri = ["file:///", "file://"].iter().find(|start| made.ends_with(**start));
            if let Some(start) = of_uri {
                made.truncate(made.len() - start.len());
                made += &format!("package://{name}/{rest}");
                continue;
            }
            let end = rest.find(ENDS_PATH).unwrap_or(rest.len());
            let (path, rest) = rest.split_at(end);
            let is_there = |path: &str| one.folder.join(path).exists();
            // Where very many are looked for, the path is as it was written.
            let source = one.installed.source(path, &self.account, is_there).ok().flatten();
            let source = source.as_deref().unwrap_or(path);
            made += &format!("{}/{source}{rest}", one.folder.display());
        }
        made
    }

    /// The package that a path below the prefix is in, its name, and the rest of the path.
    fn linked<'t>(&self, path: &'t str) -> Option<(&'t str, &Linked, &'t str)> {
        let mut parts = path.splitn(4, '/');
        let (layout, share, name) = (parts.next()?, parts.next()?, parts.next()?);
        let rest = parts.next()?;
        let at = self.prefix.path().join(layout).join(share).join(name);
        let one = self.linked.get(&at).filter(|one| one.folder.to_str().is_some())?;
        Some((name, one, rest))
    }

    /// What to do where xacro did not find a file of a package whose installation is not known.
    pub(super) fn advice(&self, words: &str) -> Option<String> {
        let prefix = format!("{}/", self.prefix.path().to_str()?);
        words.split(&prefix).skip(1).find_map(|path| {
            let (_, one, _) = self.linked(path)?;
            let why = one.installed.is_not_known(&one.folder)?;
            let folder = one.folder.display();
            Some(format!(
                "{why}; if this is one of them, build {folder} and source its install/setup.bash"
            ))
        })
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
