use crate::rules::prelude::*;
use urdd_document::meshes::Meshes;
use urdd_format::meshes::GeometryKind;
use urdd_format::original_meshes::OriginalMeshesModule;
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
    phase References, needs [Module(Kind::Urdf), Module(Kind::OriginalMeshes), NotFailed(MSH001), LINKS_NAMED],
}

/// A mesh that the URDF names: link, kind, element, file name.
type Named<'a> = (usize, GeometryKind, usize, &'a str);

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    match context.document(Kind::OriginalMeshes)? {
        ModuleDocument::OriginalMeshes(original) => references(robot, original, findings),
        _ => {
            let meshes = context.meshes(Kind::OriginalMeshes)?;
            legacy(context, robot, &meshes, findings);
        }
    }
    Some(())
}

/// The meshes that the URDF names, in the order of SPEC 7.5.
fn named(robot: &Robot) -> Vec<Named<'_>> {
    let mut named = Vec::new();
    for (link, elements) in robot.links.iter().enumerate() {
        for kind in [GeometryKind::Visual, GeometryKind::Collision] {
            for (at, element) in elements.elements(kind).iter().enumerate() {
                if let Some(Geometry::Mesh(mesh)) = &element.geometry {
                    named.push((link, kind, at, mesh.filename.as_str()));
                }
            }
        }
    }
    named
}

/// Compares `references` with the robot's meshes.
fn references(robot: &Robot, original: &OriginalMeshesModule, findings: &mut Findings) {
    let shown = |(link, kind, element, filename): &Named| {
        format!("link {link}, {kind:?} {element}, `{filename}`")
    };
    let expected = named(robot);
    let actual: Vec<Named> = (original.references.iter())
        .map(|of| (of.link_idx.get(), of.geometry, of.element_idx.get(), of.filename.as_str()))
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
        let message = format!("one reference for each mesh of urdf_module is needed; {first}");
        finding_in(Kind::OriginalMeshes, place, message)
            .counts(expected.len(), actual.len(), "references")
            .report(findings);
        return;
    }
    for (at, (expected, actual)) in expected.iter().zip(&actual).enumerate() {
        if expected != actual {
            let message = "this is not the mesh that urdf_module has in this place";
            finding_in(Kind::OriginalMeshes, format!("/references/{at}"), message)
                .values(shown(expected), shown(actual))
                .report(findings);
        }
    }
}

/// Legacy: the files of a link are copies of its visual meshes, under their own names.
fn legacy(context: &Context, robot: &Robot, meshes: &Meshes, findings: &mut Findings) {
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
            let message = format!(
                "the URDF does not name this file as a visual mesh of {}",
                context.link_label(link)
            );
            finding_in(Kind::OriginalMeshes, &path.pointer, message)
                .expected(match expected.is_empty() {
                    true => "null: the link has no visual mesh".to_owned(),
                    false => format!("a copy of {}", expected.join(" or ")),
                })
                .actual(format!("`{}`", path.path))
                .report(findings);
        }
    }
}
