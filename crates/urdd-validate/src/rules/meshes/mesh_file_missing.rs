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
    let mut gone: BTreeMap<String, (usize, Finding)> = BTreeMap::new();
    for (kind, module, document) in context.documents(MODULES) {
        for (profile, path, pointer) in named(context, kind, document) {
            if profile == Profile::V1 && listed.contains(path.as_str()) {
                continue;
            }
            match files.find(profile, &path) {
                Ok(()) | Err(Absence::Other(_)) => {}
                Err(Absence::Missing) => {
                    let message =
                        format!("`{path}` is missing: restore the file, or write the module again");
                    finding_in(module, pointer, message).values("a file", "none").report(findings);
                }
                // A missing sibling URDD is one mistake, however many paths lead there.
                Err(Absence::NoSibling(name)) => {
                    let entry = gone.entry(name).or_insert_with_key(|name| {
                        (0, finding_in(module, pointer, no_sibling(context, name)))
                    });
                    entry.0 += 1;
                }
            }
        }
    }
    for (name, (count, finding)) in gone {
        let expected = format!("a URDD in the folder `{name}` beside this one");
        findings.report(finding.values(expected, "none").count(count));
    }
    Some(())
}

/// The files that a mesh module names: profile, path, pointer.
fn named(
    context: &Context,
    kind: Kind,
    document: &ModuleDocument,
) -> Vec<(Profile, String, String)> {
    if let ModuleDocument::OriginalMeshes(module) = document {
        let mut named = Vec::new();
        for (index, mesh) in module.files.iter().enumerate() {
            let at = format!("/files/{index}");
            named.push((Profile::V1, mesh.path.clone(), format!("{at}/path")));
            for (side, path) in mesh.side_files.iter().enumerate() {
                named.push((Profile::V1, path.clone(), format!("{at}/side_files/{side}")));
            }
        }
        return named;
    }
    let Some(meshes) = context.meshes(kind) else {
        return Vec::new();
    };
    let paths = meshes.paths();
    paths.map(|(_, mesh)| (meshes.profile, mesh.path.to_owned(), mesh.pointer.clone())).collect()
}

fn no_sibling(context: &Context, name: &str) -> String {
    let own = context.root().folder_name();
    let within = context.listing().has_folder("mesh_modules");
    let renamed = if within {
        format!("; or, if this URDD's folder `{own}` was `{name}` before, rename it back")
    } else {
        String::new()
    };
    format!(
        "mesh paths lead into a URDD `{name}` in the folder above this one, which does not exist: put it there{renamed}"
    )
}
