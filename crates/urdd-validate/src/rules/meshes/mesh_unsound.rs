use crate::rules::prelude::*;
use crate::solids::derived::DerivedFile;
use crate::solids::file::MeshFault;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_document::meshes::Format;
use urdd_geometry::read::Format as Content;

declare_rule! {
    /// A mesh file is not a sound mesh in its format.
    ///
    /// A file of a mesh, hull or piece cannot be read, is cut off, has no triangle, a coordinate that is
    /// not finite, or an index of a vertex that is not there; or it is of another format than its name
    /// says. Some loaders refuse it, others show a part of it.
    ///
    /// Write it again: binary STL with as many triangles as its header counts, Wavefront OBJ,
    /// binary glTF 2.0. (MSH010 reports a `.glb` whose header or chunks are wrong.)
    MSH013 "mesh-unsound", Error, clause "7.6", since "0.1.0",
    phase Geometry, needs [DERIVED_MESHES, NotFailed(MSH003)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for (kind, module, meshes) in context.mesh_modules(DERIVED) {
        for mesh in context.solids().derived(kind) {
            for file in &mesh.files {
                if let Some(fault) = fault(file, meshes.profile) {
                    finding_in(module, &file.pointer, format!("`{}`: {fault}", file.path))
                        .values(expected(file.format), fault)
                        .report(findings);
                }
            }
        }
    }
    Some(())
}

fn fault(file: &DerivedFile, profile: Profile) -> Option<String> {
    if file.not_glb {
        return None;
    }
    match &file.fault {
        Some(MeshFault::Absent(_)) => return None,
        Some(MeshFault::TooLarge(size)) => {
            return Some(format!("it is {size} bytes long; the limit is {MAX_DOCUMENT_BYTES}"));
        }
        Some(MeshFault::Broken(why)) => return Some(why.clone()),
        None => {}
    }
    let right = match (file.format, file.content?) {
        (Format::Stl, Content::StlBinary)
        | (Format::Obj, Content::Obj)
        | (Format::Glb, Content::Glb) => true,
        (Format::Stl, Content::StlAscii) => profile == Profile::Legacy,
        _ => false,
    };
    (!right).then(|| match file.content {
        Some(Content::StlAscii) => "it is STL as text; write binary STL".to_owned(),
        Some(content) => format!("it has the content of a .{} file", content.extension()),
        None => "it is not a mesh".to_owned(),
    })
}

fn expected(format: Format) -> &'static str {
    match format {
        Format::Stl => "a binary STL file",
        Format::Obj => "a Wavefront OBJ file",
        Format::Glb => "a binary glTF 2.0 file",
    }
}
