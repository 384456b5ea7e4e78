use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::part::Part;
use crate::rule::declare_rule;
use crate::solids::derived::noun;
use crate::solids::surface::extent;
use crate::tolerance::mesh_resolution;
use urdd_document::meshes::DERIVED;

declare_rule! {
    /// The files of one mesh hold different surfaces.
    ///
    /// `stl`, `obj` and `glb` are one mesh, so that a program may read whichever it likes. Here they have
    /// not the same triangles: then what a robot looks like, and what it runs into, depends on the file
    /// that somebody's loader prefers. Order, and how vertices are shared, do not matter; triangles
    /// without an area count for nothing. Often one file is left from an earlier run, or one exporter
    /// turned the axes (vertices of a `.glb` are in link axes here, whatever glTF says of up).
    ///
    /// Write all three from the same triangles.
    MSH014 "mesh-formats-differ", Error, clause "7.6", since "0.1.0",
    phase Geometry, consequence WrongPlace, needs [
        AnyModule(&[Kind::PlainMeshes, Kind::ConvexHullMeshes, Kind::ConvexDecompositionMeshes]),
        NotFailed(MSH003),
        OWN_FILES,
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    for kind in DERIVED {
        let Some(module) = context.module(*kind) else {
            continue;
        };
        for mesh in context.solids().derived(*kind) {
            let (Some(read), Some(first)) = (&mesh.mesh, mesh.files.get(mesh.mesh_of)) else {
                continue;
            };
            let part = Part::of(*kind, mesh.link, mesh.piece);
            if part.is_some_and(|part| !findings.judges(part, &[])) {
                continue;
            }
            for (at, difference) in &mesh.differences {
                let Some(file) = mesh.files.get(*at) else {
                    continue;
                };
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        &file.pointer,
                        format!(
                            "this is not the same {} of {} as `{}`: {}",
                            noun(*kind),
                            context.link_label(mesh.link),
                            first.path,
                            difference.in_words()
                        ),
                    )
                    .expected(format!(
                        "the {} triangles of `{}`",
                        read.triangles.len(),
                        first.path
                    ))
                    .actual(format!("`{}`", file.path))
                    .tolerance(mesh_resolution(extent(read)))
                    .part(part),
                );
            }
        }
    }
}
