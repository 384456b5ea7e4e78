use crate::rules::prelude::*;

declare_rule! {
    /// A module that `urdd.json` lists is not there.
    ///
    /// A program that trusts the list stops, or continues with half a robot. Most often a folder was
    /// deleted, renamed, or left out of an archive.
    ///
    /// Bring the folder back, or take the module out of `modules` (and `depends_on` of others with
    /// it).
    DIR002 "listed-module-missing", Error, clause "2.3", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check listed_module_missing,

    /// A module folder is there that `urdd.json` does not list.
    ///
    /// Programs that go by the list do not see the module, and programs that look for folders do: two
    /// readers see two robots. Its files have no hash either, so that a change of them is not noticed.
    ///
    /// Add the module to `modules` of `urdd.json`, or delete the folder.
    DIR003 "unlisted-module", Error, clause "2.3", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check unlisted_module,

    /// A file that `urdd.json` lists is not there.
    ///
    /// The URDD is not whole: a file was deleted or renamed, or left out of an archive or a commit
    /// (see what `.gitignore` says of mesh files). It may also never have been written.
    ///
    /// Bring the file back, or write `urdd.json` again from what is there.
    DIR011 "listed-file-missing", Error, clause "2.7", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check listed_file_missing,
}

fn listed_module_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    for entry in listed_modules(context)? {
        let folder = &entry.entry.path;
        // DIR015 reports an invalid path, DIR021 a wrong folder.
        let misplaced = entry.kind.is_some_and(|kind| kind.folder() != folder);
        if misplaced || path::check(folder).is_err() {
            continue;
        }
        let there = context.listing().get(folder).map(|entry| entry.kind);
        let (actual, message) = match there {
            Some(EntryKind::Folder | EntryKind::LinkOut) => continue,
            None => (
                "nothing",
                format!(
                    "the folder {folder} is missing: restore it, or remove the module from the list"
                ),
            ),
            Some(EntryKind::Link) => (
                "a symbolic link",
                format!("{folder} is a symbolic link: put the folder itself there"),
            ),
            Some(_) => {
                ("a file", format!("{folder} is not a folder: put the module's folder there"))
            }
        };
        finding_in(&entry, "path", message).values("a folder", actual).report(findings);
    }
    Some(())
}

fn unlisted_module(context: &Context, findings: &mut Findings) -> Option<()> {
    // By name too: DIR021 reports an entry with the right name and a wrong path.
    let mut listed = HashSet::new();
    for entry in listed_modules(context)? {
        listed.insert(entry.entry.path.as_str());
        listed.insert(entry.entry.name.as_str());
    }
    for module in entries::known_modules(context) {
        if !listed.contains(module.folder.as_str()) && !listed.contains(module.name()) {
            let message =
                "urdd.json does not list this module: add it to `modules`, or delete the folder";
            Finding::in_file(&module.folder, message).report(findings);
        }
    }
    Some(())
}

fn listed_file_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut look = |pointer: String, path: &str, message: &str| {
        if entries::look(context, path) == Err(ReadError::Missing) {
            Finding::at(ROOT_METADATA, pointer, message)
                .values("a file", format!("nothing at {path}"))
                .report(findings);
        }
    };
    if let Some(file) = source(context) {
        let message = "the source URDF is missing: put it into the root folder";
        look("/source/Urdf/path".to_owned(), &file.path, message);
    }
    for entry in listed_modules(context)? {
        // DIR002 reports a missing folder; DIR004 and DIR005 report missing module.json and VERSION files.
        if context.listing().get(&entry.entry.path).is_none() {
            continue;
        }
        for (place, file) in entry.entry.files.iter().enumerate() {
            let own = file.path.strip_prefix(entry.entry.path.as_str());
            if entry.module.is_none() || !matches!(own, Some("/VERSION" | "/module.json")) {
                let pointer = entry.pointer(&format!("files/{place}/path"));
                let message = "the file is missing: restore it, or write urdd.json again from the files that exist";
                look(pointer, &file.path, message);
            }
        }
    }
    Some(())
}
