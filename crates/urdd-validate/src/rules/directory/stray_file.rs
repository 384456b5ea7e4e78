use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::root::EntryKind;
use urdd_document::entries::{self, MODULE_FILES};
use urdd_document::module::Module;
use urdd_document::paths::{self, PathRole, Place};

declare_rule! {
    /// A module's folder holds a file that neither the module nor `urdd.json` names.
    ///
    /// Most often it is left over from an earlier run (meshes of links that were renamed), or from an
    /// editor. It makes the URDD larger, and people take it for part of the robot.
    ///
    /// Delete it, or keep it outside the module folders: no rule is about files in the root folder
    /// itself. Write a module into a fresh folder, not over an old one.
    DIR013 "stray-file", Warning, clause "2.7", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let entries = entries::all(context);
    let listed: HashSet<&str> = entries
        .iter()
        .flat_map(|entry| &entry.entry.files)
        .map(|file| file.path.as_str())
        .collect();
    let paths = paths::all(context);
    let named: HashSet<&str> = paths.iter().map(|path| path.path).collect();
    for module in entries::known_modules(context) {
        // What an extension's documents name is not known; what a broken document names neither.
        if module.kind.is_none() || module.document.is_none() || misnames_files(context, module) {
            continue;
        }
        let own = MODULE_FILES.map(|name| module.file(name));
        let stray: Vec<&str> = context
            .listing()
            .below(&module.folder)
            .filter(|entry| matches!(entry.kind, EntryKind::File | EntryKind::Link))
            .filter(|entry| entry.utf8)
            .map(|entry| entry.path.as_str())
            .filter(|path| !own.iter().any(|own| own == path))
            .filter(|path| !listed.contains(path) && !named.contains(path))
            .collect();
        let Some(first) = stray.first() else {
            continue;
        };
        let others = match stray.len() {
            1 => String::new(),
            n => format!(
                " (and neither does it name {} more below this folder)",
                n - 1
            ),
        };
        findings.report(
            Finding::in_file(
                *first,
                format!(
                    "{} does not name this file{others}: delete it, or keep it outside the module folders",
                    module.name()
                ),
            )
            .count(stray.len()),
        );
    }
}

/// Whether the module names a file that is not there, or one file for two things: then what it does
/// not name follows from that, and rules of its family report it.
fn misnames_files(context: &Context, module: &Module) -> bool {
    let mut seen = HashSet::new();
    paths::of_module(module).iter().any(|path| {
        let there = match path.place(context) {
            Place::Here(path) => entries::look(context, path).is_ok(),
            _ => false,
        };
        !there || (path.role != PathRole::MeshReference && !seen.insert(path.path))
    })
}
