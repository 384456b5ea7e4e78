use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::{ModuleDocument, ModuleKind};

declare_rule! {
    /// An edit of the skips names a link that the robot has not.
    ///
    /// The edit does nothing, and the collision checks that a person wanted skipped, or not skipped,
    /// are as they were. Most often a link was renamed.
    ///
    /// Write the link's name as `urdf_module` has it, or take the edit out.
    SHP014 "unknown-link-in-edit", Error, clause "8.7", since "0.1.0",
    phase References, needs [
        Version1,
        Module(Kind::Urdf),
        Module(Kind::LinkShapesSkips),
        NotFailed(CHN001),
        LINKS_NAMED,
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesSkips;
    let (Some(ModuleDocument::LinkShapesSkips(skips)), Some(module), Some(robot)) = (
        context.document(kind),
        context.module(kind),
        context.robot(),
    ) else {
        return;
    };
    for (place, edit) in skips.edits.iter().enumerate() {
        for (key, name) in [("link_a", &edit.link_a), ("link_b", &edit.link_b)] {
            if robot.link(name).is_none() {
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        format!("/edits/{place}/{key}"),
                        "the robot has no link of this name",
                    )
                    .expected("the name of a link of urdf_module")
                    .actual(format!("`{name}`")),
                );
            }
        }
    }
}
