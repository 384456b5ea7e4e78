use super::listed_files;
use crate::rules::prelude::*;
use urdd_document::entries::MODULE_FILES;
use urdd_document::paths::Place;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let listed = listed_files(context.metadata()?);
    let paths = paths::all(context);
    let named: HashSet<&str> = paths.iter().map(|path| path.path).collect();
    for module in entries::known_modules(context) {
        // It is unknown which files an extension or a broken document names.
        if module.kind.is_none() || module.document.is_none() || misnames_files(context, module) {
            continue;
        }
        let own = MODULE_FILES.map(|name| module.file(name));
        let stray: Vec<&str> = context
            .listing()
            .below(&module.folder)
            .filter(|entry| matches!(entry.kind, EntryKind::File | EntryKind::Link))
            .filter(|entry| entry.utf8 && !own.contains(&entry.path))
            .map(|entry| entry.path.as_str())
            .filter(|path| !listed.contains(path) && !named.contains(path))
            .collect();
        let Some(first) = stray.first() else {
            continue;
        };
        let others = match stray.len() - 1 {
            0 => String::new(),
            n => format!(" (and neither does it name {n} more below this folder)"),
        };
        let message = format!(
            "{} does not name this file{others}: delete it, or keep it outside the module folders",
            module.name()
        );
        Finding::in_file(*first, message).count(stray.len()).report(findings);
    }
    Some(())
}

/// Whether the module names a missing file, or one file for two things. Stray files follow from that, and rules of its
/// family report it.
fn misnames_files(context: &Context, module: &Module) -> bool {
    let mut seen = HashSet::new();
    paths::of_module(module).iter().any(|path| {
        let there = match path.place(context) {
            Place::Here(path) => entries::look(context, path).is_ok(),
            _ => false,
        };
        !there || (!path.is_reference && !seen.insert(path.path))
    })
}
