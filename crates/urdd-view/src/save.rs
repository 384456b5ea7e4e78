//! Saves what a user decided in the page, with sizes and hashes, atomically: edits of skips and the resulting matrices, and
//! named configurations; and a URDD that was generated for display, into a folder. Also undoes saves of skips, and takes
//! configurations that a program sends.

use std::path::{Path, PathBuf, absolute};

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use crate::http::{Reply, Result, failed, refused, wish};
use crate::revision;
use crate::shown::{Making, Shown};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::metadata::{Files, Replacement};
use urdd_directory::root::Root;
use urdd_directory::staging::Staging;
use urdd_directory::take::take_content;
use urdd_directory::target_lock::TargetLock;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_robot::Robot;

/// Maximum number of edits, and of characters in a reason.
const MAX_EDITS: usize = 1_000_000;
const MAX_REASON: usize = 10_000;
/// Maximum number of saves that can be undone.
const MAX_UNDONE: usize = 100;

/// What the page sends.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Wish {
    /// The revision that the page displayed.
    revision: String,
    edits: Option<Vec<SkipEdit>>,
    /// The skipped reasons to write; without them, the existing ones remain.
    skipped_reasons: Option<Vec<SkippedReason>>,
    #[serde(default)]
    undo: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Pose {
    /// The revision that the page displayed.
    revision: String,
    name: String,
    /// One value for each DOF, rad or m.
    configuration: Vec<f64>,
    /// Whether another configuration of this name is replaced.
    #[serde(default)]
    replace: bool,
}

/// Saves skips, or undoes the last save.
pub fn skips(robot: &Shown, body: &[u8]) -> Reply {
    answered(robot, body, "a list of edits", save_skips)
}

pub fn configuration(robot: &Shown, body: &[u8]) -> Reply {
    answered(robot, body, "a named configuration", save_configuration)
}

fn answered<T: DeserializeOwned>(
    robot: &Shown,
    body: &[u8],
    what: &str,
    save: impl Fn(&Shown, T) -> Result<Value>,
) -> Reply {
    Reply::of(wish(body, what).and_then(|wish| match robot.is_writable() {
        true => save(robot, wish),
        false => {
            refused(403, "this URDD cannot be written: it is an archive, or was made for this view")
        }
    }))
}

