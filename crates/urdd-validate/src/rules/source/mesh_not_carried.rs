use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::schema_check::excerpt;
use urdd_format::registry::{ModuleDocument, ModuleKind};

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
    phase References, judges AsItStands, needs [Module(Kind::Urdf), Module(Kind::OriginalMeshes), Version1, NotFailed(MSH012)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(module)) = (context.robot(), context.module(ModuleKind::OriginalMeshes))
    else {
        return;
    };
    let Some(ModuleDocument::OriginalMeshes(meshes)) = &module.document else {
        return;
    };
    for (index, reference) in meshes.references.iter().enumerate() {
        if reference.path.is_some() {
            continue;
        }
        let link = robot
            .links
            .get(reference.link_idx.get())
            .map_or("", |link| &link.name);
        findings.report(
            Finding::at(
                module.file("module.json"),
                format!("/references/{index}/path"),
                format!("a mesh of link `{link}` was not found and is not carried"),
            )
            .expected("a file")
            .actual(format!(
                "null for {} of link `{link}`",
                excerpt(&reference.filename.as_str().into())
            )),
        );
    }
}
