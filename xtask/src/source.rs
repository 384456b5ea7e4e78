//! The repository's source as text: reading it, inserting lines, writing all edits or none.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Edits of a copy of the source. Nothing is written before [`Edits::write`].
pub struct Edits<'a> {
    root: &'a Path,
    texts: BTreeMap<String, String>,
}

impl<'a> Edits<'a> {
    /// An empty set of edits of the source in `root`.
    pub fn new(root: &'a Path) -> Self {
        let texts = BTreeMap::new();
        Edits { root, texts }
    }

    /// A file as edited so far.
    pub fn read(&self, path: &str) -> Result<String, String> {
        match self.texts.get(path) {
            Some(text) => Ok(text.clone()),
            None => fs::read_to_string(self.root.join(path))
                .map_err(|error| format!("{path}: cannot be read: {error}")),
        }
    }

    /// Replaces the text of a file.
    pub fn set(&mut self, path: &str, text: String) {
        self.texts.insert(path.to_owned(), text);
    }

    /// Whether a file or folder exists.
    pub fn is_there(&self, path: &str) -> bool {
        self.root.join(path).exists()
    }

    /// Adds a new file with this text.
    pub fn create(&mut self, path: &str, text: String) -> Result<(), String> {
        match self.is_there(path) {
            true => Err(format!("{path} is there already")),
            false => {
                self.set(path, text);
                Ok(())
            }
        }
    }

    /// Inserts text before the last place of `anchor` in a file.
    pub fn insert_before(&mut self, path: &str, anchor: &str, new: &str) -> Result<(), String> {
        let text = self.read(path)?;
        let place =
            text.rfind(anchor).ok_or(format!("{path} is not as expected: no {anchor:?}"))?;
        let (head, tail) = text.split_at(place);
        self.set(path, format!("{head}{new}{tail}"));
        Ok(())
    }

    /// Inserts `pub mod name;` or `mod name;` at its place in the sorted list of a file.
    pub fn insert_module(&mut self, path: &str, line: &str) -> Result<(), String> {
        let text = self.read(path)?;
        self.set(path, with_module(&text, line, path)?);
        Ok(())
    }

    /// Writes all edits.
    pub fn write(self) -> Result<(), String> {
        for (path, text) in self.texts {
            let file = self.root.join(&path);
            let folder = file.parent().map_or(Ok(()), fs::create_dir_all);
            folder
                .and_then(|()| fs::write(&file, text))
                .map_err(|error| format!("{path}: cannot be written: {error}"))?;
        }
        Ok(())
    }
}

/// The files below some paths.
pub fn files(root: &Path, below: &[&str]) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut paths: Vec<_> = below.iter().map(|path| root.join(path)).collect();
    while let Some(path) = paths.pop() {
        match fs::read_dir(&path) {
            Ok(entries) => paths.extend(entries.flatten().map(|entry| entry.path())),
            Err(_) => files.push(path),
        }
    }
    files.sort();
    files
}

/// A text with one more line in its sorted list of modules.
pub fn with_module(text: &str, line: &str, path: &str) -> Result<String, String> {
    let name = |line: &str| line.trim_start_matches("pub ").to_owned();
    let modules: Vec<&str> =
        text.lines().filter(|line| name(line).starts_with("mod ") && line.ends_with(';')).collect();
    let before = modules.iter().rev().find(|other| name(other) < name(line));
    match (before, modules.first()) {
        (Some(before), _) => Ok(text.replacen(before, &format!("{before}\n{line}"), 1)),
        (None, Some(first)) => {
            // With its attribute, if it has one.
            let place = text.find(first).unwrap_or_default();
            let lines = text[..place].lines().rev();
            let attribute = lines.take_while(|line| line.starts_with("#["));
            let place = place - attribute.map(|line| line.len() + 1).sum::<usize>();
            let (head, tail) = text.split_at(place);
            Ok(format!("{head}{line}\n{tail}"))
        }
        // A list's first line follows the file's documentation.
        (None, None) => {
            let documentation = text.lines().take_while(|line| line.starts_with("//!"));
            let end = documentation.map(|line| line.len() + 1).sum::<usize>();
            match text.split_at_checked(end) {
                Some((head, tail)) if end > 0 => Ok(format!("{head}\n{line}\n{tail}")),
                _ => Err(format!("{path} is not as expected: no list of modules")),
            }
        }
    }
}

/// Converts a name in lower case with underscores to camel case: `BatteryPack`.
pub fn camel(name: &str) -> String {
    let word = |word: &str| {
        let mut letters = word.chars();
        let first = letters.next().map(|letter| letter.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    };
    name.split('_').map(word).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_modules_stay_sorted() {
        let list = "//! Doc.\n\n#[cfg(unix)]\nmod b;\npub mod d;\n";
        let with = |line| with_module(list, line, "list.rs").expect("a list");
        assert_eq!(with("mod a;"), "//! Doc.\n\nmod a;\n#[cfg(unix)]\nmod b;\npub mod d;\n");
        assert_eq!(with("mod c;"), "//! Doc.\n\n#[cfg(unix)]\nmod b;\nmod c;\npub mod d;\n");
        let empty = with_module("//! Doc.\n\nuse x;\n", "mod a;", "list.rs");
        assert_eq!(empty.as_deref(), Ok("//! Doc.\n\nmod a;\n\nuse x;\n"));
        assert!(with_module("use x;\n", "mod a;", "list.rs").is_err());
        assert_eq!(camel("battery_pack2"), "BatteryPack2");
    }
}
