use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::robot::Robot;
use urdd_format::meshes::GeometryKind;
use urdd_format::original_meshes::OriginalMeshesModule;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::urdf::Geometry;

declare_rule! {
    /// `original_meshes_module` does not list the meshes that the URDF names.
    ///
    /// The module maps every mesh reference of the URDF to the file that is carried for it, so that
    /// nobody has to resolve `package://` again. A reference that is missing, out of order, or of
    /// another file gives a link another link's looks.
    ///
    /// Write `references` in the order of the URDF: links, visual before collision, elements; each
    /// with the file name as the URDF has it. In legacy modules a link's files are those of its visual
    /// meshes.
    MSH009 "mesh-references-differ", Error, clause "7.5", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf),
        Module(Kind::OriginalMeshes),
        NotFailed(MSH001),
        LINKS_NAMED,
    ],
    check check,
}

/// A mesh that the URDF names: link, kind, element, file name.
type Named<'a> = (usize, GeometryKind, usize, &'a str);

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(module)) = (context.robot(), context.module(ModuleKind::OriginalMeshes))
    else {
        return;
    };
    let file = module.file("module.json");
    match context.document(ModuleKind::OriginalMeshes) {
        Some(ModuleDocument::OriginalMeshes(original)) => {
            references(robot, original, &file, findings);
        }
        _ => legacy(context, robot, &file, findings),
    }
}

/// Every mesh of the robot, in the order of SPEC 7.5.
fn named(robot: &Robot) -> Vec<Named<'_>> {
    let mut named = Vec::new();
    for (link, elements) in robot.links.iter().enumerate() {
        for (kind, elements) in [
            (GeometryKind::Visual, &elements.visual),
            (GeometryKind::Collision, &elements.collision),
        ] {
            for (at, element) in elements.iter().enumerate() {
                if let Some(Geometry::Mesh(mesh)) = &element.geometry {
                    named.push((link, kind, at, mesh.filename.as_str()));
                }
            }
        }
    }
    named
}

/// Compares `references` with the robot's meshes.
fn references(robot: &Robot, original: &OriginalMeshesModule, file: &str, findings: &mut Findings) {
    let shown = |(link, kind, element, filename): &Named| {
        format!("link {link}, {kind:?} {element}, `{filename}`")
    };
    let expected = named(robot);
    let actual: Vec<Named> = original
        .references
        .iter()
        .map(|r| {
            (
                r.link_idx.get(),
                r.geometry,
                r.element_idx.get(),
                r.filename.as_str(),
            )
        })
        .collect();
    if expected.len() != actual.len() {
        let differs = (0..).find(|at| expected.get(*at) != actual.get(*at));
        let at = differs.unwrap_or_default();
        let place = match at < actual.len() {
            true => format!("/references/{at}"),
            false => "/references".to_owned(),
        };
        let first = match (expected.get(at), actual.get(at)) {
            (Some(expected), _) => format!("the first that differs should be {}", shown(expected)),
            (None, Some(actual)) => format!("the URDF has no {}", shown(actual)),
            (None, None) => String::new(),
        };
        findings.report(
            Finding::at(
                file,
                place,
                format!("one reference for each mesh of urdf_module is needed; {first}"),
            )
            .expected(format!("{} references", expected.len()))
            .actual(format!("{} references", actual.len())),
        );
        return;
    }
    for (at, (expected, actual)) in expected.iter().zip(&actual).enumerate() {
        if expected != actual {
            findings.report(
                Finding::at(
                    file,
                    format!("/references/{at}"),
                    "this is not the mesh that urdf_module has in this place",
                )
                .expected(shown(expected))
                .actual(shown(actual)),
            );
        }
    }
}

/// Legacy: the files of a link are copies of its visual meshes, under their own names.
fn legacy(context: &Context, robot: &Robot, file: &str, findings: &mut Findings) {
    let Some(meshes) = context.meshes(ModuleKind::OriginalMeshes) else {
        return;
    };
    let base = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or(path).to_owned();
    let mut names: Vec<HashSet<String>> = vec![HashSet::new(); robot.links.len()];
    for (link, kind, _, filename) in named(robot) {
        if kind == GeometryKind::Visual
            && let Some(names) = names.get_mut(link)
        {
            names.insert(base(filename));
        }
    }
    for (link, path) in meshes.paths() {
        let Some(names) = names.get(link) else {
            continue;
        };
        if !names.contains(&base(path.path)) {
            let mut expected: Vec<&str> = names.iter().map(String::as_str).collect();
            expected.sort_unstable();
            findings.report(
                Finding::at(
                    file,
                    &path.pointer,
                    format!(
                        "the URDF does not name this file as a visual mesh of {}",
                        context.link_label(link)
                    ),
                )
                .expected(match expected.is_empty() {
                    true => "null: the link has no visual mesh".to_owned(),
                    false => format!("a copy of {}", expected.join(" or ")),
                })
                .actual(format!("`{}`", path.path)),
            );
        }
    }
}