fn save_skips(robot: &Shown, wish: Wish) -> Result<Value> {
    let mut undo = robot.undo.lock();
    let (now, before) = write(robot, &wish.revision, || match wish.undo {
        true => {
            let last = undo.last().filter(|(after, _)| *after == wish.revision);
            let nothing = || refused(409, "there is nothing to undo");
            last.map_or_else(nothing, |(_, files)| Ok(files.clone()))
        }
        false => made(robot, wish.edits.unwrap_or_default(), wish.skipped_reasons),
    })?;
    match wish.undo {
        true => {
            undo.pop();
            // The previous save is the last one again.
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

fn save_configuration(robot: &Shown, wish: Pose) -> Result<Value> {
    let mut undo = robot.undo.lock();
    let (now, _) = write(robot, &wish.revision, || named(robot, &wish))?;
    // Earlier saves cannot be undone past this one, which may have added a file.
    undo.clear();
    Ok(json!({ "revision": now, "undo": 0 }))
}

/// Writes files atomically, unless those on disk changed since the page read them. Returns the revision after it, and the
/// files that were there before.
fn write(
    robot: &Shown,
    expected: &str,
    made: impl FnOnce() -> Result<Files>,
) -> Result<(String, Files)> {
    let path = robot.path();
    // From here on, no other process of this program writes there.
    let replacement = Replacement::begin(&path).map_err(failed(500))?;
    let unchanged = |is_same: bool| match is_same {
        true => Ok(()),
        false => {
            refused(409, "the files changed on disk since the page read them; nothing was written")
        }
    };
    unchanged(revision::of(&path) == expected)?;
    // The new content hard-links the unchanged files, which by itself changes their full revision.
    let content = revision::of_content(&path);
    let files = made()?;
    let root = Root::open_folder(&path).map_err(failed(500))?;
    let mut before = Files::new();
    for name in files.keys().filter(|name| path.join(name).exists()) {
        let bytes = root.read(name, MAX_DOCUMENT_BYTES);
        before.insert(name.clone(), bytes.map_err(failed(500))?);
    }
    replacement.stage(&files).map_err(failed(500))?;
    unchanged(revision::of_content(&path) == content)?;
    replacement.commit().map_err(failed(500))?;
    Ok((revision::of(&path), before))
}

/// The files with one more named configuration.
fn named(robot: &Shown, wish: &Pose) -> Result<Files> {
    let opened = Robot::open(robot.path()).map_err(failed(500))?;
    let name = ConfigurationName::new(&wish.name);
    let Some(name) = name.filter(|_| wish.name.chars().count() <= MAX_REASON) else {
        return refused(400, "a configuration needs a name of at most 10,000 characters");
    };
    let dofs = opened.dof_names().map_err(failed(400))?;
    if dofs.len() != wish.configuration.len() {
        return refused(400, "a configuration has one value for each DOF");
    }
    let positions = dofs.iter().zip(&wish.configuration);
    let positions =
        positions.map(|(dof, position)| DofPosition { dof_name: dof.clone(), position: *position });
    let edit = ConfigurationEdit { name, positions: positions.collect() };
    let there = opened.named_configurations().map_err(failed(400))?;
    let mut edits: Vec<ConfigurationEdit> = there.iter().map(Into::into).collect();
    match edits.iter_mut().find(|other| other.name == edit.name) {
        Some(_) if !wish.replace => {
            return refused(409, "there is another configuration of this name");
        }
        Some(there) => *there = edit,
        None => edits.push(edit),
    }
    let edited = opened.with_named_configurations(&edits);
    edited.map(|edited| edited.files).map_err(failed(400))
}

fn made(robot: &Shown, edits: Vec<SkipEdit>, reasons: Option<Vec<SkippedReason>>) -> Result<Files> {
    if edits.len() > MAX_EDITS {
        return refused(400, "too many edits");
    }
    if edits.iter().any(|edit| edit.reason.chars().count() > MAX_REASON) {
        return refused(400, "a reason is too long");
    }
    let opened = Robot::open(robot.path()).map_err(failed(500))?;
    let edited = opened.with_skip_edits(edits, reasons);
    edited.map(|edited| edited.files).map_err(failed(400))
}

/// The most values of a configuration of a robot that is not generated yet.
const MAX_VALUES: usize = 100_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sent {
    q: Vec<f64>,
}

/// Takes a configuration for a robot from a request.
pub fn state(robot: &Shown, body: &[u8]) -> Reply {
    let Ok(Sent { q }) = wish(body, "a configuration") else {
        return Reply::failure(400, "expected {\"q\": [...]}, a number for each DOF\n");
    };
    // Of one that is not generated yet, nothing is known.
    let dofs = robot.open().ok().and_then(|(_, opened)| Some(opened.robot.dof_names().ok()?.len()));
    match dofs {
        Some(dofs) if dofs != q.len() => {
            let found = q.len();
            let why = format!("expected one value for each DOF, so {dofs}; found {found}\n");
            Reply::failure(400, why)
        }
        None if q.len() > MAX_VALUES => Reply::failure(400, "too many values\n"),
        _ => {
            robot.states.set(&q);
            Reply::nothing()
        }
    }
}

/// Where the page wants a generated URDD.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Place {
    /// The folder: absolute, relative to the home folder with `~/`, or relative to the working directory.
    folder: String,
}

/// Saves a generated URDD into a new or empty folder.
pub fn keep(robot: &Shown, body: &[u8]) -> Reply {
    let kept = wish(body, "the name of a folder").and_then(|Place { folder }| kept(robot, &folder));
    Reply::of(kept.map(|folder| {
        let revision = revision::of(&folder);
        json!({ "folder": folder.display().to_string(), "revision": revision })
    }))
}

fn kept(robot: &Shown, folder: &str) -> Result<PathBuf> {
    if !robot.is_temporary() {
        return refused(403, "this URDD is already in a folder");
    }
    // While this is locked, no run replaces what is copied.
    let path = robot.path();
    let lock = TargetLock::at_once(&path).map_err(failed(500))?;
    if lock.is_none() || robot.making() != Making::Done || robot.path() != path {
        return refused(409, "this robot is still being generated; save it when it is complete");
    }
    let target = resolved(folder)?;
    free(&target)?;
    let staging = Staging::begin(&target, &Cancellation::default()).map_err(failed(403))?;
    // Another run may have written there while this one waited.
    free(&target)?;
    take_content(&path, staging.content(), &|_| false).map_err(failed(500))?;
    let place = staging.target().to_owned();
    staging.commit().map_err(failed(500))?;
    robot.keep_at(place.clone());
    Ok(place)
}

fn resolved(folder: &str) -> Result<PathBuf> {
    let said = folder.trim();
    if said.is_empty() || said.contains('\0') {
        return refused(400, "give a folder");
    }
    let path = match said.strip_prefix("~/") {
        Some(rest) => std::env::home_dir()
            .ok_or_else(|| (400, "the home folder is unknown: write the full path".to_owned()))?
            .join(rest),
        None => PathBuf::from(said),
    };
    absolute(&path).map_err(|error| (400, format!("{said}: {error}")))
}

/// Checks that nothing would be overwritten.
fn free(target: &Path) -> Result<()> {
    let shown = target.display();
    let metadata = match std::fs::symlink_metadata(target) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return refused(403, format!("{shown}: {error}")),
    };
    if !metadata.is_dir() {
        return refused(403, format!("{shown}: a file of that name exists; nothing was saved"));
    }
    let entries = std::fs::read_dir(target).map_err(|error| (403, format!("{shown}: {error}")))?;
    if entries.count() == 0 {
        return Ok(());
    }
    let what = match target.join(ROOT_METADATA).is_file() {
        true => "this folder has a URDD already; `urdd generate` into it keeps its edits",
        false => "this folder is not empty",
    };
    refused(409, format!("{shown}: {what}. Nothing was saved; give another folder"))
}
