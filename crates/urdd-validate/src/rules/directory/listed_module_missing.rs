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
    phase Files, needs [Version1, RootMetadata],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
