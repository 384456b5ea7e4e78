use crate::rules::prelude::*;
use crate::solids::derived::noun;
use crate::solids::difference::in_words;
use urdd_geometry::surface::extent;

declare_rule! {
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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
