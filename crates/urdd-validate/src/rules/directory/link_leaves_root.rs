use crate::rules::prelude::*;
use urdd_document::paths::Place;

declare_rule! {
    /// A symbolic link leads out of the URDD.
    ///
    /// Moved, packed or downloaded, the URDD lacks the file; and a link in a URDD from elsewhere may
    /// lead to any file of the reader's machine. What it leads to is not opened, and not checked.
    ///
    /// Put a copy of the file there instead of the link.
    DIR016 "link-leaves-root", Error, clause "2.8", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let paths = paths::all(context);
    let here = paths.iter().filter_map(|path| match path.place(context) {
        Place::Here(path) => Some(path),
        _ => None,
    });
    let module_folders = Kind::ALL.iter().map(|kind| kind.folder());
    let named: HashSet<&str> = here.chain(module_folders).flat_map(with_parents).collect();
    let modules: HashSet<&str> = context.modules().map(|module| module.folder.as_str()).collect();
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
