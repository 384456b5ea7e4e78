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
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
