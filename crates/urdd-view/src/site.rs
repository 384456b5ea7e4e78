//! Exports the page and robots as a static site for any web server.
//!
//! A site is `index.html`, a list of its files, and a folder of files named by the SHA-256 of their content. File names
//! of a URDD do not become file names of the site. So no name is too long for a file system or collides with another,
//! and no extension makes a server declare a page or a program. Browsers do not execute `.bin` files.
//!
//! The list, `urdd-site.json`, tells a later export which files to replace. Anything else that the user put into the
//! folder remains.
#![expect(
    clippy::disallowed_methods,
    reason = "its files are named by their content, and it moves what a site lists alone"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use thiserror::Error;

use crate::assets::{ASSETS, page_of};
use crate::collection::Collection;
use crate::route::{Published, picture_of, published};
use crate::shown::Shown;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::limits::MAX_FILE_BYTES;
use urdd_directory::root::{EntryKind, ReadError};
use urdd_directory::staging::{Staging, StagingError};
use urdd_directory::writer::Writer;
use urdd_directory::{file_entry, regular};
use urdd_format::hexadecimal::hexadecimal;
use urdd_format::readable::first_of;
use urdd_format::registry::PROGRAM_VERSION;

/// The list itself. Its presence identifies a site.
const LIST: &str = "urdd-site.json";
/// The folder of all files except the page and the list.
const FOLDER: &str = "urdd-site";
/// The page. It references the other files, so replacing it replaces the site.
const PAGE: &str = "index.html";

const MADE_BY: &str = "urdd view --export";
const MAX_LIST_BYTES: u64 = 64 << 20;

/// The files that version 0.2.0 wrote, which had no list.
const OF_0_2_0: [&str; 7] =
    ["app.js", PAGE, "robots.json", "robots", "style.css", "urdd.wasm", "worker.js"];

/// Why a site was not written. The previous content is still in place.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The folder contains something else.
    #[error("{}: this folder is not empty, and not a site that `urdd view --export` wrote; give another one", .0.display())]
    Occupied(PathBuf),
    /// The folder contains a site of 0.2.0, which has no list of its files.
    /// The paths written by 0.2.0 that still exist are named.
    #[error(
        "{}: urdd 0.2.0 wrote this site without a list of its files, so nothing was changed. Delete what it wrote ({}; check \
         that nothing below robots is yours) and run this again: all other files stay",
        .0.display(), shown(.1)
    )]
    Unlisted(PathBuf, Vec<PathBuf>),
    /// The user's files are at the paths of the site's files.
    #[error(
        "{}: not written by the last export, or changed since, and would be overwritten; nothing was changed. Move it \
         away, and run this again",
        shown(.0)
    )]
    InTheWay(Vec<PathBuf>),
    /// It cannot be written.
    #[error(transparent)]
    Write(#[from] StagingError),
    /// The page's built-in data is corrupt.
    #[error("the page cannot be unpacked: {0}")]
    Page(io::Error),
    /// A robot is too large for one file: its name, and its size in bytes.
    #[error("{0}: {1} bytes are too many for a page in one file; give a folder")]
    TooLarge(String, u64),
    /// A robot cannot be read.
    #[error("{0}: {1}")]
    Robot(String, ReadError),
}

fn shown(paths: &[PathBuf]) -> String {
    const MOST: usize = 8;
    first_of(paths.iter().map(|path| path.display()), MOST)
}

/// Files by path relative to the site, each with the SHA-256 hashes of its possible contents.
#[derive(Debug, Clone, Default)]
struct SiteList(BTreeMap<String, BTreeSet<String>>);

