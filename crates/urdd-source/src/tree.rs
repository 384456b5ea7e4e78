//! Lays out a package as it is installed: a folder of links to its sources.

use std::fs;
use std::io;
use std::path::Path;

use crate::installed::Installed;

/// Maximum number of links of a package.
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
