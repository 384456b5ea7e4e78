use std::collections::BTreeMap;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use urdd_directory::root::ReadError;
use urdd_document::entries;
use urdd_document::module::{JsonFile, Mirror, VersionFile};
use urdd_format::root_metadata::Source;

declare_rule! {
    /// A file that belongs to the URDD cannot be read.
    ///
    /// There is something in its place that is not a regular file (a folder, a pipe), or reading it
    /// is not allowed, or it is larger than any such file should be. What it says is not checked.
    ///
    /// Put the file there, and let it be readable.
    DIR023 "unreadable-file", Error, clause "2.9", since "0.1.0",
    phase Files, needs [],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    // By path, so that a file that is a document and is listed too is told of once.
    let mut unreadable: BTreeMap<String, ReadError> = BTreeMap::new();
    if let JsonFile::Unreadable(error) = &context.metadata_file().json {
        unreadable.insert(ROOT_METADATA.to_owned(), error.clone());
    }
    for module in entries::known_modules(context) {
        if let JsonFile::Unreadable(error) = &module.json {
            unreadable.insert(module.file("module.json"), error.clone());
        }
        if let Mirror::Unreadable(error) = &module.mirror {
            unreadable.insert(module.file("module.yaml"), error.clone());
        }
        match &module.version_file {
            // A long VERSION is DIR006's.
            VersionFile::Unreadable(ReadError::TooLarge { .. }) => {}
            VersionFile::Unreadable(error) => {
                unreadable.insert(module.file("VERSION"), error.clone());
            }
            _ => {}
        }
    }
    for listed in listed_files(context) {
        let opened = entries::look(context, listed).and_then(|_| context.root().open_file(listed));
        match opened {
            // A path that may not be is DIR015's.
            Ok(_) | Err(ReadError::Path(_)) => {}
            Err(error) => {
                unreadable.entry(listed.to_owned()).or_insert(error);
            }
        }
    }
    for (folder, error) in &context.listing().unreadable {
        unreadable.insert(folder.clone(), error.clone());
    }
    for (path, error) in unreadable {
        // What is not there is DIR011's, and what is outside DIR016's.
        if !matches!(error, ReadError::Missing | ReadError::LeavesRoot) {
            findings.report(Finding::in_file(path, error.to_string()));
        }
    }
    if context.listing().cut {
        findings.report(Finding::in_directory(format!(
            "there are more than {MAX_FILES} files, or folders more than {MAX_FOLDER_DEPTH} deep: the rest was not checked"
        )));
    }
}

fn listed_files(context: &Context) -> Vec<&str> {
    let Some(metadata) = context.metadata() else {
        return Vec::new();
    };
    let source = match &metadata.source {
        Some(Source::Urdf(file)) => Some(file),
        _ => None,
    };
    let files = metadata.modules.iter().flat_map(|module| &module.files);
    files.chain(source).map(|file| file.path.as_str()).collect()
}
