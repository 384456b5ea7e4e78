use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::root::EntryKind;
use urdd_document::paths::{self, Place};
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A symbolic link leads out of the URDD.
    ///
    /// Moved, packed or downloaded, the URDD lacks the file; and a link in a URDD from elsewhere may
    /// lead to any file of the reader's machine. What it leads to is not opened, and not checked.
    ///
    /// Put a copy of the file there instead of the link.
    DIR016 "link-leaves-root", Error, clause "2.8", since "0.1.0",
    phase Files, needs [],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let paths = paths::all(context);
    let named: HashSet<&str> = paths
        .iter()
        .filter_map(|path| match path.place(context) {
            Place::Here(path) => Some(path),
            _ => None,
        })
        .flat_map(with_parents)
        .collect();
    let module_folders: HashSet<&str> = ModuleKind::ALL
        .iter()
        .flat_map(|kind| with_parents(kind.folder()))
        .collect();
    let modules: HashSet<&str> = context
        .modules()
        .iter()
        .map(|module| module.folder.as_str())
        .collect();
    for entry in &context.listing().entries {
        let path = entry.path.as_str();
        // What else lies in the root is nobody's business.
        let matters = path == ROOT_METADATA
            || named.contains(path)
            || module_folders.contains(path)
            || with_parents(path).any(|parent| modules.contains(parent));
        if entry.kind == EntryKind::LinkOut && matters {
            findings.report(Finding::in_file(
                path,
                "this symbolic link leads out of the URDD: put what it leads to here instead",
            ));
        }
    }
}

/// A path, and every folder above it.
fn with_parents(path: &str) -> impl Iterator<Item = &str> {
    std::iter::successors(Some(path), |path| {
        path.rsplit_once('/').map(|(parent, _)| parent)
    })
}
