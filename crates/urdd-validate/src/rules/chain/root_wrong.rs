use crate::rules::prelude::*;

declare_rule! {
    /// `root_idx` is not the root link.
    ///
    /// Forward kinematics starts at the root with the identity. From another link, only what is below
    /// that link is ever reached.
    ///
    /// The root is the one link that is not the child of a joint.
    CHN006 "root-wrong", Error, clause "6.3.3", since "0.1.0",
    phase References, needs [Passed(CHN002)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let root = context.tree()?.root;
    let written = context.chain()?.root_idx;
    if written.get() != root {
        let name = &robot.links.get(root)?.name;
        let message = format!(
            "the root is link {root} ({name:?}), which no joint of urdf_module has as its child"
        );
        finding_in(Kind::Chain, "/root_idx", message).values(root, written).report(findings);
    }
    Some(())
}