impl SiteList {
    /// Reads the list of the site in a folder; an empty list if the folder is empty.
    /// Fails if the folder contains something else, or a site without a list.
    fn read(folder: &Path) -> Result<Self, ExportError> {
        let mut entries = match fs::read_dir(folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Self::default()),
            Err(error) => return Err(unwritten(folder, error)),
        };
        let text = match regular::read(&folder.join(LIST), MAX_LIST_BYTES) {
            Ok(text) => text,
            Err(_) if entries.next().is_none() => return Ok(Self::default()),
            Err(_) => return Err(ExportError::Occupied(folder.to_owned())),
        };
        let value: Value = serde_json::from_slice(&text).unwrap_or_default();
        if value["made by"] != MADE_BY {
            return Err(ExportError::Occupied(folder.to_owned()));
        }
        let Some(files) = value["files"].as_array() else {
            let left = OF_0_2_0.iter().map(|name| folder.join(name));
            let left: Vec<PathBuf> = left.filter(|path| path.symlink_metadata().is_ok()).collect();
            return match left.is_empty() {
                true => Ok(Self::default()),
                false => Err(ExportError::Unlisted(folder.to_owned(), left)),
            };
        };
        let mut list = SiteList::default();
        for file in files {
            // Do not trust the list: paths that no export writes are never replaced.
            if let (Some(path), Some(hash)) = (file["path"].as_str(), file["sha256"].as_str())
                && is_of_site(path)
            {
                list.add(path, hash);
            }
        }
        Ok(list)
    }

    fn add(&mut self, path: &str, sha256: &str) {
        let hashes = self.0.entry(path.to_owned()).or_default();
        hashes.insert(sha256.to_owned());
    }

    fn knows(&self, path: &str, sha256: &str) -> bool {
        self.0.get(path).is_some_and(|hashes| hashes.contains(sha256))
    }

    fn with(&self, other: &Self) -> Self {
        let mut both = self.clone();
        for (path, hashes) in &other.0 {
            hashes.iter().for_each(|hash| both.add(path, hash));
        }
        both
    }

    fn text(&self) -> String {
        let of_path = |(path, hashes): (&String, &BTreeSet<String>)| -> Vec<Value> {
            hashes.iter().map(|hash| json!({ "path": path, "sha256": hash })).collect()
        };
        let files: Vec<Value> = self.0.iter().flat_map(of_path).collect();
        json!({ "made by": MADE_BY, "version": PROGRAM_VERSION, "files": files }).to_string()
    }

    /// Refuses to overwrite the user's files: a file at one of these paths that is not from an export, or a file of
    /// `before` that the user changed.
    fn check_places(&self, folder: &Path, before: &Self) -> Result<(), ExportError> {
        let below = folder.join(FOLDER);
        let mut files = Vec::new();
        if fs::symlink_metadata(&below).is_ok_and(|metadata| !metadata.is_dir()) {
            files.push(below);
        } else {
            for path in self.0.keys() {
                let place = folder.join(path);
                let is_ours = match hash_of(&place) {
                    Err(error) => error.kind() == ErrorKind::NotFound,
                    Ok(hash) => self.knows(path, &hash) || before.knows(path, &hash),
                };
                if !is_ours {
                    files.push(place);
                }
            }
        }
        if files.is_empty() { Ok(()) } else { Err(ExportError::InTheWay(files)) }
    }

    /// Moves the files of this list from `content` into the folder, and removes the files of `before` that are not in
    /// this list. Returns those that the user changed, which it keeps.
    ///
    /// Every file except the page is named by its content. So the site is the old one until the page is replaced, which
    /// is atomic, and the new one from then on, even if this is interrupted.
    fn put(
        &self,
        content: &Path,
        folder: &Path,
        before: &Self,
    ) -> Result<Vec<PathBuf>, ExportError> {
        fs::create_dir_all(folder.join(FOLDER)).map_err(|error| unwritten(folder, error))?;
        let write_list = |list: &Self| {
            let (made, place) = (content.join(LIST), folder.join(LIST));
            fs::write(&made, list.text())
                .and_then(|()| fs::rename(&made, &place))
                .map_err(|error| unwritten(&place, error))
        };
        // Listed first: an interrupted run has already listed every file that it may have written.
        write_list(&self.with(before))?;
        let page_last = |path: &&String| *path == PAGE;
        let (page, others): (Vec<_>, Vec<_>) = self.0.keys().partition(page_last);
        for path in others.into_iter().chain(page) {
            let place = folder.join(path);
            if !hash_of(&place).is_ok_and(|hash| self.knows(path, &hash)) {
                let put = fs::rename(content.join(path), &place);
                put.map_err(|error| unwritten(&place, error))?;
            }
        }
        let mut kept = Vec::new();
        for path in before.0.keys().filter(|path| !self.0.contains_key(*path)) {
            let place = folder.join(path);
            match hash_of(&place) {
                Ok(hash) if before.knows(path, &hash) => {
                    fs::remove_file(&place).map_err(|error| unwritten(&place, error))?;
                }
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                _ => kept.push(place),
            }
        }
        write_list(self)?;
        Ok(kept)
    }
}

fn is_of_site(path: &str) -> bool {
    let plain = |c: char| c.is_ascii_digit() || c.is_ascii_lowercase();
    let is_name = |name: &str| {
        let parts = name.split_once('.');
        parts.is_some_and(|(stem, ending)| {
            !stem.is_empty() && !ending.is_empty() && (stem.to_owned() + ending).chars().all(plain)
        })
    };
    match path.split_once('/') {
        Some((folder, name)) => folder == FOLDER && is_name(name),
        None => path == PAGE,
    }
}

/// The SHA-256 of a file; an error if it is not a regular file, such as a link.
fn hash_of(path: &Path) -> io::Result<String> {
    if !fs::symlink_metadata(path)?.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    Ok(file_entry::of_reader(File::open(path)?)?.1)
}

