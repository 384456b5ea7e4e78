use super::MODULES;
use crate::rules::directory::listed_files::listed_files;
use crate::rules::prelude::*;
use urdd_document::mesh_files::{Absence, MeshFiles};

declare_rule! {
    /// A mesh module names a file that is not there.
    ///
    /// Whoever loads the robot fails at this file, or shows the robot without the link. Often the
    /// file was not committed (see `.gitignore`), or was renamed by hand. In a legacy URDD the path
    /// is relative to the folder *above* the URDD and may lead into a URDD beside it: then that one
    /// must be there too, under its old name.
    ///
    /// Put the file back, or write the module again. DIR011 reports files that `urdd.json` lists
    /// and that do not exist.
    MSH002 "mesh-file-missing", Error, clause "7.1", since "0.1.0",
    phase References, needs [MESHES, NotFailed(MSH003), NotFailed(MSH009), NotFailed(MSH012)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    // DIR011 reports a file that is listed and missing.
    let listed = context.metadata().map(listed_files).unwrap_or_default();
    let mut files = MeshFiles::new(context);
    let mut no_siblings: BTreeMap<String, (usize, Finding)> = BTreeMap::new();
    for module in MODULES.iter().filter_map(|kind| context.module(*kind)) {
        for named in paths::of_module(module) {
            let (path, pointer) = (named.path, named.pointer.clone());
            let profile = if named.from_parent() { Profile::Legacy } else { Profile::V1 };
            if named.is_reference || (profile == Profile::V1 && listed.contains(path)) {
                continue;
            }
            match files.find(profile, path) {
                Ok(()) | Err(Absence::Other(_)) => {}
                Err(Absence::Missing) => {
                    let message =
                        format!("`{path}` is missing: restore the file, or write the module again");
                    finding_in(module, pointer, message).values("a file", "none").report(findings);
                }
                // A missing sibling URDD is one mistake, however many paths lead there.
                Err(Absence::NoSibling(name)) => {
                    let entry = no_siblings.entry(name).or_insert_with_key(|name| {
                        (0, finding_in(module, pointer, no_sibling(context, name)))
                    });
                    entry.0 += 1;
                }
            }
        }
    }
    for (name, (count, finding)) in no_siblings {
        let expected = format!("a URDD in the folder `{name}` beside this one");
        findings.report(finding.values(expected, "none").count(count));
    }
    Some(())
}

fn no_sibling(context: &Context, name: &str) -> String {
    let own = context.root().folder_name();
    let renamed = if context.listing().has_folder("mesh_modules") {
        format!("; or, if this URDD's folder `{own}` was `{name}` before, rename it back")
    } else {
        String::new()
    };
    format!(
        "mesh paths lead into a URDD `{name}` in the folder above this one, which does not exist: put it there{renamed}"
    )
}
