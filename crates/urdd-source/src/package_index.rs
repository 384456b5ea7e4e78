//! Packages where xacro finds them: `$(find NAME)`, with or without ROS.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::around::around;
use crate::files::Files;
use crate::packages::Packages;
use urdd_directory::outputs;
use urdd_directory::temporary::Temporary;

/// The part of ament that xacro needs, for machines without ROS.
const AMENT: &str = include_str!("ament_index_python.py");

/// Packages in layouts that ROS searches: those named by the user before those of the environment, and those that the file is in
/// or that are beside it after them.
pub(super) struct PackageIndex {
    prefix: Temporary,
    /// The names in the layouts, each with its folder.
    folders: Vec<(PathBuf, PathBuf)>,
}

/// The layouts, by their folders in the prefix.
const GIVEN: &str = "given";
const FOUND: &str = "found";
/// Folders without a `package.xml`, which ROS 1 would search to their ends.
const NAMED: &str = "named";
const PYTHON: &str = "python";

impl PackageIndex {
    pub(super) fn new(packages: &Packages, file: &Path) -> io::Result<Self> {
        let mut index = PackageIndex {
            prefix: Temporary::begin(&std::env::temp_dir(), "packages")?,
            folders: Vec::new(),
        };
        for (name, folder) in packages.given() {
            index.add(GIVEN, name, &folder.canonicalize()?)?;
        }
        let file = file.canonicalize()?;
        let mut found = BTreeMap::new();
        for one in around(file.parent().unwrap_or(&file), &Files::Disk) {
            if one.has_manifest || one.is_above {
                let layout = if one.has_manifest { FOUND } else { NAMED };
                found.entry(one.name).or_insert((layout, one.folder));
            }
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
        outputs::fresh(&index.join(name), b"")?;
        let at = share.join(name);
        link(folder, &at)?;
        self.folders.push((at, folder.to_owned()));
        Ok(())
    }

    /// Puts them around those of the environment.
    pub(super) fn tell(&self, command: &mut Command) {
        let inside = |name: &str| self.prefix.path().join(name);
        let share = |name: &str| inside(name).join("share");
        let around = |name, first, last: &[PathBuf]| {
            let paths = std::env::var_os(name).unwrap_or_default();
            let paths = std::env::split_paths(&paths).filter(|path| !path.as_os_str().is_empty());
            let all: Vec<PathBuf> =
                Option::into_iter(first).chain(paths).chain(last.iter().cloned()).collect();
            // A path that cannot be in a list leaves the variable as it is.
            std::env::join_paths(all).ok().map(|paths| (name, paths))
        };
        command.envs(around(
            "AMENT_PREFIX_PATH",
            Some(inside(GIVEN)),
            &[inside(FOUND), inside(NAMED)],
        ));
        command.envs(around("ROS_PACKAGE_PATH", Some(share(GIVEN)), &[share(FOUND)]));
        command.envs(around("PYTHONPATH", None, &[inside(PYTHON)]));
    }

    /// A text whose paths outlive the layouts. `file://$(find NAME)` becomes `package://NAME`, which no machine's folders are in.
    pub(super) fn lasting(&self, text: &str) -> String {
        let folders = self
            .folders
            .iter()
            .filter_map(|(at, to)| Some((at.to_str()?, at.file_name()?.to_str()?, to.to_str()?)));
        folders.fold(text.to_owned(), |text, (at, name, to)| match text.contains(at) {
            true => text
                .replace(&format!("file://{at}/"), &format!("package://{name}/"))
                .replace(&format!("{at}/"), &format!("{to}/")),
            false => text,
        })
    }
}

#[cfg(unix)]
fn link(folder: &Path, at: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(folder, at)
}

#[cfg(windows)]
fn link(folder: &Path, at: &Path) -> io::Result<()> {
    std::os::windows::fs::symlink_dir(folder, at)
}

/// WebAssembly starts no program.
#[cfg(not(any(unix, windows)))]
fn link(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
