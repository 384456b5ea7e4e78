//! Exports the page and robots as a static site for any web server.
//!
//! A site is `index.html`, a list of its files, and a folder of files named by the SHA-256 of their content. File names
//! of a URDD do not become file names of the site. So no name is too long for a file system or collides with another,
//! and no extension makes a server declare a page or a program. Browsers do not execute `.bin` files.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::assets::{self, ASSETS};
use crate::collection::{Collection, Shown};
use crate::report;
use crate::route;
use crate::site_list::{ExportError, FOLDER, PAGE, SiteList};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::limits::MAX_FILE_BYTES;
use urdd_directory::root::{EntryKind, ReadError, Root};
use urdd_directory::staging::{Staging, StagingError};
use urdd_directory::writer::Writer;
use urdd_format::hexadecimal::hexadecimal;

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
    site.page(&assets::page_of(&page, &names, opens))?;
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

/// A robot as published: the URDD's own files, and the validator's report on them.
pub(super) struct Published {
    pub root: Root,
    pub report: String,
    pub entry: Value,
}

/// Collects what is published of a robot.
pub(super) fn published(robot: &Shown) -> Result<Published, ExportError> {
    let root = robot.open().map_err(|error| unread(robot, error))?.1.own;
    let report = report::report_on(&root, &robot.name)
        .unwrap_or_else(|error| json!({ "error": error }).to_string());
    let mut entry = route::entry_with(robot, &report);
    // A site is read-only, and notes name files of this machine.
    entry["writable"] = json!(false);
    entry["temporary"] = json!(false);
    entry["notes"] = json!([]);
    Ok(Published { root, report, entry })
}

pub(super) fn unread(robot: &Shown, error: ReadError) -> ExportError {
    ExportError::Robot(robot.name.clone(), error)
}

/// Writes a robot: its files, their list, and its report.
fn one(robot: &Shown, site: &mut Site) -> Result<Value, ExportError> {
    let Published { root, report, mut entry } = published(robot)?;
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
    if let Some(picture) = route::picture_of(robot) {
        entry["picture"] = json!(site.add(&picture, "png")?);
    }
    Ok(entry)
}
