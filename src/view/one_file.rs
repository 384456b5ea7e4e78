//! The page and one robot in a single HTML file, which opens from the disk.

use std::fs::File;
use std::io::{self, Cursor, Read, Write};
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
use sha2::{Digest, Sha256};
use zip::write::{SimpleFileOptions, ZipWriter};

use super::assets;
use super::collection::Shown;
use super::export::ExportError;
use super::route;
use crate::directory::root::{EntryKind, ReadError};

/// Most bytes of a robot that is put into a page.
const MAX_ROBOT_BYTES: u64 = 100_000_000;

/// By this a file is known as one that holds such a page. It stands near its beginning.
const MARK: &str = "<meta name=\"urdd-mode\" content=\"inline\" />";
/// Most bytes before the mark.
const MAX_HEAD_BYTES: u64 = 1 << 16;

/// Whether a page may be written to a path: no file is there, or it is empty or holds such a page.
pub fn may_hold_page(file: &Path) -> bool {
    if !file.is_file() {
        return true;
    }
    let mut head = Vec::new();
    let read = File::open(file).and_then(|open| open.take(MAX_HEAD_BYTES).read_to_end(&mut head));
    read.is_ok() && (head.is_empty() || String::from_utf8_lossy(&head).contains(MARK))
}

/// The page with a robot in it, as HTML.
///
/// # Errors
/// [`ExportError`]; [`ExportError::TooLarge`] for a robot that a page cannot hold.
pub fn page_with(robot: &Shown) -> Result<String, ExportError> {
    let asset = |name: &str| {
        let found = assets::find(name).map_or_else(|| Ok(Vec::new()), assets::Asset::bytes);
        found.map_err(ExportError::Page)
    };
    let text = |name: &str| {
        let text = String::from_utf8(asset(name)?).map_err(io::Error::other);
        text.map_err(ExportError::Page)
    };
    let (index, script, style) = (text("index.html")?, text("app.js")?, text("style.css")?);
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
    let policy = format!(
        "default-src 'none'; script-src {} 'wasm-unsafe-eval'; style-src {}; connect-src blob: data:; \
         img-src blob: data:; worker-src blob:; base-uri 'none'; form-action 'none'",
        hash(&script),
        hash(&style),
    );
    let report = route::report_of(robot);
    let mut entry = route::entry_with(robot, &report);
    // Nobody writes to a file that is opened from the disk.
    entry["writable"] = Value::from(false);
    entry["temporary"] = Value::from(false);
    let mut carried = String::new();
    for (id, bytes) in [
        (
            "robots.json",
            Value::from(vec![entry]).to_string().into_bytes(),
        ),
        ("report.json", report.into_bytes()),
        ("robot.zip", archive(robot)?),
        ("worker.js", asset("worker.js")?),
        ("urdd.wasm", asset("urdd.wasm")?),
    ] {
        let text = STANDARD.encode(bytes);
        carried.push_str(&format!(
            "<script type=\"text/plain\" id=\"{id}\">{text}</script>\n"
        ));
    }
    let mut page = String::new();
    for line in index.lines() {
        let of_page = line.trim_start();
        if of_page.starts_with("<meta name=\"urdd-mode\"") {
            page.push_str(MARK);
        } else if of_page.starts_with("<meta http-equiv=\"Content-Security-Policy\"") {
            page.push_str("<meta http-equiv=\"Content-Security-Policy\" content=\"");
            page.push_str(&policy);
            page.push_str("\" />");
        } else if of_page.starts_with("<link rel=\"stylesheet\"") {
            page.push_str("<style>");
            page.push_str(&style);
            page.push_str("</style>");
        } else if of_page.starts_with("<script src=") {
            continue;
        } else if of_page.starts_with("</body>") {
            page.push_str(&carried);
            page.push_str("<script>");
            page.push_str(&script);
            page.push_str("</script>\n</body>");
        } else {
            page.push_str(line);
        }
        page.push('\n');
    }
    Ok(page)
}

/// The robot's files, compressed.
fn archive(robot: &Shown) -> Result<Vec<u8>, ExportError> {
    let unread = |error: ReadError| ExportError::Robot {
        robot: robot.name.clone(),
        error,
    };
    let root = robot.open().map_err(unread)?;
    let listing = root.list().map_err(unread)?;
    let files: Vec<_> = listing
        .entries
        .iter()
        .filter(|entry| entry.kind == EntryKind::File && entry.utf8)
        .collect();
    let size: u64 = files.iter().map(|entry| entry.size).sum();
    if size > MAX_ROBOT_BYTES {
        return Err(ExportError::TooLarge {
            robot: robot.name.clone(),
            size,
        });
    }
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    let failed = |error: zip::result::ZipError| ExportError::Page(io::Error::other(error));
    for entry in files {
        match root.read(&entry.path, MAX_ROBOT_BYTES) {
            Ok(bytes) => {
                zip.start_file(entry.path.as_str(), options)
                    .map_err(failed)?;
                zip.write_all(&bytes).map_err(ExportError::Page)?;
            }
            Err(ReadError::Path(_)) => {}
            Err(error) => return Err(unread(error)),
        }
    }
    Ok(zip.finish().map_err(failed)?.into_inner())
}
