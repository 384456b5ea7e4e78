use std::collections::{HashMap, HashSet};

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::entries;
use urdd_document::module::Module;
use urdd_format::original_meshes::OriginalMeshesModule;
use urdd_format::registry::{ModuleDocument, ModuleKind};

declare_rule! {
    /// `references` and `files` of `original_meshes_module` do not belong together.
    ///
    /// `files` is every carried mesh once, sorted by path; a reference names one of them, or null where
    /// the mesh could not be found. A reference to a file that is not in the list, or a file that no
    /// reference names, means that a mesh was lost or exchanged.
    ///
    /// Give each reference the path of the file that was carried for it, the same for the same file
    /// name of the URDF, and list each of these files once, sorted byte by byte; side files too.
    MSH012 "carried-files-mismatch", Error, clause "7.5", since "0.1.0",
    phase References, needs [Version1, Module(Kind::OriginalMeshes), NotFailed(DIR015), NotFailed(MSH009)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(ModuleDocument::OriginalMeshes(original)) =
        context.document(ModuleKind::OriginalMeshes)
    else {
        return;
    };
    let Some(module) = context.module(ModuleKind::OriginalMeshes) else {
        return;
    };
    let file = module.file("module.json");
    // One wrong path shows in several of these: each is looked at when those before it are sound.
    for look in [paths, used, order] {
        look(original, &file, findings);
        if !findings.is_empty() {
            return;
        }
    }
    listed(context, original, module, findings);
}

/// Whether every mesh file that `urdd.json` lists is one of the files or side files.
fn listed(
    context: &Context,
    original: &OriginalMeshesModule,
    module: &Module,
    findings: &mut Findings,
) {
    let side_files = original.files.iter().flat_map(|f| &f.side_files);
    let paths = original.files.iter().map(|f| &f.path).chain(side_files);
    let named: HashSet<&str> = paths.map(String::as_str).collect();
    // Where a named file is not there, it has another name: MSH002 tells.
    if named
        .iter()
        .any(|path| entries::look(context, path).is_err())
    {
        return;
    }
    let meshes = module.file("meshes/");
    for entry in entries::all(context) {
        for file in &entry.entry.files {
            let path = file.path.as_str();
            // What is listed and not there is DIR011's.
            if path.starts_with(&meshes)
                && !named.contains(path)
                && entries::look(context, path).is_ok()
            {
                let message = "urdd.json lists a file in `meshes/` that is not named here: name it with the mesh that needs it, or take it out";
                findings.report(
                    Finding::at(module.file("module.json"), "/files", message)
                        .expected(format!("`{path}` as `path` or in `side_files`"))
                        .actual("neither"),
                );
            }
        }
    }
}

/// Whether every reference names one of the files, and the same one for the same name.
fn paths(original: &OriginalMeshesModule, file: &str, findings: &mut Findings) {
    let files: HashSet<&str> = original.files.iter().map(|f| f.path.as_str()).collect();
    let mut by_name: HashMap<&str, Option<&str>> = HashMap::new();
    for (at, reference) in original.references.iter().enumerate() {
        let path = reference.path.as_deref();
        let pointer = format!("/references/{at}/path");
        if let Some(path) = path
            && !files.contains(path)
        {
            findings.report(
                Finding::at(
                    file,
                    pointer,
                    "`files` does not list this file: list it there",
                )
                .expected("the path of one of `files`, or null")
                .actual(format!("`{path}`")),
            );
            continue;
        }
        let first = *by_name.entry(reference.filename.as_str()).or_insert(path);
        if first != path {
            let shown = |path: Option<&str>| path.map_or("null".to_owned(), |p| format!("`{p}`"));
            findings.report(
                Finding::at(
                    file,
                    pointer,
                    format!(
                        "`{}` is another file here than in an earlier reference",
                        reference.filename
                    ),
                )
                .expected(shown(first))
                .actual(shown(path)),
            );
        }
    }
}

/// Whether every file is named by a reference.
fn used(original: &OriginalMeshesModule, file: &str, findings: &mut Findings) {
    let used: HashSet<&str> = original
        .references
        .iter()
        .filter_map(|reference| reference.path.as_deref())
        .collect();
    for (at, carried) in original.files.iter().enumerate() {
        if !used.contains(carried.path.as_str()) {
            findings.report(
                Finding::at(
                    file,
                    format!("/files/{at}"),
                    "no reference names this file: give the reference its path, or leave the file out",
                )
                .expected("a file that a reference names")
                .actual(format!("`{}`", carried.path)),
            );
        }
    }
}

/// Whether each list of files is sorted, each once.
fn order(original: &OriginalMeshesModule, file: &str, findings: &mut Findings) {
    let mut lists = vec![(
        "/files".to_owned(),
        original.files.iter().map(|f| f.path.as_str()).collect(),
    )];
    for (at, carried) in original.files.iter().enumerate() {
        let side: Vec<&str> = carried.side_files.iter().map(String::as_str).collect();
        lists.push((format!("/files/{at}/side_files"), side));
    }
    for (pointer, list) in lists {
        let unsorted = list.windows(2).position(|pair| match pair {
            [before, after] => before >= after,
            _ => false,
        });
        if let Some(at) = unsorted {
            findings.report(
                Finding::at(
                    file,
                    format!("{pointer}/{}", at + 1),
                    "files are sorted by path, byte by byte, each once",
                )
                .expected(format!("a path after `{}`", list.get(at).unwrap_or(&"")))
                .actual(format!("`{}`", list.get(at + 1).unwrap_or(&""))),
            );
        }
    }
}
