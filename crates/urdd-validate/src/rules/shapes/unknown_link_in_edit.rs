use crate::rules::prelude::*;

declare_rule! {
    /// An edit of the skips names a link that the robot does not have.
    ///
    /// The edit does nothing, and the collision checks that a person wanted skipped, or not skipped,
    /// are as they were. Most often a link was renamed.
    ///
    /// Write the link's name as `urdf_module` has it, or take the edit out.
    SHP014 "unknown-link-in-edit", Error, clause "8.7", since "0.1.0",
    phase References, needs [
        Version1, Module(Kind::Urdf), ModuleV1(Kind::LinkShapesSkips), NotFailed(CHN001), LINKS_NAMED,
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let skips = document!(context, LinkShapesSkips)?;
    let robot = context.robot()?;
    for (place, edit) in skips.edits.iter().enumerate() {
        for (key, name) in [("link_a", &edit.link_a), ("link_b", &edit.link_b)] {
            if robot.link(name).is_none() {
                let message = "the robot has no link of this name";
                finding_in(Kind::LinkShapesSkips, format!("/edits/{place}/{key}"), message)
                    .values("the name of a link of urdf_module", format!("`{name}`"))
                    .report(findings);
            }
        }
    }
    Some(())
}
