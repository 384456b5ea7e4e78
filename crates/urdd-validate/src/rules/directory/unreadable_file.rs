use crate::rules::prelude::*;
use urdd_directory::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use urdd_document::module::{JsonFile, Mirror, VersionFile};

declare_rule! {
    /// A file that belongs to the URDD cannot be read.
    ///
    /// There is something in its place that is not a regular file (a folder, a pipe), or reading it
    /// is not allowed, or it is larger than any such file should be. What it says is not checked.
    ///
    /// Put the file there, and make it readable.
    DIR023 "unreadable-file", Error, clause "2.9", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    // By path, so that a document that is also listed is reported once.
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
            // DIR006 reports a VERSION file that is too long.
            VersionFile::Unreadable(ReadError::TooLarge { .. }) => {}
            VersionFile::Unreadable(error) => {
                unreadable.insert(module.file("VERSION"), error.clone());
            }
            _ => {}
        }
    }
    let source = source(context).map(|file| file.path.as_str());
    let listed = context.metadata().map(listed_files).into_iter().flatten();
    // A document may name a file outside of its module's folder, which is not listed.
    let modules = MESH_MODULES.iter().filter_map(|kind| context.module(*kind));
    let named = modules.flat_map(paths::of_module).filter(|named| !named.from_parent());
    // Most are listed, too: each is opened once.
    let needed: BTreeSet<&str> =
        listed.chain(source).chain(named.map(|named| named.path)).collect();
    for needed in needed {
        let opened = entries::look(context, needed).and_then(|_| context.root().open_file(needed));
        match opened {
            // DIR015 reports an invalid path.
            Ok(_) | Err(ReadError::Path(_)) => {}
            Err(error) => {
                unreadable.entry(needed.to_owned()).or_insert(error);
            }
        }
    }
    for (folder, error) in &context.listing().unreadable {
        unreadable.insert(folder.clone(), error.clone());
    }
    for (path, error) in unreadable {
        // DIR011 reports missing files, DIR016 links that leave the root.
        if !matches!(error, ReadError::Missing | ReadError::LeavesRoot) {
            Finding::in_file(path, error.to_string()).report(findings);
        }
    }
    if context.listing().cut {
        let message = format!(
            "there are more than {MAX_FILES} files, or folders more than {MAX_FOLDER_DEPTH} deep: the rest was not checked"
        );
        Finding::in_directory(message).report(findings);
    }
    Some(())
}
