use std::collections::BTreeMap;
use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::mesh_files::{Absence, MeshFiles};
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};

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
    phase References, needs [
        AnyModule(&[
            Kind::OriginalMeshes,
            Kind::PlainMeshes,
            Kind::ConvexHullMeshes,
            Kind::ConvexDecompositionMeshes,
        ]),
        NotFailed(MSH003),
        NotFailed(MSH009),
        NotFailed(MSH012),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    // A listed file that is gone is one fault, and DIR011 has it.
    let listed: HashSet<&str> = context
        .metadata()
        .iter()
        .flat_map(|metadata| &metadata.modules)
        .flat_map(|module| &module.files)
        .map(|file| file.path.as_str())
        .collect();
    let mut files = MeshFiles::new(context);
    let mut gone: BTreeMap<String, (usize, Finding)> = BTreeMap::new();
    for kind in [
        ModuleKind::OriginalMeshes,
        ModuleKind::PlainMeshes,
        ModuleKind::ConvexHullMeshes,
        ModuleKind::ConvexDecompositionMeshes,
    ] {
        let (Some(document), Some(module)) = (context.document(kind), context.module(kind)) else {
            continue;
        };
        let file = module.file("module.json");
        for (profile, path, pointer) in named(context, kind, document) {
            if profile == Profile::V1 && listed.contains(path.as_str()) {
                continue;
            }
            match files.find(profile, &path) {
                Ok(()) | Err(Absence::Other(_)) => {}
                Err(Absence::Missing) => findings.report(
                    Finding::at(
                        &file,
                        pointer,
                        format!("`{path}` is missing: restore the file, or write the module again"),
                    )
                    .expected("a file")
                    .actual("none"),
                ),
                // A URDD beside this one that is gone is one mistake, however many paths lead there.
                Err(Absence::NoSibling(name)) => {
                    let entry = gone.entry(name).or_insert_with_key(|name| {
                        (0, Finding::at(&file, pointer, no_sibling(context, name)))
                    });
                    entry.0 += 1;
                }
            }
        }
    }
    for (name, (count, finding)) in gone {
        findings.report(
            finding
                .expected(format!("a URDD in the folder `{name}` beside this one"))
                .actual("none")
                .count(count),
        );
    }
}

/// Every file that a mesh module names: profile, path, pointer.
fn named(
    context: &Context,
    kind: ModuleKind,
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
    paths
        .map(|(_, mesh)| (meshes.profile, mesh.path.to_owned(), mesh.pointer.clone()))
        .collect()
}

fn no_sibling(context: &Context, name: &str) -> String {
    let own = context.root().folder_name();
    let within = context.listing().has_folder("mesh_modules");
    let renamed = if within {
        format!(
            "; or, if this URDD's folder was `{name}` before it was named `{own}`, name it so again"
        )
    } else {
        String::new()
    };
    format!(
        "mesh paths lead into a URDD `{name}` in the folder above this one, which does not exist: put it there{renamed}"
    )
}
