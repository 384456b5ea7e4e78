//! A mutation of a URDD: its description, and how to apply it.

use std::collections::BTreeMap;

use serde_json::Value;

use super::edit::{self, Edit};
use super::original::Original;
use urdd_directory::canonical;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::file_entry;

/// The files that a mutation changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Target {
    /// The JSON file and its mirror, consistently. Without a mirror, the JSON file.
    Document,
    /// The JSON file alone.
    JsonAlone,
    /// The YAML mirror alone.
    YamlAlone,
    /// One or more whole files.
    File,
}

impl Target {
    /// The word in reports.
    pub fn as_str(self) -> &'static str {
        match self {
            Target::Document => "json+yaml",
            Target::JsonAlone => "json",
            Target::YamlAlone => "yaml",
            Target::File => "file",
        }
    }
}

/// Description of a mutation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Description {
    /// The module's name, `urdd.json`, or `source` for the source URDF.
    pub module: String,
    /// The file, relative to the root; if several, the first one.
    pub file: String,
    /// The field: a JSON Pointer with `*` for indices, or the kind of file.
    pub field: String,
    /// The JSON Pointer of the value, if it is in a document.
    pub pointer: Option<String>,
    /// The files that change.
    pub target: Target,
    /// The kind of mutation.
    pub kind: &'static str,
    /// The old value.
    pub from: String,
    /// The new value.
    pub to: String,
}

/// New content by path; `None` for a removed file.
pub(crate) type Files = BTreeMap<String, Option<Vec<u8>>>;

/// The effect of a mutation of files.
pub(crate) struct FileChange {
    pub files: Files,
    /// Files to remove from the lists of the root metadata.
    pub unlisted: Vec<String>,
    pub from: String,
    pub to: String,
}

impl FileChange {
    /// Replaces files; the root metadata still lists them.
    pub(crate) fn new(files: Files, from: impl Into<String>, to: impl Into<String>) -> Self {
        FileChange { files, unlisted: Vec::new(), from: from.into(), to: to.into() }
    }
}

/// Computes the mutated files. `None` if the meaning would not change.
pub(crate) type MakeFiles = Box<dyn Fn(&Original) -> Option<FileChange> + Send + Sync>;

/// How to apply a mutation.
pub(crate) enum Change {
    /// Edits the document of the module in the description.
    Document(Vec<Edit>),
    /// Replaces files.
    Files(MakeFiles),
    /// Replaces files, and edits the root metadata.
    FilesAndMetadata(MakeFiles, Vec<Edit>),
}

/// A mutation to apply.
pub(crate) struct Mutation {
    pub description: Description,
    pub change: Change,
}

impl Mutation {
    /// A mutation of whole files. The description names the file, or the first of several.
    pub(crate) fn of_file(
        module: &str,
        file: &str,
        field: &str,
        kind: &'static str,
        change: Change,
    ) -> Self {
        let description = Description {
            module: module.to_owned(),
            file: file.to_owned(),
            field: field.to_owned(),
            pointer: None,
            target: Target::File,
            kind,
            from: String::new(),
            to: String::new(),
        };
        Mutation { description, change }
    }

    /// The files to replace, including the root metadata, and the description with old and new values. `None` if
    /// nothing changes.
    pub(crate) fn make(&self, original: &Original) -> Option<(Files, Description)> {
        let mut description = self.description.clone();
        let (mut files, metadata) = match &self.change {
            Change::Document(edits) => self.edited(original, edits, &mut description)?,
            Change::Files(make) => changed(make(original)?, &[], original, &mut description)?,
            Change::FilesAndMetadata(make, edits) => {
                changed(make(original)?, edits, original, &mut description)?
            }
        };
        if let Some(mut metadata) = metadata.filter(|_| !files.contains_key(ROOT_METADATA)) {
            file_entry::reseal(&mut metadata, |path| files.get(path)?.as_deref());
            files.insert(
                ROOT_METADATA.to_owned(),
                Some(canonical::json_string(&metadata).into_bytes()),
            );
        }
        Some((files, description))
    }

    /// The files of an edited document, and the matching root metadata.
    fn edited(
        &self,
        original: &Original,
        edits: &[Edit],
        description: &mut Description,
    ) -> Option<(Files, Option<Value>)> {
        let document = original.document(&description.module)?;
        let after = edit::apply(&document.value, edits)?;
        let place = description.pointer.as_deref()?;
        (description.from, description.to) = in_words(&document.value, &after, edits, place);
        let mut files = Files::new();
        if description.target != Target::YamlAlone {
            files.insert(document.file.clone(), Some(edit::json(&after)));
        }
        if description.target != Target::JsonAlone
            && let Some(mirror) = &document.mirror
        {
            files.insert(mirror.clone(), Some(edit::yaml(&after)));
        }
        let metadata = (document.name != ROOT_METADATA).then(|| original.metadata().clone());
        Some((files, metadata))
    }
}

fn changed(
    change: FileChange,
    edits: &[Edit],
    original: &Original,
    description: &mut Description,
) -> Option<(Files, Option<Value>)> {
    let mut metadata = edit::apply(original.metadata(), edits)?;
    file_entry::unlist(&mut metadata, |path| change.unlisted.iter().any(|gone| gone == path));
    (description.from, description.to) = (change.from, change.to);
    Some((change.files, Some(metadata)))
}

/// Longest value in reports, characters.
const SHOWN: usize = 80;

fn in_words(before: &Value, after: &Value, edits: &[Edit], place: &str) -> (String, String) {
    let text = |value: Option<&Value>| {
        value.map_or_else(|| "nothing".to_owned(), |value| shortened(&value.to_string()))
    };
    match edits {
        [Edit::Rename(at, to)] => (last(at), to.clone()),
        [Edit::Remove(at)] => (last(at), "nothing".to_owned()),
        [Edit::Double(at)] => (last(at), format!("{} twice", last(at))),
        [Edit::Add(_, key)] => ("nothing".to_owned(), key.clone()),
        // With several edits, show the first place; else the described one.
        [Edit::Set(first, _), ..] => {
            let at = if edits.len() == 1 { place } else { first };
            (text(before.pointer(at)), text(after.pointer(at)))
        }
        _ => (String::new(), String::new()),
    }
}

fn last(pointer: &str) -> String {
    super::pointer::parent(pointer).map_or_else(String::new, |(_, key)| key)
}

/// A text, truncated to [`SHOWN`] characters.
pub(crate) fn shortened(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}
