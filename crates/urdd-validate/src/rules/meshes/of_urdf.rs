use crate::rules::prelude::*;
use crate::solids::placed;
use urdd_document::meshes::Meshes;
use urdd_document::robot::Element;
use urdd_document::usable_geometry::UsableGeometry;
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
    check mesh_references_differ,

    /// A link's mesh is not its geometry in its place.
    ///
    /// The plain mesh of a link is what the URDF shows there: the triangles of each mesh that it names,
    /// scaled, turned and moved as the URDF says, and its boxes, cylinders, capsules and spheres,
    /// tessellated. Here it is something else. Often a scale or an origin was left out, a second element
    /// of the link was forgotten, or two links wrote the same file, so that one has the other's mesh.
    /// Everything that is made from the mesh is wrong then too: hull, pieces, boxes, distances.
    ///
    /// Write it again, from the carried meshes. Vertices may differ by the rounding of binary32.
    MSH015 "mesh-misplaced", Error, clause "7.8", since "0.1.0",
    phase Geometry, consequence WrongPlace, needs [
        Module(Kind::Urdf), Module(Kind::OriginalMeshes), Module(Kind::PlainMeshes), NotFailedInV1(MSH001),
        NotFailed(MSH003), NotFailed(MSH008), NotFailedInV1(MSH009), NotFailedInV1(MSH012), NotFailed(MSH016),
    ], check mesh_misplaced,

    /// A link has geometry in the URDF and no mesh here, or a mesh here and no geometry in the URDF.
    ///
    /// A link without a mesh has no hull, no box and no distances either: every collision check
    /// passes over it in silence. Converters that read mesh files only lose boxes, cylinders and
    /// spheres in this way.
    ///
    /// Tessellate the link's boxes, cylinders, capsules and spheres; use its collision geometry where it has no
    /// visual geometry; and write the mesh and link shape modules again. A link needs no mesh when its
    /// only geometry is meshes that could not be found.
    MSH011 "link-without-mesh", Error, clause "7.2", since "0.1.0",
    phase References, needs [
        NotFailed(MSH016), Module(Kind::Urdf), Module(Kind::PlainMeshes), MESHES_LISTED, NotFailed(MSH009),
        NotFailed(MSH012), LINKS_NAMED,
    ], check link_without_mesh,

    /// `geometry` names the wrong source for a link's mesh.
    ///
    /// A mesh is made from the kind of geometry that `preferred_geometry` names, `Visual` or
    /// `Collision`, and from the other kind only where a link has nothing usable of the first. A
    /// program that shows or collides links must be able to tell which of the two it sees.
    ///
    /// Write `geometry` as the mesh was really made; where the mesh itself was made from the wrong
    /// elements, write the mesh modules again.
    MSH008 "wrong-geometry-used", Error, clause "7.4", since "0.1.0",
    phase References, consequence WrongPlace, needs [
        Version1, Module(Kind::Urdf), ModuleV1(Kind::PlainMeshes), NoneFailed(&[MSH001, MSH009, MSH012, MSH011, MSH016]),
        // The entry of another link has the geometry of another link.
        NotFailed(MSH006), NotFailed(MSH007), LINKS_NAMED,
    ], check wrong_geometry_used,
}

/// A mesh that the URDF names: link, kind, element, file name.
type Named<'a> = (usize, GeometryKind, usize, &'a str);

fn mesh_references_differ(context: &Context, findings: &mut Findings) -> Option<()> {
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
        let Some(names) = names.get(link) else { continue };
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

fn mesh_misplaced(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = context.module(Kind::PlainMeshes)?;
    for (link, why) in &context.placed().unknown {
        findings.not_verified(Part::Plain(*link), *why);
    }
    for wrong in &context.placed().wrong {
        let label = context.link_label(wrong.link);
        let owner = placed::owner(context, context.solids(), wrong.link);
        let hint = owner.map_or_else(String::new, |owner| {
            format!("; it is the mesh of {}", context.link_label(owner))
        });
        let message = format!(
            "the mesh of {label} is not its geometry in the URDF, at its place: {}{hint}",
            wrong.what
        );
        finding_in(module, &wrong.pointer, message)
            .values(&wrong.expected, &wrong.actual)
            .tolerance(wrong.tolerance)
            .part(Part::Plain(wrong.link))
            .report(findings);
    }
    Some(())
}

fn link_without_mesh(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let meshes = context.meshes(Kind::PlainMeshes)?;
    let usable = UsableGeometry::new(context);
    for (link, named) in robot.links.iter().enumerate() {
        let has = |kind| usable.has(link, kind);
        let wanted = has(GeometryKind::Visual) || has(GeometryKind::Collision);
        if wanted == (meshes.count(link) > 0) {
            continue;
        }
        let label = context.link_label(link);
        let mut kinds = shapes("visual", &named.visual);
        kinds.extend(shapes("collision", &named.collision));
        let finding = |message| finding_in(Kind::PlainMeshes, meshes.pointer(link), message);
        findings.report(match wanted {
            true => finding(format!(
                "{label} has geometry in urdf_module ({}) but no mesh here, so no program sees it: make one",
                kinds.join(", ")
            ))
            .values("a mesh", format!("none for {label}")),
            false => finding(format!(
                "{label} has no geometry in urdf_module that a mesh could be made from, but a mesh here"
            ))
            .values("null", format!("a mesh for {label}")),
        });
    }
    Some(())
}

/// The shapes of a link's elements, as `visual Box`.
fn shapes(element: &str, elements: &[Element]) -> Vec<String> {
    let named = elements.iter().filter_map(|e| e.geometry.as_ref()).map(|geometry| {
        let shape = match geometry {
            Geometry::Mesh(_) => "Mesh",
            Geometry::Box(_) => "Box",
            Geometry::Cylinder(_) => "Cylinder",
            Geometry::Capsule(_) => "Capsule",
            Geometry::Sphere(_) => "Sphere",
        };
        format!("{element} {shape}")
    });
    let mut named: Vec<String> = named.collect();
    named.dedup();
    named
}

fn wrong_geometry_used(context: &Context, findings: &mut Findings) -> Option<()> {
    let plain = document!(context, PlainMeshes)?;
    let usable = UsableGeometry::new(context);
    let preferred = plain.preferred_geometry;
    let other = match preferred {
        GeometryKind::Visual => GeometryKind::Collision,
        GeometryKind::Collision => GeometryKind::Visual,
    };
    for (link, mesh) in plain.link_meshes.iter().enumerate() {
        let (expected, why) = match usable.has(link, preferred) {
            true => (preferred, "it has geometry of the preferred kind"),
            false => (other, "it has none of the preferred kind"),
        };
        if let Some(mesh) = mesh
            && mesh.geometry != expected
        {
            let message = format!(
                "preferred_geometry is {preferred:?}, and for {} this must be {expected:?}: {why}",
                context.link_label(link)
            );
            finding_in(Kind::PlainMeshes, format!("/link_meshes/{link}/geometry"), message)
                .literals(expected, mesh.geometry)
                .report(findings);
        }
    }
    Some(())
}
