//! Saving the skips that a person decided: the edits and the matrices that follow, with their sizes and hashes, in one
//! step; and undoing it.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::collection::Shown;
use super::reply::Reply;
use super::revision;
use crate::directory::cancellation::Cancellation;
use crate::directory::canonical;
use crate::directory::discover::ROOT_METADATA;
use crate::directory::json;
use crate::directory::limits::MAX_DOCUMENT_BYTES;
use crate::directory::root::Root;
use crate::directory::staging::Staging;
use crate::directory::writer::Writer;
use crate::document::load::Loaded;
use crate::document::urdd::Urdd;
use crate::format::hexadecimal::hexadecimal;
use crate::format::link_shapes_skips::{SkipEdit, SkippedReason};
use crate::format::registry::{ModuleDocument, ModuleKind};
use crate::skips::skips_module;

const SKIPS: ModuleKind = ModuleKind::LinkShapesSkips;
/// Most edits, and most characters of a reason.
const MAX_EDITS: usize = 1_000_000;
const MAX_REASON: usize = 10_000;
/// Saves that can be undone.
const MAX_UNDONE: usize = 100;

/// Files by path, as they are to be written.
pub(super) type Files = BTreeMap<String, Vec<u8>>;

/// What the page sends.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Wish {
    /// The revision that the page saw.
    revision: String,
    /// What is to be written.
    edits: Option<Vec<SkipEdit>>,
    /// Without them those that are there.
    skipped_reasons: Option<Vec<SkippedReason>>,
    /// Whether the last save is to be undone instead.
    #[serde(default)]
    undo: bool,
}

/// Saves skips, or undoes the last save.
pub fn skips(robot: &Shown, body: &[u8]) -> Reply {
    let wish: Wish = match serde_json::from_slice(body) {
        Ok(wish) => wish,
        Err(error) => return Reply::failure(400, format!("this is no list of edits: {error}\n")),
    };
    if !robot.writable {
        let why = "this URDD cannot be written: it is an archive, or was made for this view\n";
        return Reply::failure(403, why);
    }
    match save(robot, wish) {
        Ok(value) => Reply::json(&value),
        Err((status, message)) => Reply::failure(status, format!("{message}\n")),
    }
}

type Failure = (u16, String);

fn save(robot: &Shown, wish: Wish) -> Result<Value, Failure> {
    let failed = |error: &dyn std::fmt::Display| (500, error.to_string());
    // From here on no other run of this program writes there.
    let staging =
        Staging::begin(&robot.path, &Cancellation::default()).map_err(|error| failed(&error))?;
    let unchanged = || match revision::of(&robot.path) == wish.revision {
        true => Ok(()),
        false => Err((
            409,
            "the files changed on disk since the page read them; nothing was written".to_owned(),
        )),
    };
    unchanged()?;
    let mut undo = robot
        .undo
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    let files = match wish.undo {
        true => {
            let last = undo.last().filter(|(after, _)| *after == wish.revision);
            let Some((_, files)) = last else {
                return Err((409, "there is nothing to undo".to_owned()));
            };
            files.clone()
        }
        false => made(robot, wish.edits.unwrap_or_default(), wish.skipped_reasons)?,
    };
    let root = Root::open_folder(&robot.path).map_err(|error| failed(&error))?;
    let before: Result<Files, Failure> = files
        .keys()
        .map(|path| {
            let bytes = root.read(path, MAX_DOCUMENT_BYTES);
            Ok((path.clone(), bytes.map_err(|error| failed(&error))?))
        })
        .collect();
    let before = before?;
    let writer = Writer::new(staging.content());
    take_over(&robot.path, Path::new(""), &files, &staging, &writer)?;
    for (path, bytes) in &files {
        writer.file(path, bytes).map_err(|error| failed(&error))?;
    }
    unchanged()?;
    staging.commit().map_err(|error| failed(&error))?;
    let now = revision::of(&robot.path);
    match wish.undo {
        true => {
            undo.pop();
            // What came before is the last save again.
            if let Some((after, _)) = undo.last_mut() {
                after.clone_from(&now);
            }
        }
        false => {
            undo.push((now.clone(), before));
            if undo.len() > MAX_UNDONE {
                undo.remove(0);
            }
        }
    }
    Ok(json!({ "revision": now, "undo": undo.len() }))
}

