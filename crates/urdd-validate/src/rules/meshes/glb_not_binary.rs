use std::io::Read;

use crate::rules::prelude::*;
use crate::solids::glb_header::{HEADER, header_fault};
use urdd_document::mesh_files::MeshFiles;
use urdd_document::meshes::Format;

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
    phase References, needs [DERIVED_MESHES, NotFailed(MSH003)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut files = MeshFiles::new(context);
    for (_, module, meshes) in context.mesh_modules(DERIVED) {
        let paths = meshes.paths();
        for (_, mesh) in paths.filter(|(_, mesh)| mesh.format == Some(Format::Glb)) {
            // Other rules report files that cannot be opened.
            let Ok((file, size)) = files.open(meshes.profile, mesh.path) else {
                continue;
            };
            let mut header = Vec::with_capacity(HEADER);
            let read = file.take(HEADER as u64).read_to_end(&mut header);
            if read.is_ok()
                && let Some(fault) = header_fault(&header, size)
            {
                let message = format!("`{}` is not binary glTF 2.0: {fault}", mesh.path);
                Finding::of(module, &mesh.pointer, message)
                    .expected("a GLB header: glTF, version 2, the file's length")
                    .actual(fault)
                    .report(findings);
            }
        }
    }
    Some(())
}
