use crate::rules::prelude::*;
use crate::solids::file::MeshFault;

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
    phase Geometry, needs [Version1, ModuleV1(Kind::OriginalMeshes), NotFailed(MSH002), NotFailed(MSH012)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let original = document!(context, OriginalMeshes)?;
    for (at, listed) in original.files.iter().enumerate() {
        let Some(read) = context.solids().original(&listed.path) else {
            continue;
        };
        let path = &listed.path;
        let (usable, message) = match &read.mesh {
            Ok(_) => (true, format!("`{path}` can be read, and has a surface")),
            Err(MeshFault::Broken(why)) => (false, format!("`{path}` cannot be used: {why}")),
            Err(MeshFault::TooLarge(size)) => {
                (false, format!("`{path}` cannot be used: it is {size} bytes long"))
            }
            Err(MeshFault::Absent(_)) => continue,
        };
        if usable != listed.usable {
            let finding = finding_in(Kind::OriginalMeshes, format!("/files/{at}/usable"), message);
            findings.report(finding.values(usable, listed.usable));
        }
        if let Some(named) = &read.side_files
            && *named != listed.side_files
        {
            let mut pointer = format!("/files/{at}/side_files");
            let mut sides = listed.side_files.iter().enumerate();
            let message = match sides.find(|(_, side)| !named.contains(side)) {
                Some((odd, side)) => {
                    pointer += &format!("/{odd}");
                    format!("`{path}` does not name `{side}`")
                }
                None => format!("`{path}` also names other files"),
            };
            finding_in(Kind::OriginalMeshes, pointer, message)
                .literals(named, &listed.side_files)
                .report(findings);
        }
    }
    Some(())
}
