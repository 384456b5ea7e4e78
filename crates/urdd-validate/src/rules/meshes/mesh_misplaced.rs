use crate::rules::prelude::*;
use crate::solids::placed;

declare_rule! {
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
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
