use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::path;
use urdd_document::entries;

declare_rule! {
    /// An entry of `modules` has a name and a path that do not belong together, or is there twice.
    ///
    /// Some programs look a module up by its name, others by its folder. Every module has one folder
    /// that the specification gives it, and its name is the last part of that.
    ///
    /// Give each module one entry, with the name and the folder of the table in SPEC §12.
    DIR021 "module-entry-wrong", Error, clause "2.6", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let mut names = HashSet::new();
    let mut paths = HashSet::new();
    for entry in entries::all(context) {
        let (name, path) = (entry.entry.name.as_str(), entry.entry.path.as_str());
        // A path that may not be is DIR015's.
        if path::check(path).is_err() {
            continue;
        }
        let twice = !names.insert(name) || !paths.insert(path);
        let (key, message, expected) = match entry.kind {
            Some(kind) if kind.name() != name => (
                "name",
                "this is not the name of the module in this folder",
                kind.name(),
            ),
            Some(kind) if kind.folder() != path => (
                "path",
                "this is not the folder that the module has",
                kind.folder(),
            ),
            _ if path.rsplit('/').next() != Some(name) => (
                "name",
                "the name is not the last part of the path",
                path.rsplit('/').next().unwrap_or(path),
            ),
            _ if twice => ("name", "the module is listed twice", "one entry"),
            _ => continue,
        };
        let actual = if key == "path" { path } else { name };
        findings.report(
            Finding::at(ROOT_METADATA, entry.pointer(key), message)
                .expected(expected)
                .actual(format!("{actual:?}")),
        );
    }
}
