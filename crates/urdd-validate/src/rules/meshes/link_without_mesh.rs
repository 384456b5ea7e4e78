use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::robot::Element;
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::ModuleKind;
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
        NotFailed(MSH016),
        Module(Kind::Urdf),
        Module(Kind::PlainMeshes),
        MESHES_LISTED,
        NotFailed(MSH009),
        NotFailed(MSH012),
        LINKS_NAMED,
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(meshes), Some(module)) = (
        context.robot(),
        context.meshes(ModuleKind::PlainMeshes),
        context.module(ModuleKind::PlainMeshes),
    ) else {
        return;
    };
    let usable = UsableGeometry::new(context);
    for (link, named) in robot.links.iter().enumerate() {
        let wanted =
            usable.has(link, GeometryKind::Visual) || usable.has(link, GeometryKind::Collision);
        let there = meshes.count(link) > 0;
        if wanted == there {
            continue;
        }
        let label = context.link_label(link);
        let message = if wanted {
            let mut kinds = shapes("visual", &named.visual);
            kinds.extend(shapes("collision", &named.collision));
            format!(
                "{label} has geometry in urdf_module ({}) but no mesh here, so no program sees it: make one",
                kinds.join(", ")
            )
        } else {
            format!(
                "{label} has no geometry in urdf_module that a mesh could be made from, but a mesh here"
            )
        };
        findings.report(
            Finding::at(module.file("module.json"), meshes.pointer(link), message)
                .expected(if wanted { "a mesh" } else { "null" })
                .actual(match there {
                    true => format!("a mesh for {label}"),
                    false => format!("none for {label}"),
                }),
        );
    }
}

/// The shapes of a link's elements, as `visual Box`.
fn shapes(element: &str, elements: &[Element]) -> Vec<String> {
    let geometries = elements.iter().filter_map(|e| e.geometry.as_ref());
    let named = geometries.map(|geometry| {
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