/// Every file and link that stays, into the new content.
fn take_over(
    root: &Path,
    below: &Path,
    instead: &Files,
    staging: &Staging,
    writer: &Writer,
) -> Result<(), Failure> {
    let failed = |error: std::io::Error| (500, format!("{}: {error}", below.display()));
    for entry in fs::read_dir(root.join(below)).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let path = below.join(entry.file_name());
        let kind = entry.file_type().map_err(failed)?;
        if kind.is_dir() {
            fs::create_dir_all(staging.content().join(&path)).map_err(failed)?;
            take_over(root, &path, instead, staging, writer)?;
            continue;
        }
        let Some(name) = path.to_str() else {
            let shown = path.display();
            return Err((500, format!("{shown}: a name that is not UTF-8 cannot be kept")));
        };
        let name = name.replace('\\', "/");
        if instead.contains_key(&name) {
            continue;
        }
        if kind.is_symlink() {
            link(&entry.path(), &staging.content().join(&path)).map_err(failed)?;
        } else {
            writer
                .keep(&entry.path(), &name)
                .map_err(|error| (500, error.to_string()))?;
        }
    }
    Ok(())
}

#[cfg(unix)]
fn link(from: &Path, to: &Path) -> std::io::Result<()> {
    std::os::unix::fs::symlink(fs::read_link(from)?, to)
}

#[cfg(not(unix))]
fn link(_: &Path, _: &Path) -> std::io::Result<()> {
    Err(std::io::Error::other("symbolic links cannot be kept here"))
}

/// The module's two files, and `urdd.json` with their sizes and hashes.
fn made(
    robot: &Shown,
    edits: Vec<SkipEdit>,
    reasons: Option<Vec<SkippedReason>>,
) -> Result<Files, Failure> {
    let refused = |message: &str| (400, message.to_owned());
    let root = robot.open().map_err(|error| (500, error.to_string()))?;
    let kinds = [ModuleKind::Urdf, ModuleKind::LinkShapesSimpleSkips, SKIPS];
    let loaded = Loaded::read_only(root.clone(), &kinds);
    let part = Urdd::new(loaded.map_err(|error| (500, error.to_string()))?.into());
    let (simple, now) = match (part.document(kinds[1]), part.document(SKIPS)) {
        (
            Some(ModuleDocument::LinkShapesSimpleSkips(simple)),
            Some(ModuleDocument::LinkShapesSkips(now)),
        ) => (simple, now),
        _ => {
            let why = "link_shapes_simple_skips_module or link_shapes_skips_module of version 1 is missing or cannot be read: \
                `urdd generate` makes them";
            return Err(refused(why));
        }
    };
    let described = part.robot().ok_or_else(|| refused("urdf_module cannot be read"))?;
    let names: Vec<&str> = described.links.iter().map(|link| link.name.as_str()).collect();
    if edits.len() > MAX_EDITS {
        return Err(refused("these are too many edits"));
    }
    for edit in &edits {
        for link in [&edit.link_a, &edit.link_b] {
            if described.link(link).is_none() {
                let link = link.escape_debug();
                return Err((400, format!("there is no link `{link}`")));
            }
        }
        if edit.reason.chars().count() > MAX_REASON {
            return Err(refused("a reason is too long"));
        }
    }
    let reasons = reasons.unwrap_or_else(|| now.skipped_reasons.clone());
    let module = skips_module(simple, reasons, edits, &names);
    let document = serde_json::to_value(&module).map_err(|error| (500, error.to_string()))?;
    let folder = SKIPS.folder();
    let mut files = Files::from([
        (
            format!("{folder}/module.json"),
            canonical::json_string(&document).into_bytes(),
        ),
        (
            format!("{folder}/module.yaml"),
            canonical::yaml_string(&document).into_bytes(),
        ),
    ]);
    let metadata = root
        .read(ROOT_METADATA, MAX_DOCUMENT_BYTES)
        .map_err(|error| (500, format!("{ROOT_METADATA}: {error}")))?;
    let mut metadata = json::read(&metadata)
        .map_err(|error| (500, format!("{ROOT_METADATA}: {error}")))?
        .value;
    let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
    for module in modules.into_iter().flatten() {
        let listed = module.get_mut("files").and_then(Value::as_array_mut);
        for entry in listed.into_iter().flatten() {
            let bytes = entry["path"].as_str().and_then(|path| files.get(path));
            if let Some(bytes) = bytes {
                let (size, hash) = (bytes.len(), hexadecimal(&Sha256::digest(bytes)));
                entry["size"] = json!(size);
                entry["sha256"] = json!(hash);
            }
        }
    }
    let text = canonical::json_string(&metadata).into_bytes();
    files.insert(ROOT_METADATA.to_owned(), text);
    Ok(files)
}
