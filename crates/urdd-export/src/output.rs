//! What an export writes.

use crate::Note;

/// Files by path.
pub(super) type Files = Vec<(String, Vec<u8>)>;

/// The result of an export.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The text of the file.
    pub text: String,
    /// The path of the text in an exported folder; `None` for a format of one file, which has a path of its own.
    pub path: Option<String>,
    /// The other files of the folder; or those that the text references, with paths relative to it, sorted, and then an
    /// MJCF's scene, which includes it.
    pub files: Files,
    /// What the format cannot express, or expresses differently.
    pub notes: Vec<Note>,
    /// What was carried, carried otherwise and lost of this robot, and the notes: JSON.
    pub report: String,
}

impl Export {
    /// A text with the files that it references; not in a folder, and without a report yet.
    pub(super) fn of(text: String, files: Files, notes: Vec<Note>) -> Self {
        Export { text, path: None, files, notes, report: String::new() }
    }
}

/// Puts values in the place of words between `@`. A value may have the word of another: a line has one word at most. A
/// word alone on its line stands for any number of whole lines.
pub(super) fn fill(template: &str, values: &[(&str, String)]) -> String {
    let mut text = String::new();
    for line in template.lines() {
        let word = |word: &str| format!("@{word}@");
        let filled = match values.iter().find(|(name, _)| line.contains(&word(name))) {
            Some((name, value)) => line.replace(&word(name), value),
            None => format!("{line}\n"),
        };
        text += &filled;
        if !filled.is_empty() && !filled.ends_with('\n') {
            text.push('\n');
        }
    }
    text
}
