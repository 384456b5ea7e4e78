//! Mutations of whole files: missing, exchanged, corrupted.

use std::collections::BTreeMap;

use serde_json::json;

use super::dice::Dice;
use super::edit::Edit;
use super::file_bytes::Damage;
use super::meaning;
use super::mutation::{Change, FileChange, Files, MakeFiles, Mutation, shortened};
use super::original::Original;
use super::plan::Plan;
use super::sample;
use urdd_directory::discover::ROOT_METADATA;

/// Invalid versions of a module.
const OTHER_VERSIONS: [&str; 5] = ["0.0.1", "2.0.0", "1.0", "v1.0.0", "1.0.0\n\n"];

/// Versions that are valid if `VERSION` and the root metadata agree (SPEC 4.2).
const NEWER_VERSIONS: [&str; 2] = ["1.0.1", "1.1.0"];

/// Mutations of files, one list per kind of file and module.
pub(crate) fn mutations(original: &Original, plan: &Plan) -> Vec<Vec<Mutation>> {
    let mut groups: BTreeMap<(&str, String), Vec<&String>> = BTreeMap::new();
    for path in original.files.keys() {
        let Some((module, folder)) = original.module_of(path) else {
            continue;
        };
        groups.entry((module, kind_of(&path[folder.len() + 1..]))).or_default().push(path);
    }
    let root = [ROOT_METADATA.to_owned()];
    groups.insert((ROOT_METADATA, ROOT_METADATA.to_owned()), root.iter().collect());
    let mut lists = Vec::new();
    for ((module, field), paths) in &groups {
        let mut dice = Dice::new(plan.seed, &format!("{module} {field}"));
        lists.push(sample::draw(plan, paths.len(), &mut dice, |index, dice| {
            of_file(original, module, field, paths, index, dice)
        }));
    }
    lists
}

/// Kind of a file in a module's folder: its name, or the format for a mesh.
fn kind_of(path: &str) -> String {
    match (path.contains('/'), path.rsplit_once('.')) {
        (true, Some((_, extension))) => format!("*.{}", extension.to_ascii_lowercase()),
        _ => path.to_owned(),
    }
}

fn of_file(
    original: &Original,
    module: &str,
    field: &str,
    paths: &[&String],
    index: usize,
    dice: &mut Dice,
) -> Vec<Mutation> {
    let path = paths[index];
    let mutation =
        |kind: &'static str, change: Change| Mutation::of_file(module, path, field, kind, change);
    let mut out = Vec::new();
    for (kind, damage) in Damage::each(dice) {
        out.push(mutation(kind, Change::Files(damaged(path, damage))));
    }
    if path == ROOT_METADATA {
        return out;
    }
    for (kind, listed) in [("missing", true), ("missing, and not listed", false)] {
        // The mirror is optional (SPEC 2.4: SHOULD).
        if !listed && path.ends_with("/module.yaml") {
            continue;
        }
        let path = path.clone();
        out.push(mutation(
            kind,
            Change::Files(Box::new(move |_| {
                Some(FileChange {
                    files: Files::from([(path.clone(), None)]),
                    unlisted: if listed { vec![] } else { vec![path.clone()] },
                    from: "a file".to_owned(),
                    to: "none".to_owned(),
                })
            })),
        ));
    }
    if paths.len() > 1 {
        let other = paths[(index + 1 + dice.below(paths.len() - 1)) % paths.len()];
        for (kind, both) in [("exchanged with another", true), ("another instead of it", false)] {
            out.push(mutation(kind, Change::Files(exchanged(path, other, both))));
        }
    }
    if path.ends_with("/VERSION") {
        for version in OTHER_VERSIONS {
            out.extend(versions(original, path, version, true, &mutation));
        }
        for version in NEWER_VERSIONS {
            out.extend(versions(original, path, version, false, &mutation));
        }
    }
    out
}

fn damaged(path: &str, damage: Damage) -> MakeFiles {
    let path = path.to_owned();
    Box::new(move |original| {
        let bytes = original.files.get(&path)?;
        let (after, to) = damage.of(bytes)?;
        (!meaning::is_same(original, &path, &after)).then(|| {
            let files = Files::from([(path.clone(), Some(after))]);
            FileChange::new(files, format!("{} bytes", bytes.len()), to)
        })
    })
}

fn exchanged(path: &str, other: &str, both: bool) -> MakeFiles {
    let (path, other) = (path.to_owned(), other.to_owned());
    Box::new(move |original| {
        let (a, b) = (original.files.get(&path)?, original.files.get(&other)?);
        if meaning::is_same(original, &path, b) {
            return None;
        }
        let mut files = Files::from([(path.clone(), Some(b.clone()))]);
        if both {
            files.insert(other.clone(), Some(a.clone()));
        }
        Some(FileChange::new(files, &path, &other))
    })
}

/// Another version in `VERSION` only, or also in the root metadata.
fn versions(
    original: &Original,
    path: &str,
    version: &'static str,
    in_both: bool,
    mutation: &dyn Fn(&'static str, Change) -> Mutation,
) -> Vec<Mutation> {
    let folder = path.trim_end_matches("/VERSION");
    let modules = original.metadata()["modules"].as_array();
    let entry = modules.into_iter().flatten().position(|entry| entry["path"] == folder);
    let write = |path: String| -> MakeFiles {
        Box::new(move |original| {
            let before = String::from_utf8_lossy(original.files.get(&path)?).into_owned();
            let files = Files::from([(path.clone(), Some(version.into()))]);
            let to = shortened(&format!("{version:?}"));
            Some(FileChange::new(files, format!("{before:?}"), to))
        })
    };
    let mut out = vec![mutation("another version", Change::Files(write(path.to_owned())))];
    if let Some(entry) = entry.filter(|_| in_both) {
        let place = format!("/modules/{entry}/version");
        let edits = vec![Edit::Set(place, json!(version))];
        let change = Change::FilesAndMetadata(write(path.to_owned()), edits);
        out.push(mutation("another version, in the root metadata too", change));
    }
    out
}
