use std::io::Read;

use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;
use crate::validate::views::mesh_files::MeshFiles;
use crate::validate::views::meshes::{DERIVED, Format};

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

/// Length of a GLB's header: magic, version, length.
const HEADER: usize = 12;

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

/// What is wrong with a GLB's header.
fn header_fault(header: &[u8], size: u64) -> Option<String> {
    let word = |at: usize| {
        let bytes = header.get(at..at + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    };
    if header.starts_with(b"{") {
        return Some("it is glTF as JSON (a .gltf file)".to_owned());
    }
    if header.starts_with(b"version http") {
        return Some("it is a Git LFS pointer; fetch the file itself".to_owned());
    }
    if !header.starts_with(b"glTF") {
        return Some("it does not begin with `glTF`".to_owned());
    }
    match (word(4), word(8)) {
        (Some(2), Some(length)) if u64::from(length) == size => None,
        (Some(2), Some(length)) => {
            Some(format!("its header says {length} bytes, and it has {size}"))
        }
        (Some(version), Some(_)) => Some(format!("it is of glTF version {version}")),
        _ => Some(format!("it has only {} bytes", header.len())),
    }
}

#[cfg(test)]
mod tests {
    use super::header_fault;

    fn header(version: u32, length: u32) -> Vec<u8> {
        let mut header = b"glTF".to_vec();
        header.extend(version.to_le_bytes());
        header.extend(length.to_le_bytes());
        header
    }

    #[test]
    fn a_header_is_sound_only_with_magic_version_and_length() {
        assert_eq!(header_fault(&header(2, 100), 100), None);
        assert!(header_fault(&header(2, 100), 99).is_some());
        assert!(header_fault(&header(1, 100), 100).is_some());
        assert!(header_fault(b"{\"accessors\"", 5000).is_some());
        assert!(header_fault(b"version http", 130).is_some());
        assert!(header_fault(b"glTF", 4).is_some());
        assert!(header_fault(b"", 0).is_some());
    }
}
