use crate::rules::prelude::*;
use urdd_document::schema_check::excerpt;

declare_rule! {
    /// A mesh that the URDF names is not carried.
    ///
    /// The file was not found when the URDD was made. The link lacks this part of its geometry: it is
    /// not shown, and nothing collides with it. Most often a `package://` could not be resolved, or a
    /// file is missing from the package.
    ///
    /// Give the producer the folder of the package, or remove the element from the URDF. Then write the
    /// URDD again.
    SRC007 "mesh-not-carried", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf), Module(Kind::OriginalMeshes), Version1, NotFailed(MSH012), ModuleV1(Kind::OriginalMeshes),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let meshes = document!(context, OriginalMeshes)?;
    for (index, reference) in meshes.references.iter().enumerate() {
        if reference.path.is_some() {
            continue;
        }
        let link = robot.links.get(reference.link_idx.get()).map_or("", |link| &link.name);
        let filename = excerpt(&reference.filename.as_str().into());
        let message = format!("a mesh of link `{link}` was not found and is not carried");
        finding_in(Kind::OriginalMeshes, format!("/references/{index}/path"), message)
            .values("a file", format!("null for {filename} of link `{link}`"))
            .report(findings);
    }
    Some(())
}
