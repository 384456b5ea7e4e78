use std::io::BufReader;

use crate::rules::prelude::*;
use crate::solids::glb_chunks;
use urdd_document::mesh_files::MeshFiles;
use urdd_document::meshes::Format;

declare_rule! {
    /// A `.glb` file is not binary glTF 2.0.
    ///
    /// By its name it is a binary glTF (GLB): the four letters `glTF`, the version 2 and the file's
    /// length, twelve bytes in all, and then chunks up to the end of the file. The first chunk is
    /// the JSON, and each has a length that is a multiple of four. Loaders that go by the name fail
    /// on anything else, or read a part of it. A common mistake is glTF as JSON, buffers in base64,
    /// which is a `.gltf` file; another a file that was cut off, or a Git LFS pointer.
    ///
    /// Export as binary glTF ("GLB"), and pad the JSON with spaces and the data with zeros.
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
            if let Ok(Some(fault)) = glb_chunks::fault(BufReader::new(file), size) {
                let message = format!("`{}` is not binary glTF 2.0: {fault}", mesh.path);
                finding_in(module, &mesh.pointer, message)
                    .values("glTF, version 2, the file's length, and chunks up to its end", fault)
                    .report(findings);
            }
        }
    }
    Some(())
}
