use super::versions::checked_modules;
use crate::rules::prelude::*;
use urdd_document::paths::Place;

declare_rule! {
    /// A path is not one that a URDD may name.
    ///
    /// Paths are relative to the URDD's root, with forward slashes, and have no empty part, no `.` or
    /// `..`, no backslash, colon or control character: only such a path means the same on every
    /// system, stays right when the URDD is moved, and cannot lead a reader out of it. An absolute
    /// path is right on one machine only.
    ///
    /// Write the path from the URDD's root, such as
    /// `mesh_modules/plain_meshes_module/meshes/stl/0_base.stl`.
    DIR015 "bad-path", Error, clause "2.8", since "0.1.0",
    phase References, needs [Version1], check bad_path,

    /// A symbolic link leads out of the URDD.
    ///
    /// Moved, packed or downloaded, the URDD lacks the file; and a link in a URDD from elsewhere may
    /// lead to any file of the reader's machine. What it leads to is not opened, and not checked.
    ///
    /// Put a copy of the file there instead of the link.
    DIR016 "link-leaves-root", Error, clause "2.8", since "0.1.0",
    phase Files, needs [], check link_leaves_root,

    /// A file in a module's folder has a name that is not UTF-8.
    ///
    /// No document can name it, archives garble it, and on other systems it cannot even be made.
    /// Most often it was unpacked from an archive with names in an old encoding.
    ///
    /// Rename it; derived files are named by link index and ASCII letters.
    DIR024 "name-not-utf8", Error, clause "2.9", since "0.1.0",
    phase Files, needs [], check name_not_utf8,

    /// Two names in one folder differ only in letter case.
    ///
    /// On Windows, on macOS and in many archives the two are one: when the URDD is copied or unpacked
    /// there, one file silently takes the place of the other, and the hashes in `urdd.json` no longer
    /// hold.
    ///
    /// Rename one of the two, and name it in the documents as it is called then.
    DIR027 "names-differ-in-case", Error, clause "2.9", since "0.2.0",
    phase Files, needs [Version1], check names_differ_in_case,
}

fn bad_path(context: &Context, findings: &mut Findings) -> Option<()> {
    for path in paths::all(context) {
        if !path.from_parent()
            && let Err(fault) = path::check(path.path)
        {
            Finding::at(path.file(), path.pointer.clone(), fault.to_string())
                .values("a path relative to the URDD's root", format!("{:?}", path.path))
                .report(findings);
        }
    }
    Some(())
}

fn link_leaves_root(context: &Context, findings: &mut Findings) -> Option<()> {
    let paths = paths::all(context);
    let here = paths.iter().filter_map(|path| match path.place(context) {
        Place::Here(path) => Some(path),
        _ => None,
    });
    let module_folders = Kind::ALL.iter().map(|kind| kind.folder());
    let named: HashSet<&str> = here.chain(module_folders).flat_map(with_parents).collect();
    let modules: HashSet<&str> =
        checked_modules(context).map(|module| module.folder.as_str()).collect();
    for entry in &context.listing().entries {
        let path = entry.path.as_str();
        // Other files in the root do not belong to the URDD.
        let matters = path == ROOT_METADATA
            || named.contains(path)
            || with_parents(path).any(|parent| modules.contains(parent));
        if entry.kind == EntryKind::LinkOut && matters {
            let message =
                "this symbolic link leads out of the URDD: put what it leads to here instead";
            Finding::in_file(path, message).report(findings);
        }
    }
    Some(())
}

/// A path, and every folder above it.
fn with_parents(path: &str) -> impl Iterator<Item = &str> {
    std::iter::successors(Some(path), |path| Some(path.rsplit_once('/')?.0))
}

fn name_not_utf8(context: &Context, findings: &mut Findings) -> Option<()> {
    for module in entries::known_modules(context) {
        let mut bad = context.listing().below(&module.folder).filter(|entry| !entry.utf8);
        if let Some(first) = bad.next() {
            let message = "the name is not UTF-8 (shown with replacement characters): rename it";
            Finding::in_file(&first.path, message).count(1 + bad.count()).report(findings);
        }
    }
    Some(())
}

fn names_differ_in_case(context: &Context, findings: &mut Findings) -> Option<()> {
    let source = source(context).map(|file| file.path.as_str());
    // Other files in the root do not belong to the URDD.
    let is_of_urdd = |path: &str| {
        let folders = entries::known_modules(context).map(|module| module.folder.as_str());
        path == ROOT_METADATA
            || Some(path) == source
            || folders
                .into_iter()
                .any(|folder| path == folder || is_in(path, folder) || is_in(folder, path))
    };
    let mut alike: BTreeMap<(&str, String), Vec<&str>> = BTreeMap::new();
    for entry in &context.listing().entries {
        let (folder, name) = entry.path.rsplit_once('/').unwrap_or(("", &entry.path));
        let paths = alike.entry((folder, name.to_lowercase())).or_default();
        paths.push(&entry.path);
    }
    for paths in alike.values() {
        if let [first, second, ..] = paths.as_slice()
            && paths.iter().any(|path| is_of_urdd(path))
        {
            let message = format!(
                "this name differs from that of {first} only in letter case, and many file systems treat the two as one: rename one"
            );
            Finding::in_file(*second, message).count(paths.len() - 1).report(findings);
        }
    }
    Some(())
}

/// Whether a path is below a folder.
fn is_in(path: &str, folder: &str) -> bool {
    let rest = path.strip_prefix(folder);
    rest.is_some_and(|rest| rest.starts_with('/'))
}
