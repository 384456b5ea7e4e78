use crate::rules::prelude::*;
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::meshes::GeometryKind;

declare_rule! {
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
        Version1,
        Module(Kind::Urdf),
        ModuleV1(Kind::PlainMeshes),
        NotFailed(MSH001),
        NotFailed(MSH009),
        NotFailed(MSH012),
        NotFailed(MSH011),
        NotFailed(MSH016),
        // The entry of another link has the geometry of another link.
        NotFailed(MSH006),
        NotFailed(MSH007),
        LINKS_NAMED,
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
