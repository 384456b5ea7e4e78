//! The displayed robots: those that were given, and those that are dropped on the page.

use std::collections::BTreeSet;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parking_lot::Mutex;
use serde::Deserialize;
use serde_json::json;

use crate::http::{Reply, Result, failed, refused};
use crate::revision;
use crate::shown::{Access, Opened, Shown, Source};
use urdd_directory::discover::{DiscoverError, ROOT_METADATA, discover};
use urdd_directory::file_type::FileType;
use urdd_directory::limits::{MAX_FOLDER_DEPTH, MAX_NAME_BYTES, MAX_PART_BYTES};
use urdd_directory::listing::EntryKind;
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::Archive;
use urdd_directory::{outputs, path};
use urdd_generate::Settings;
use urdd_source::dropped::PackageFolders;
use urdd_source::{Settings as SourceSettings, robots};

/// The robots of a page, in order. Robots may be added while it is shown.
#[derive(Debug, Default)]
pub struct Collection {
    listed: Mutex<Listed>,
    drops: Option<Drops>,
    pub(super) settings: Settings,
}

#[derive(Debug, Default)]
struct Listed {
    robots: Vec<Arc<Shown>>,
    ids: BTreeSet<String>,
}

impl Collection {
    /// Accepts URDFs that are dropped on the page, into this folder. `with_xacro` allows them to run xacro.
    #[must_use]
    pub fn with_drops(self, folder: PathBuf, with_xacro: bool) -> Self {
        let drops = Drops { folder, with_xacro, taken: Mutex::default() };
        Collection { drops: Some(drops), ..self }
    }

    /// Reads URDFs by these settings.
    #[must_use]
    pub fn with_settings(self, settings: Settings) -> Self {
        Collection { settings, ..self }
    }

    /// Adds every URDD at or below a path.
    ///
    /// # Errors
    /// If there is none, or the path cannot be searched.
    pub fn add(&self, path: &Path) -> Result<(), DiscoverError> {
        for found in discover(path)? {
            // Archives are read-only, and URDDs from before version 1 have no edits.
            let has_metadata = found.path.join(ROOT_METADATA).is_file();
            let kind = match found.closed.is_none() && has_metadata {
                true => Access::Writable,
                false => Access::ReadOnly,
            };
            // Absolute: the working directory may change later, and `.` has no name for a sibling to be derived from.
            let path = found.path.canonicalize().unwrap_or(found.path);
            self.put(found.name, None, path, kind);
        }
        Ok(())
    }

    /// Adds the URDD at a root: the page shows these files, whatever happens at its path.
    ///
    /// # Errors
    /// If they cannot be listed.
    pub fn add_root(&self, root: &Root) -> Result<Arc<Shown>, ReadError> {
        let opened = Opened::of(root)?;
        let shown = self.put(root.folder_name(), None, PathBuf::new(), Access::ReadOnly);
        *shown.opened.lock() = Some((revision::GONE.to_owned(), opened));
        Ok(shown)
    }

    /// Adds a robot to be generated from a URDF when somebody opens it.
    pub fn add_source(&self, name: String, source: Source) -> Arc<Shown> {
        self.put(name, Some(source), PathBuf::new(), Access::Temporary)
    }

    fn put(&self, name: String, source: Option<Source>, path: PathBuf, kind: Access) -> Arc<Shown> {
        let plain = |c: char| match c {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '-' | '_' => c,
            _ => '_',
        };
        let word: String = name.chars().take(80).map(plain).collect();
        let word = if word.is_empty() { "robot" } else { &word };
        let mut id = word.to_owned();
        let mut number = 2;
        let mut listed = self.listed.lock();
        while !listed.ids.insert(id.clone()) {
            id = format!("{word}.{number}");
            number += 1;
        }
        let shown = Arc::new(Shown::new(id, name, source, path, kind));
        listed.robots.push(Arc::clone(&shown));
        shown
    }

    pub(super) fn has_dropped(&self, file: &Path) -> bool {
        self.drops.as_ref().is_some_and(|drops| file.starts_with(&drops.folder))
    }

    /// The robots.
    pub fn robots(&self) -> Vec<Arc<Shown>> {
        self.listed.lock().robots.clone()
    }

    /// Takes out a robot, by its id.
    pub fn remove(&self, id: &str) {
        self.listed.lock().robots.retain(|robot| robot.id != id);
    }

