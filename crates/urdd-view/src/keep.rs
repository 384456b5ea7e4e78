//! Saves a URDD that was generated for display into a folder of the user's choice, and shows that folder from then on.

use std::path::{Path, PathBuf, absolute};

use serde::Deserialize;
use serde_json::json;

use crate::collection::{Making, Shown};
use crate::reply::{Reply, Result, failed, refused, wish};
use crate::revision;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::staging::Staging;
use urdd_directory::take::take_content;
use urdd_directory::target_lock::TargetLock;

/// What the page sends.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Wish {
    /// The folder: absolute, relative to the home folder with `~/`, or relative to the working directory.
    folder: String,
}

/// Saves a generated URDD into a new or empty folder.
pub fn keep(robot: &Shown, body: &[u8]) -> Reply {
    let kept = wish(body, "the name of a folder").and_then(|Wish { folder }| kept(robot, &folder));
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

/// Resolves the path that the user entered.
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
