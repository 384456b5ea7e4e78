//! Which USDs of a folder are robots: those with bodies that no other one is composed of.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::account::Account;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_usd::{Door, outline};

use super::files::Files;

/// One file, and what may be made of it.
struct OneFile(Arc<[u8]>, Account);

impl Door for OneFile {
    fn read(&mut self, _: &str) -> Result<Arc<[u8]>, String> {
        Ok(Arc::clone(&self.0))
    }

    fn charge(&mut self, bytes: usize) -> Result<(), String> {
        self.1.charge(bytes).map_err(|why| why.to_string())
    }
}

/// What is known of a file.
struct Known {
    /// The files that it names, symbolic links resolved.
    names: Vec<PathBuf>,
    has_bodies: bool,
}

/// The USDs among some that are no robots: layers of others, and those without bodies. What cannot be read stays: it is named
/// where it is imported.
pub(crate) fn layers_of_others(usds: &[&Path], files: &Files) -> HashSet<PathBuf> {
    let known = |path: &&Path| Some((files.canonicalize(path).ok()?, known(path, files)?));
    let all: HashMap<PathBuf, Known> = usds.iter().filter_map(known).collect();
    let mut users: HashMap<&Path, Vec<&Path>> = HashMap::new();
    for (user, known) in &all {
        for name in known.names.iter().filter(|name| *name != user) {
            users.entry(name).or_default().push(user);
        }
    }
    // Whoever is composed of a file with bodies has them. Of one outside of the folder, nothing is known.
    let may_have = |path: &&Path| all.get(*path).is_none_or(|known| known.has_bodies);
    let mut waiting: Vec<&Path> =
        users.keys().copied().chain(all.keys().map(PathBuf::as_path)).filter(may_have).collect();
    let mut with_bodies = HashSet::new();
    while let Some(next) = waiting.pop() {
        if with_bodies.insert(next) {
            waiting.extend(users.get(next).into_iter().flatten());
        }
    }
    let is_part = |path: &&PathBuf| {
        users.contains_key(path.as_path()) || !with_bodies.contains(path.as_path())
    };
    all.keys().filter(is_part).cloned().collect()
}

fn known(path: &Path, files: &Files) -> Option<Known> {
    let bytes: Arc<[u8]> = files.read(path, MAX_DOCUMENT_BYTES).ok()?.into();
    let account = Account::default();
    account.deposit(bytes.len());
    let name = path.file_name()?.to_string_lossy();
    let outline = outline(&name, &mut OneFile(bytes, account)).ok()?;
    let folder = path.parent()?;
    let names = outline.names.iter().filter_map(|name| files.canonicalize(&folder.join(name)).ok());
    Some(Known { names: names.collect(), has_bodies: outline.has_bodies })
}