    /// Finds a robot by its id.
    pub fn find(&self, id: &str) -> Option<Arc<Shown>> {
        self.listed.lock().robots.iter().find(|robot| robot.id == id).cloned()
    }
}

/// Maximum size of all drops, bytes.
const MAX_TOTAL: u64 = 1 << 30;

/// Where dropped files go: a temporary folder.
#[derive(Debug)]
struct Drops {
    folder: PathBuf,
    /// Whether xacro files may run.
    with_xacro: bool,
    taken: Mutex<Taken>,
}

#[derive(Debug, Default)]
struct Taken {
    drops: usize,
    bytes: u64,
}

impl Drops {
    /// A new folder for so many bytes.
    fn begin(&self, bytes: u64) -> Result<PathBuf> {
        let mut taken = self.taken.lock();
        if taken.bytes.saturating_add(bytes) > MAX_TOTAL {
            return refused(
                413,
                "more than 1 GiB was dropped; give the path to `urdd view` instead",
            );
        }
        taken.bytes += bytes;
        taken.drops += 1;
        let folder = self.folder.join(taken.drops.to_string());
        fs::create_dir_all(&folder).map_err(failed(500))?;
        Ok(folder)
    }
}

/// Maximum size of one drop, bytes.
pub const MAX_DROP: u64 = 256 << 20;
/// Maximum number of files of one drop.
const MAX_ITEMS: usize = 10_000;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Item {
    path: String,
    size: u64,
}

/// Takes URDFs and their meshes that were dropped on the page into the temporary folder, and adds their robots to the
/// collection, unless the page does not wait any more.
///
/// The body is a line of JSON, a list of `path` and `size`, and then the files' bytes one after another. A .zip that comes
/// alone stands for the files in it. Everything is hostile: no path leaves the folder, no file replaces another, and
/// number, sizes and depth have limits.
pub fn take(collection: &Collection, body: &[u8], is_gone: &dyn Fn() -> bool) -> Reply {
    Reply::of(taken(collection, body, is_gone).map(|ids| json!({ "robots": ids })))
}

fn taken(collection: &Collection, body: &[u8], is_gone: &dyn Fn() -> bool) -> Result<Vec<String>> {
    let Some(drops) = &collection.drops else {
        return refused(403, "no URDFs are taken here");
    };
    let (mut items, mut content) = items(body)?;
    let unpacked;
    let wanted = || match is_gone() {
        true => refused(409, "the page does not wait any more"),
        false => Ok(()),
    };
    if let [item] = &*items
        && FileType::Archive.is_of(Path::new(&item.path))
    {
        (items, unpacked) = of_zip(content, &wanted)?;
        content = &unpacked;
    }
    check(&items)?;
    let folder = drops.begin(content.len() as u64)?;
    let sources = write(&items, content, &folder, &wanted)
        .and_then(|()| sources(&items, &folder, drops.with_xacro, &wanted));
    let sources = sources.inspect_err(|_| {
        let _ = fs::remove_dir_all(&folder);
    })?;
    let add = |(name, source)| collection.add_source(name, source).id.clone();
    Ok(sources.into_iter().map(add).collect())
}

/// The files of a drop, and their bytes.
fn items(body: &[u8]) -> Result<(Vec<Item>, &[u8])> {
    let Some(end) = body.iter().position(|byte| *byte == b'\n') else {
        return refused(400, "there is no list of files");
    };
    let (list, content) = (&body[..end], &body[end + 1..]);
    let items: Vec<Item> = serde_json::from_slice(list)
        .map_err(|error| (400, format!("no list of files: {error}")))?;
    let size = items.iter().try_fold(0u64, |sum, item| sum.checked_add(item.size));
    if size != Some(content.len() as u64) {
        return refused(400, "the sizes do not match");
    }
    Ok((items, content))
}

