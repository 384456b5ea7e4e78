use std::io::BufReader;

use crate::rules::prelude::*;
use crate::solids::derived::{DerivedFile, in_words, noun};
use crate::solids::file::MeshFault;
use crate::solids::glb_chunks;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_document::mesh_files::MeshFiles;
use urdd_document::meshes::MeshFormat;
use urdd_geometry::read::Format as Content;
use urdd_geometry::surface::extent;

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
    phase References, needs [DERIVED_MESHES, NotFailed(MSH003)], check glb_not_binary,

    /// A mesh file is not a sound mesh in its format.
    ///
    /// A file of a mesh, hull or piece cannot be read, is cut off, has no triangle, a coordinate that is
    /// not finite, or an index of a vertex that is not there; or it is of another format than its name
    /// says. Some loaders refuse it, others show a part of it.
    ///
    /// Write it again: binary STL with as many triangles as its header counts, Wavefront OBJ,
    /// binary glTF 2.0. (MSH010 reports a `.glb` whose header or chunks are wrong.)
    MSH013 "mesh-unsound", Error, clause "7.6", since "0.1.0",
    phase Geometry, needs [DERIVED_MESHES, NotFailed(MSH003)], check mesh_unsound,

    /// The files of one mesh hold different surfaces.
    ///
    /// `stl`, `obj` and `glb` are one mesh, so that a program may read whichever it likes. Here they do
    /// not have the same triangles: then what a robot looks like, and what it runs into, depends on the
    /// file that somebody's loader prefers. Order, and how vertices are shared, do not matter;
    /// triangles without an area are ignored. Often one file is left from an earlier run, or one
    /// exporter turned the axes (vertices of a `.glb` are in link axes here, whatever glTF says of up).
    ///
    /// Write all three from the same triangles.
    MSH014 "mesh-formats-differ", Error, clause "7.6", since "0.1.0",
    phase Geometry, consequence WrongPlace, needs [DERIVED_MESHES, NotFailed(MSH003), OWN_FILES],
    check mesh_formats_differ,
}

fn glb_not_binary(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut files = MeshFiles::new(context);
    for (_, module, meshes) in context.mesh_modules(DERIVED) {
        let paths = meshes.paths();
        for (_, mesh) in paths.filter(|(_, mesh)| mesh.format == Some(MeshFormat::Glb)) {
            // Other rules report files that cannot be opened.
            let Ok((file, size)) = files.open(meshes.profile, mesh.path) else { continue };
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

fn mesh_unsound(context: &Context, findings: &mut Findings) -> Option<()> {
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
        (MeshFormat::Stl, Content::StlBinary)
        | (MeshFormat::Obj, Content::Obj)
        | (MeshFormat::Glb, Content::Glb) => true,
        (MeshFormat::Stl, Content::StlAscii) => profile == Profile::Legacy,
        _ => false,
    };
    (!right).then(|| match file.content {
        Some(Content::StlAscii) => "it is STL as text; write binary STL".to_owned(),
        Some(content) => format!("it has the content of a .{} file", content.extension()),
        None => "it is not a mesh".to_owned(),
    })
}

fn expected(format: MeshFormat) -> &'static str {
    match format {
        MeshFormat::Stl => "a binary STL file",
        MeshFormat::Obj => "a Wavefront OBJ file",
        MeshFormat::Glb => "a binary glTF 2.0 file",
    }
}

fn mesh_formats_differ(context: &Context, findings: &mut Findings) -> Option<()> {
    for (kind, module, _) in context.documents(DERIVED) {
        for mesh in context.solids().derived(kind) {
            let (Some(read), Some(first)) = (&mesh.mesh, mesh.files.get(mesh.mesh_of)) else {
                continue;
            };
            let part = Part::of(kind, mesh.link, mesh.piece);
            if part.is_some_and(|part| !findings.judges(part, &[])) {
                continue;
            }
            let (triangles, first) = (read.triangles.len(), &first.path);
            for (at, difference) in &mesh.differences {
                let file = mesh.files.get(*at)?;
                let message = format!(
                    "this is not the same {} of {} as `{first}`: {}",
                    noun(kind),
                    context.link_label(mesh.link),
                    in_words(difference)
                );
                finding_in(module, &file.pointer, message)
                    .expected(format!("the {triangles} triangles of `{first}`"))
                    .actual(format!("`{}`", file.path))
                    .tolerance(mesh_resolution(extent(read)))
                    .part(part)
                    .report(findings);
            }
        }
    }
    Some(())
}
