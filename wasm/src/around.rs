//! Files that the host gave as the files around a description.

use std::path::{Path, PathBuf};

use urdd_directory::listing::EntryKind;
use urdd_source::dropped::PackageFolders;
use urdd_source::{Files as Around, Format, MAX_SOURCE_BYTES, Packages, Settings, format_of};

use crate::files::Files;

/// The files around descriptions.
pub struct GivenFiles {
    /// The folder that they are in; empty for the root.
    folder: String,
    /// Their paths.
    paths: Vec<String>,
    files: Around,
    /// Whether files are found by their last names.
    is_searched: bool,
}

impl GivenFiles {
    /// All of these files.
    pub fn of(files: &Files) -> Result<Self, String> {
        let listing = files.root.list().map_err(|error| error.to_string())?;
        let all = listing.entries.into_iter().filter(|entry| entry.kind == EntryKind::File);
        let all: Vec<(String, u64)> = all.map(|entry| (entry.path, entry.size)).collect();
        // In a folder of its name, as on a disk: programs look for packages by the names of folders.
        let name = files.root.folder_name();
        let is_plain = !name.contains(['/', '\\']) && !name.starts_with('.');
        let folder = if is_plain { name } else { "robot".to_owned() };
        let around = Around::of(files.root.clone(), &folder, all.iter().cloned());
        let around = around.map_err(|error| error.to_string())?;
        let paths = all.into_iter().map(|(path, _)| path).collect();
        let mut given = GivenFiles { folder, paths, files: around, is_searched: false };
        if let Some(lost) = files.lost() {
            given.files = given.files.clone().searched(|file| lost.contains(&given.path(file)));
            given.is_searched = true;
        }
        Ok(given)
    }

    /// The path of a file among them, relative to the root of all, so that messages name it as a person does.
    pub fn place(&self, path: &str) -> PathBuf {
        match &*self.folder {
            "" => path.into(),
            folder => format!("{folder}/{path}").into(),
        }
    }

    /// The paths of the files.
    pub fn paths(&self) -> &[String] {
        &self.paths
    }

    /// The files.
    #[cfg(feature = "make")]
    pub fn files(&self) -> &Around {
        &self.files
    }

    /// The path of a file among them from its place.
    pub fn path(&self, place: &Path) -> String {
        let path = place.strip_prefix(Path::new("/").join(&self.folder)).unwrap_or(place);
        path.to_string_lossy().into_owned()
    }

    /// How a description is read that is among them: packages are folders of their names, wherever these are.
    ///
    /// # Errors
    /// If there is no such file.
    pub fn settings(&self, path: &str) -> Result<Settings, String> {
        if !self.paths.iter().any(|known| known == path) {
            return Err(format!("there is no file `{}`", path.escape_debug()));
        }
        let mut packages = Packages::none();
        // A USD names files beside it.
        let place = self.place(path);
        let text = match format_of(&place, &self.files) {
            Some(Format::Usd) => Vec::new(),
            _ => {
                let text = self.files.read(&place, MAX_SOURCE_BYTES);
                text.map_err(|error| format!("`{}`: {error}", path.escape_debug()))?
            }
        };
        let folders = PackageFolders::of(self.paths.iter().map(|path| &**path).collect());
        for (name, folder) in folders.of_text(&String::from_utf8_lossy(&text), self.is_searched) {
            packages.put(name, self.place(&folder));
        }
        Ok(Settings { packages, files: self.files.clone(), ..Settings::default() })
    }
}