/// The files in a .zip, and their bytes.
fn of_zip(bytes: &[u8], wanted: &dyn Fn() -> Result<()>) -> Result<(Vec<Item>, Vec<u8>)> {
    let bad = |error: &dyn std::fmt::Display| (400, format!("this .zip cannot be read: {error}"));
    let archive = Archive::of_any("", bytes.to_vec()).map_err(|error| bad(&error))?;
    let root = Root::of(archive);
    let entries = root.list().map_err(|error| bad(&error))?.entries.into_iter();
    let files: Vec<_> = entries.filter(|entry| entry.kind == EntryKind::File).collect();
    if files.iter().map(|file| file.size).sum::<u64>() > MAX_DROP {
        return refused(413, format!("this .zip has more than {} MiB in it", MAX_DROP >> 20));
    }
    let (mut items, mut content) = (Vec::new(), Vec::new());
    for file in files {
        wanted()?;
        content.extend(root.read(&file.path, file.size).map_err(|error| bad(&error))?);
        items.push(Item { path: file.path, size: file.size });
    }
    Ok((items, content))
}

/// Whether number and paths are such that they can be written.
fn check(items: &[Item]) -> Result<()> {
    if items.len() > MAX_ITEMS {
        return refused(400, format!("more than {MAX_ITEMS} files"));
    }
    for item in items {
        let name = &item.path;
        let is_long = name.len() > MAX_NAME_BYTES
            || name.split('/').any(|part| part.len() > MAX_PART_BYTES)
            || name.split('/').count() > MAX_FOLDER_DEPTH;
        if is_long {
            return refused(400, "a path is too long");
        }
        path::check(name).map_err(|fault| (400, format!("{name:?}: {fault}")))?;
    }
    Ok(())
}

fn write(
    items: &[Item],
    mut content: &[u8],
    folder: &Path,
    wanted: &dyn Fn() -> Result<()>,
) -> Result<()> {
    let failed = |path: &str, error: &std::io::Error| {
        let why = match error.kind() {
            // Nothing is replaced: two files of one name are an error.
            ErrorKind::AlreadyExists | ErrorKind::NotADirectory | ErrorKind::IsADirectory => {
                "another file or folder of this drop has the same name".to_owned()
            }
            _ => error.to_string(),
        };
        (400, format!("{path:?}: {why}"))
    };
    for Item { path, size } in items {
        wanted()?;
        let size = usize::try_from(*size).unwrap_or(usize::MAX);
        let (bytes, rest) =
            content.split_at_checked(size).ok_or((400, "the sizes do not match".to_owned()))?;
        content = rest;
        let target = folder.join(path);
        outputs::fresh(&target, bytes).map_err(|error| failed(path, &error))?;
    }
    // Without it, a package around the temporary folder would count as the robot's own, with the files in it.
    let package = folder.join("package.xml");
    if !package.exists() {
        let text = b"<package><name>dropped</name></package>\n";
        outputs::fresh(&package, text).map_err(|error| failed("package.xml", &error))?;
    }
    Ok(())
}

/// The URDFs of a drop, by name.
fn sources(
    items: &[Item],
    folder: &Path,
    with_xacro: bool,
    wanted: &dyn Fn() -> Result<()>,
) -> Result<Vec<(String, Source)>> {
    let mut jobs = robots::jobs(&[folder.to_owned()], &SourceSettings::default())
        .map_err(|_| (400, "there is no .urdf or .urdf.xacro file".to_owned()))?;
    if !with_xacro {
        jobs.retain(|job| !FileType::Xacro.is_of(&job.source));
    }
    if jobs.is_empty() {
        return refused(403, "xacro files are programs: start `urdd view --xacro` to run them");
    }
    let dropped = PackageFolders::of(items.iter().map(|item| &*item.path).collect());
    let sources = jobs.into_iter().map(|job| {
        wanted()?;
        let text = fs::read(&job.source).unwrap_or_default();
        let text = String::from_utf8_lossy(&text);
        let packages = dropped.of_text(&text, false).into_iter();
        let packages = packages.map(|(name, at)| format!("{name}={}", folder.join(at).display()));
        let source =
            Source { file: job.source, packages: packages.collect(), arguments: Vec::new() };
        Ok((job.name, source))
    });
    sources.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_plain_and_unique() {
        let collection = Collection::default();
        for name in ["arms/a b", "arms/a_b", "<b>", ""] {
            let source =
                Source { file: PathBuf::new(), packages: Vec::new(), arguments: Vec::new() };
            collection.add_source(name.to_owned(), source);
        }
        let robots = collection.robots();
        let ids: Vec<&str> = robots.iter().map(|robot| &*robot.id).collect();
        assert_eq!(ids, ["arms_a_b", "arms_a_b.2", "_b_", "robot"]);
    }
}