fn unwritten(path: &Path, error: io::Error) -> ExportError {
    let path = path.to_owned();
    StagingError::Write { path, error }.into()
}

/// Writes the site into a folder: a new one, an empty one, or one with a site. In an existing site, it replaces the
/// files that the last export listed, and keeps all others. `opens` is the view that the page shows first, as in its
/// address (`r=after&v=before`). Calls `tell` after each robot. Returns the files of the last export that the user
/// changed, which it keeps too.
///
/// # Errors
/// [`ExportError`].
pub fn export(
    collection: &Collection,
    folder: &Path,
    opens: Option<&str>,
    cancellation: &Cancellation,
    tell: &mut dyn FnMut(&Shown),
) -> Result<Vec<PathBuf>, ExportError> {
    // An early check, for the message. Repeated below, when no other run can write there.
    SiteList::read(folder)?;
    let staging = Staging::begin_inside(folder, cancellation)?;
    let before = SiteList::read(staging.target())?;
    let mut site = Site { writer: Writer::new(staging.content()), list: SiteList::default() };
    let mut names = Vec::new();
    let mut page = String::new();
    for asset in ASSETS {
        let bytes = asset.bytes().map_err(ExportError::Page)?;
        match asset.name {
            PAGE => page = String::from_utf8_lossy(&bytes).into_owned(),
            name => {
                let ending = name.rsplit('.').next().unwrap_or_default();
                names.push((name, site.add(&bytes, ending)?));
            }
        }
    }
    let mut entries = Vec::new();
    for robot in collection.robots() {
        if cancellation.is_cancelled() {
            return Err(StagingError::Cancelled.into());
        }
        entries.push(one(&robot, &mut site)?);
        tell(&robot);
    }
    let robots = Value::from(entries).to_string();
    names.push(("robots.json", site.add(robots.as_bytes(), "json")?));
    site.page(&page_of(&page, &names, opens))?;
    let Site { list, .. } = site;
    list.check_places(staging.target(), &before)?;
    list.put(staging.content(), staging.target(), &before)
}

struct Site {
    writer: Writer,
    list: SiteList,
}

impl Site {
    /// Writes a file, and returns its path in the site.
    fn add(&mut self, bytes: &[u8], ending: &str) -> Result<String, ExportError> {
        let hash = hexadecimal(&Sha256::digest(bytes));
        let path = format!("{FOLDER}/{hash}.{ending}");
        self.writer.file(&path, bytes)?;
        self.list.add(&path, &hash);
        Ok(path)
    }

    fn page(&mut self, text: &str) -> Result<(), ExportError> {
        self.writer.file(PAGE, text.as_bytes())?;
        self.list.add(PAGE, &hexadecimal(&Sha256::digest(text)));
        Ok(())
    }
}

pub(super) fn unread(robot: &Shown, error: ReadError) -> ExportError {
    ExportError::Robot(robot.name.clone(), error)
}

/// Writes a robot: its files, their list, and its report.
fn one(robot: &Shown, site: &mut Site) -> Result<Value, ExportError> {
    let Published { root, report, mut entry } =
        published(robot).map_err(|error| unread(robot, error))?;
    let mut files = Vec::new();
    let listing = root.list().map_err(|error| unread(robot, error))?;
    for file in listing.entries {
        if file.kind != EntryKind::File {
            continue;
        }
        // A path that is invalid in a URDD appears in the report, but not on the site.
        match root.read(&file.path, MAX_FILE_BYTES) {
            Ok(bytes) => {
                let at = site.add(&bytes, "bin")?;
                files.push(json!({ "path": file.path, "size": bytes.len(), "at": at }));
            }
            Err(ReadError::Path(_)) => {}
            Err(error) => return Err(unread(robot, error)),
        }
    }
    let files = json!({ "name": root.folder_name(), "files": files });
    entry["files"] = json!(site.add(files.to_string().as_bytes(), "json")?);
    entry["report"] = json!(site.add(report.as_bytes(), "json")?);
    if let Some(picture) = picture_of(robot) {
        entry["picture"] = json!(site.add(&picture, "png")?);
    }
    Ok(entry)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_names_no_files_but_those_of_sites() {
        for path in ["index.html", "urdd-site/0af3.bin", "urdd-site/0.json"] {
            assert!(is_of_site(path), "{path}");
        }
        for path in [
            "",
            ".git/config",
            "CNAME",
            "urdd-site.json",
            "urdd-site/",
            "urdd-site/.bin",
            "urdd-site/..",
            "urdd-site/../CNAME",
            "urdd-site/a/b.bin",
            "/etc/passwd",
            "urdd-site/Notes.txt",
            "urdd-site/a b.txt",
        ] {
            assert!(!is_of_site(path), "{path}");
        }
    }
}
