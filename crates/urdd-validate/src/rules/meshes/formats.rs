use std::io::BufReader;

use crate::rules::prelude::*;
use crate::solids::derived::{DerivedFile, in_words, noun};
use crate::solids::file::{MeshFault, glb_fault};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_document::mesh_files::MeshFiles;
use urdd_document::meshes::{Mesh, MeshFormat, Meshes};
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

    /// A mesh is not given in the same formats as the others of its module.
    ///
    /// `stl`, `obj` and `glb` are the same mesh for programs that read different formats. A module may
    /// do without `stl`, or without `obj`, and then has null there for every mesh. Here a file has the
    /// extension of another format, or one mesh has a format that another mesh of the module does not
    /// have; in legacy modules, which have one list per format, a link has more meshes in one format
    /// than in another. Then two programs see two different robots.
    ///
    /// Name a file with the format's own extension in each place, and give every mesh of a module in
    /// the same formats.
    MSH003 "mesh-format-mismatch", Error, clause "7.1", since "0.1.0",
    phase References, needs [DERIVED_MESHES, NotFailed(DIR015), NotFailed(MSH001)], check mesh_format_mismatch,
}

fn glb_not_binary(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut files = MeshFiles::new(context);
    for (_, module, meshes) in context.mesh_modules(DERIVED) {
        let paths = meshes.paths();
        for (_, mesh) in paths.filter(|(_, mesh)| mesh.format == Some(MeshFormat::Glb)) {
            // Other rules report files that cannot be opened.
            let Ok((file, size)) = files.open(meshes.profile, mesh.path) else { continue };
            if let Ok(Some(fault)) = glb_fault(BufReader::new(file), size) {
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
        Some(MeshFault::Absent(_)) => None,
        Some(MeshFault::TooLarge(size)) => {
            Some(format!("it is {size} bytes long; the limit is {MAX_DOCUMENT_BYTES}"))
        }
        Some(MeshFault::Broken(why)) => Some(why.clone()),
        None => match (file.format, file.content?) {
            (MeshFormat::Stl, Content::StlBinary)
            | (MeshFormat::Obj, Content::Obj)
            | (MeshFormat::Glb, Content::Glb) => None,
            (MeshFormat::Stl, Content::StlAscii) if profile == Profile::Legacy => None,
            (_, Content::StlAscii) => Some("it is STL as text; write binary STL".to_owned()),
            (_, other) => Some(format!("it has the content of a .{} file", other.extension())),
        },
    }
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

fn mesh_format_mismatch(context: &Context, findings: &mut Findings) -> Option<()> {
    for (kind, module, meshes) in context.mesh_modules(DERIVED) {
        counts(context, &meshes, kind, module, findings);
        formats(context, &meshes, module, findings);
        for (link, mesh) in meshes.paths() {
            let Some(format) = mesh.format else { continue };
            let right = format.extension();
            let name = mesh.path.rsplit('/').next().unwrap_or_default();
            let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
            if !extension.eq_ignore_ascii_case(right) {
                let label = context.link_label(link);
                let message = format!("for {label} this should name a .{right} file");
                finding_in(module, &mesh.pointer, message)
                    .values(format!("a path that ends in .{right}"), format!("`{}`", mesh.path))
                    .report(findings);
            }
        }
    }
    Some(())
}

/// Reports meshes of a module of version 1 that do not have the formats of most meshes.
fn formats(context: &Context, meshes: &Meshes, module: &Module, findings: &mut Findings) {
    let [list] = meshes.lists.as_slice() else { return };
    let links = list.links.iter().enumerate();
    let all = links.flat_map(|(link, meshes)| meshes.iter().map(move |mesh| (link, mesh)));
    for format in [MeshFormat::Stl, MeshFormat::Obj] {
        let given = |mesh: &Mesh| mesh.paths.iter().any(|path| path.format == Some(format));
        let with = all.clone().filter(|(_, mesh)| given(mesh)).count();
        let expected = 2 * with >= all.clone().count();
        for (link, mesh) in all.clone().filter(|(_, mesh)| given(mesh) != expected) {
            let entry = mesh.paths.first().map_or("", |path| &path.pointer);
            let entry = entry.rsplit_once('/').map_or("", |(entry, _)| entry);
            let key = format.extension();
            let word = |given: bool| if given { "a path" } else { "null" };
            let message = format!(
                "{} does not have the formats of the other meshes: write all meshes of the module as {key}, or none",
                context.link_label(link)
            );
            finding_in(module, format!("{entry}/{key}"), message)
                .values(word(expected), word(!expected))
                .report(findings);
        }
    }
}

/// Reports links that have more meshes in one format than in another.
fn counts(
    context: &Context,
    meshes: &Meshes,
    kind: Kind,
    module: &Module,
    findings: &mut Findings,
) {
    for link in 0..meshes.num_links() {
        let counts: Vec<(&str, usize)> = meshes
            .lists
            .iter()
            .filter_map(|list| Some((list.key, list.links.get(link)?.len())))
            .collect();
        // The one that differs from the other two, or the second if all three differ.
        let odd = match counts.as_slice() {
            [(_, a), (key, b), (_, c)] if a == c && a != b => Some((key, b, a)),
            [(key, a), (_, b), (_, c)] if b == c && a != b => Some((key, a, b)),
            [(_, a), (_, b), (key, c)] if a == b && b != c => Some((key, c, a)),
            [(_, a), (key, b), _] if a != b => Some((key, b, a)),
            _ => None,
        };
        let Some((key, actual, expected)) = odd else { continue };
        let what = match kind {
            Kind::ConvexDecompositionMeshes => "pieces",
            _ => "meshes",
        };
        let all: Vec<String> =
            counts.iter().map(|(key, count)| format!("{count} in `{key}`")).collect();
        let message = format!(
            "the formats of {} differ in {what}: {}",
            context.link_label(link),
            all.join(", ")
        );
        finding_in(module, format!("/{key}/{link}"), message)
            .values(format!("{expected} {what}"), format!("{actual} {what}"))
            .report(findings);
    }
}
