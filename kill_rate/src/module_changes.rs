//! Mutations of whole modules: removed, or replaced by another robot's.

use super::edit::Edit;
use super::mutation::{Change, FileChange, Files, Mutation};
use super::original::Original;
use urdd_format::registry::ModuleKind;

/// Number of other robots whose modules replace a module.
const OTHERS: usize = 2;

/// Mutations of whole modules, one list per module.
pub(crate) fn mutations(original: &Original, others: &[&Original]) -> Vec<Vec<Mutation>> {
    let of = |(name, folder): &(&'static str, &'static str)| {
        // A module that no class requires is optional.
        let needed =
            ModuleKind::ALL.iter().any(|kind| kind.name() == *name && kind.class().is_some());
        let mut list: Vec<Mutation> =
            needed.then(|| gone(original, name, folder)).into_iter().collect();
        let others = others.iter().filter(|other| other.modules.contains(&(name, folder)));
        list.extend(
            others.take(OTHERS).filter_map(|other| replaced(original, other, name, folder)),
        );
        list
    };
    original.modules.iter().map(of).collect()
}

fn gone(original: &Original, name: &str, folder: &str) -> Mutation {
    let files: Vec<String> = below(original, folder).map(|(path, _)| path.clone()).collect();
    let mut entries = entries(original).to_vec();
    entries.retain(|entry| entry["path"] != folder);
    let make = move |_: &Original| {
        let files = files.iter().map(|path| (path.clone(), None)).collect();
        Some(FileChange::new(files, "a module", "none"))
    };
    let edits = vec![Edit::Set("/modules".to_owned(), entries.into())];
    mutation(name, folder, "a module left out", Change::FilesAndMetadata(Box::new(make), edits))
}

fn replaced(original: &Original, other: &Original, name: &str, folder: &str) -> Option<Mutation> {
    let at = |of: &Original| entries(of).iter().position(|entry| entry["path"] == folder);
    let (here, there) = (at(original)?, at(other)?);
    let mut files: Files = below(original, folder).map(|(path, _)| (path.clone(), None)).collect();
    for (path, bytes) in below(other, folder) {
        files.insert(path.clone(), Some(bytes.clone()));
    }
    let from = original.metadata()["robot_name"].to_string();
    let to = other.metadata()["robot_name"].to_string();
    let differs = files.iter().any(|(path, bytes)| original.files.get(path) != bytes.as_ref());
    let make = move |_: &Original| differs.then(|| FileChange::new(files.clone(), &from, &to));
    let place = format!("/modules/{here}");
    let edits = vec![Edit::Set(place, entries(other)[there].clone())];
    let change = Change::FilesAndMetadata(Box::new(make), edits);
    Some(mutation(name, folder, "another robot's module", change))
}

fn below<'a>(
    original: &'a Original,
    folder: &'a str,
) -> impl Iterator<Item = (&'a String, &'a Vec<u8>)> {
    let inside =
        move |path: &str| path.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/'));
    original.files.iter().filter(move |(path, _)| inside(path))
}

fn entries(original: &Original) -> &[serde_json::Value] {
    let modules = original.metadata()["modules"].as_array();
    modules.map_or(&[], Vec::as_slice)
}

fn mutation(name: &str, folder: &str, kind: &'static str, change: Change) -> Mutation {
    Mutation::of_file(name, folder, "the module", kind, change)
}
