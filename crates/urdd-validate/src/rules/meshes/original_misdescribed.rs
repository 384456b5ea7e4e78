use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::solids::file::MeshFault;
use urdd_format::registry::{ModuleDocument, ModuleKind};

declare_rule! {
    /// `usable` or `side_files` of a carried mesh is wrong.
    ///
    /// `usable` says whether the file can be read as a mesh and has a triangle with an area, so
    /// that one need not try; `side_files` are the files that the mesh names in turn and that are
    /// carried with it: materials, buffers, textures. Here a file is called usable and is not, or
    /// the other way round, or the list is not what the mesh names.
    ///
    /// Set `usable` by reading the file, and list the carried files that it names, sorted.
    MSH016 "original-misdescribed", Error, clause "7.5", since "0.1.0",
    phase Geometry, needs [
        Version1, Module(Kind::OriginalMeshes), NotFailed(MSH002), NotFailed(MSH012),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::OriginalMeshes;
    let (Some(ModuleDocument::OriginalMeshes(module)), Some(folder)) =
        (context.document(kind), context.module(kind))
    else {
        return;
    };
    let file = folder.file("module.json");
    for (at, listed) in module.files.iter().enumerate() {
        let Some(original) = context.solids().original(&listed.path) else {
            continue;
        };
        let why = match &original.mesh {
            Ok(_) => None,
            Err(MeshFault::Broken(why)) => Some(why.clone()),
            Err(MeshFault::TooLarge(size)) => Some(format!("it is {size} bytes long")),
            Err(MeshFault::Absent(_)) => continue,
        };
        let usable = why.is_none();
        if usable != listed.usable {
            let message = match &why {
                Some(why) => format!("`{}` cannot be used: {why}", listed.path),
                None => format!("`{}` can be read, and has a surface", listed.path),
            };
            findings.report(
                Finding::at(&file, format!("/files/{at}/usable"), message)
                    .expected(usable)
                    .actual(listed.usable),
            );
        }
        let Some(named) = &original.side_files else {
            continue;
        };
        if *named != listed.side_files {
            let odd = listed
                .side_files
                .iter()
                .position(|side| !named.contains(side));
            let (pointer, message) = match odd {
                Some(odd) => (
                    format!("/files/{at}/side_files/{odd}"),
                    format!(
                        "`{}` does not name `{}`",
                        listed.path, listed.side_files[odd]
                    ),
                ),
                None => (
                    format!("/files/{at}/side_files"),
                    format!("`{}` names other files besides", listed.path),
                ),
            };
            findings.report(
                Finding::at(&file, pointer, message)
                    .expected(format!("{named:?}"))
                    .actual(format!("{:?}", listed.side_files)),
            );
        }
    }
}
