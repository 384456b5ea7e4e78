//! What the folders around a description say: the name in `package.xml`, what a package installs, and the names in a folder
//! by small letters. Each folder is read once, however many names lead there: nobody else reads these files.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use urdd_directory::limits::MAX_MANIFEST_BYTES;

use crate::files::Files;
use crate::installed::{self, Installed};

/// The facts of folders. Clones share them: those of one run, during which no file changes.
#[derive(Debug, Clone)]
pub struct FolderFacts {
    files: Files,
    known: Arc<Mutex<Known>>,
}

impl PartialEq for FolderFacts {
    /// Whether they are of one run.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.known, &other.known)
    }
}

impl Eq for FolderFacts {}

#[derive(Debug, Default)]
struct Known {
    packages: HashMap<PathBuf, Option<Arc<str>>>,
    installed: HashMap<PathBuf, Arc<Installed>>,
    names: HashMap<PathBuf, Arc<Spellings>>,
}

/// The names in a folder by what they are in small letters, each list sorted.
pub(crate) type Spellings = HashMap<String, Vec<String>>;

impl FolderFacts {
    /// Of folders of which nothing is known yet.
    pub fn new(files: &Files) -> Self {
        FolderFacts { files: files.clone(), known: Arc::default() }
    }

    /// Where the files are.
    pub fn files(&self) -> &Files {
        &self.files
    }

    /// The name in a folder's `package.xml`, if that is there and is well-formed.
    pub fn package_name(&self, folder: &Path) -> Option<Arc<str>> {
        self.once(folder, |known| &mut known.packages, || package_name(folder, &self.files))
    }

    /// Whether a folder is the package of a name.
    pub(crate) fn is_package(&self, folder: &Path, name: &str) -> bool {
        self.package_name(folder).is_some_and(|found| *found == *name)
    }

    /// What the package in a folder installs.
    pub(crate) fn installed(&self, folder: &Path) -> Arc<Installed> {
        let read = || Arc::new(installed::installed(folder, &self.files));
        self.once(folder, |known| &mut known.installed, read)
    }

    /// The names in a folder.
    pub(crate) fn spellings(&self, folder: &Path) -> Arc<Spellings> {
        let read = || {
            let mut all = Spellings::new();
            for name in
                self.files.names(folder).into_iter().filter_map(|name| name.into_string().ok())
            {
                all.entry(name.to_lowercase()).or_default().push(name);
            }
            all.values_mut().for_each(|names| names.sort());
            Arc::new(all)
        };
        self.once(folder, |known| &mut known.names, read)
    }

    fn once<T: Clone>(
        &self,
        folder: &Path,
        of: impl Fn(&mut Known) -> &mut HashMap<PathBuf, T>,
        read: impl FnOnce() -> T,
    ) -> T {
        if let Some(found) = of(&mut self.known()).get(folder) {
            return found.clone();
        }
        let found = read();
        of(&mut self.known()).insert(folder.to_owned(), found.clone());
        found
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn package_name(folder: &Path, files: &Files) -> Option<Arc<str>> {
    let bytes = files.read(&folder.join("package.xml"), MAX_MANIFEST_BYTES).ok()?;
    let text = String::from_utf8(bytes).ok()?;
    let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).ok()?;
    let mut elements = document.root_element().children();
    let name = elements.find(|element| element.has_tag_name("name"))?;
    Some(name.text()?.trim().into())
}
