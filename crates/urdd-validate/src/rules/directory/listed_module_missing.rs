use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::path;
use urdd_directory::root::EntryKind;
use urdd_document::entries;

declare_rule! {
    /// A module that `urdd.json` lists is not there.
    ///
    /// A program that trusts the list stops, or works on with half a robot. Most often a folder was
    /// deleted, renamed, or left out of an archive.
    ///
    /// Bring the folder back, or take the module out of `modules` (and `depends_on` of others with
    /// it).
    DIR002 "listed-module-missing", Error, clause "2.3", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    for entry in entries::all(context) {
        let folder = &entry.entry.path;
        // A path that may not be is DIR015's, one that is not the module's folder DIR021's.
        let misplaced = entry.kind.is_some_and(|kind| kind.folder() != folder);
        if misplaced || path::check(folder).is_err() {
            continue;
        }
        let there = context.listing().get(folder).map(|entry| entry.kind);
        let message = match there {
            Some(EntryKind::Folder | EntryKind::LinkOut) => continue,
            None => format!(
                "the folder {folder} is missing: restore it, or remove the module from the list"
            ),
            Some(EntryKind::Link) => {
                format!("{folder} is a symbolic link: put the folder itself there")
            }
            Some(_) => format!("{folder} is not a folder: put the module's folder there"),
        };
        findings.report(
            Finding::at(ROOT_METADATA, entry.pointer("path"), message)
                .expected("a folder")
                .actual(match there {
                    None => "nothing",
                    Some(EntryKind::Link) => "a symbolic link",
                    Some(_) => "a file",
                }),
        );
    }
}
