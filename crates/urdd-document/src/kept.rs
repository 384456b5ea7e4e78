//! Modules of a URDD that are read when they are first asked for, and kept.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::load::{Loaded, known_folders, read_metadata, read_modules};
use super::module::{MetadataFile, Module};
use urdd_directory::root::{Listing, ReadError, Root};
use urdd_format::registry::ModuleKind;

/// A URDD as it is when this is made: each module is read when it is first asked for, and kept. One that changed
/// before is [`ReadError::Changed`].
pub struct Kept {
    root: Root,
    listing: OnceLock<Arc<Listing>>,
    metadata: OnceLock<Arc<MetadataFile>>,
    modules: Mutex<BTreeMap<ModuleKind, Arc<Module>>>,
}

impl fmt::Debug for Kept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Kept").field(&self.root).finish()
    }
}

impl Kept {
    /// The URDD at a root, as it is now.
    pub fn new(root: &Root) -> Self {
        let (listing, metadata) = (OnceLock::new(), OnceLock::new());
        Kept { root: root.kept(), listing, metadata, modules: Mutex::default() }
    }

    /// Its root, as it was.
    pub fn root(&self) -> &Root {
        &self.root
    }

    /// These modules, as far as they are there, without mirrors and URDF.
    ///
    /// # Errors
    /// If the root could not be listed, or [`ReadError::Changed`].
    pub fn part(&self, kinds: &[ModuleKind]) -> Result<Loaded, ReadError> {
        let listing = keep(&self.listing, || self.root.list().map(Arc::new))?;
        let metadata = match self.metadata.get() {
            Some(metadata) => Arc::clone(metadata),
            None => {
                let read = Arc::new(read_metadata(&self.root));
                match read.json.unreadable() {
                    Some(ReadError::Changed) => return Err(ReadError::Changed),
                    Some(_) => read,
                    None => Arc::clone(self.metadata.get_or_init(|| read)),
                }
            }
        };
        let known = || self.modules.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = kinds.iter().filter_map(|kind| known().get(kind).cloned());
        let mut modules: Vec<Arc<Module>> = kept.collect();
        let is_new = |kind: &ModuleKind| modules.iter().all(|module| module.kind != Some(*kind));
        let new: Vec<ModuleKind> = kinds.iter().copied().filter(is_new).collect();
        let folders = known_folders(&new, listing);
        if !folders.is_empty() {
            for module in read_modules(&self.root, &metadata, folders, None) {
                match (module.unreadable(), module.kind) {
                    (Some(ReadError::Changed), _) => return Err(ReadError::Changed),
                    (None, Some(kind)) => drop(known().insert(kind, Arc::clone(&module))),
                    _ => {}
                }
                modules.push(module);
            }
        }
        Ok(Loaded::of(self.root.clone(), Arc::clone(listing), metadata, modules))
    }
}

/// What is there already, or what `read` gives, which stays. An error does not stay. No lock is held during the read,
/// which may run on other threads.
///
/// # Errors
/// Those of `read`.
pub fn keep<T, E>(kept: &OnceLock<T>, read: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    match kept.get() {
        Some(known) => Ok(known),
        None => {
            let read = read()?;
            Ok(kept.get_or_init(|| read))
        }
    }
}
