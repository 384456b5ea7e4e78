//! Saves the user's skip edits and the resulting matrices, with their sizes and hashes, atomically. Also undoes saves.

use serde::Deserialize;
use serde_json::{Value, json};

use crate::collection::Shown;
use crate::reply::Reply;
use crate::revision;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::replacement::{Files, Replacement};
use urdd_directory::root::Root;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
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
    /// The edits to write.
    edits: Option<Vec<SkipEdit>>,
    /// The skipped reasons to write; without them, the existing ones remain.
    skipped_reasons: Option<Vec<SkippedReason>>,
    /// Whether to undo the last save instead.
    #[serde(default)]
    undo: bool,
}

/// Saves skips, or undoes the last save.
pub fn skips(robot: &Shown, body: &[u8]) -> Reply {
    let wish: Wish = match serde_json::from_slice(body) {
        Ok(wish) => wish,
        Err(error) => return Reply::failure(400, format!("not a list of edits: {error}\n")),
    };
    if !robot.is_writable() {
        let why = "this URDD cannot be written: it is an archive, or was made for this view\n";
        return Reply::failure(403, why);
    }
    match save(robot, wish) {
        Ok(value) => Reply::json(&value),
        Err((status, message)) => Reply::failure(status, format!("{message}\n")),
    }
}

/// An HTTP status, and the reason.
pub(super) type Failure = (u16, String);

fn save(robot: &Shown, wish: Wish) -> Result<Value, Failure> {
    let failed = |error: &dyn std::fmt::Display| (500, error.to_string());
    let path = robot.path();
    // From here on, no other process of this program writes there.
    let replacement = Replacement::begin(&path).map_err(|error| failed(&error))?;
    let unchanged = |is_same: bool| match is_same {
        true => Ok(()),
        false => Err((
            409,
            "the files changed on disk since the page read them; nothing was written".to_owned(),
        )),
    };
    unchanged(revision::of(&path) == wish.revision)?;
    // The new content hard-links the unchanged files, which by itself changes their full revision.
    let content = revision::of_content(&path);
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
    let root = Root::open_folder(&path).map_err(|error| failed(&error))?;
    let before: Result<Files, Failure> = files
        .keys()
        .map(|path| {
            let bytes = root.read(path, MAX_DOCUMENT_BYTES);
            Ok((path.clone(), bytes.map_err(|error| failed(&error))?))
        })
        .collect();
    let before = before?;
    replacement.stage(&files).map_err(|error| failed(&error))?;
    unchanged(revision::of_content(&path) == content)?;
    replacement.commit().map_err(|error| failed(&error))?;
    let now = revision::of(&path);
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

/// The files that change.
fn made(
    robot: &Shown,
    edits: Vec<SkipEdit>,
    reasons: Option<Vec<SkippedReason>>,
) -> Result<Files, Failure> {
    if edits.len() > MAX_EDITS {
        return Err((400, "too many edits".to_owned()));
    }
    if edits
        .iter()
        .any(|edit| edit.reason.chars().count() > MAX_REASON)
    {
        return Err((400, "a reason is too long".to_owned()));
    }
    let opened = Robot::open(robot.path()).map_err(|error| (500, error.to_string()))?;
    let edited = opened.with_skip_edits(edits, reasons);
    Ok(edited.map_err(|error| (400, error.to_string()))?.files)
}
