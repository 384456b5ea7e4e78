use crate::rules::prelude::*;
use urdd_document::robot::Element;
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::Geometry;

declare_rule! {
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
