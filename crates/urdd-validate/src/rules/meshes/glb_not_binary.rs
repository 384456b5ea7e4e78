use std::io::Read;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::solids::glb_header::{HEADER, header_fault};
use urdd_document::mesh_files::MeshFiles;
use urdd_document::meshes::{DERIVED, Format};

declare_rule! {
    /// A `.glb` file is not binary glTF 2.0.
    ///
    /// By its name it is a binary glTF (GLB): the four letters `glTF`, the version 2 and the file's
    /// length, twelve bytes in all, before the content. Loaders that go by the name fail on anything
    /// else. A common mistake is glTF as JSON, buffers in base64, which is a `.gltf` file; another a
    /// file that was cut off, or a Git LFS pointer.
    ///
    /// Export as binary glTF ("GLB").
    MSH010 "glb-not-binary", Error, clause "7.6", since "0.1.0",
    phase References, needs [
        AnyModule(&[Kind::PlainMeshes, Kind::ConvexHullMeshes, Kind::ConvexDecompositionMeshes]),
        NotFailed(MSH003),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let mut files = MeshFiles::new(context);
    for kind in DERIVED {
        let (Some(meshes), Some(module)) = (context.meshes(*kind), context.module(*kind)) else {
            continue;
        };
        for (_, mesh) in meshes.paths() {
            if mesh.format != Some(Format::Glb) {
                continue;
            }
            // What cannot be opened is told by other rules.
            let Ok((file, size)) = files.open(meshes.profile, mesh.path) else {
                continue;
            };
            let mut header = Vec::with_capacity(HEADER);
            if file.take(HEADER as u64).read_to_end(&mut header).is_err() {
                continue;
            }
            let Some(fault) = header_fault(&header, size) else {
                continue;
            };
            findings.report(
                Finding::at(
                    module.file("module.json"),
                    &mesh.pointer,
                    format!("`{}` is not binary glTF 2.0: {fault}", mesh.path),
                )
                .expected("a GLB header: glTF, version 2, the file's length")
                .actual(fault),
            );
        }
    }
}
