use crate::rules::prelude::*;

declare_rule! {
    /// `composition_module` names a link, a joint or a part that is not there.
    ///
    /// A program that follows the index finds nothing, or takes a link of another part for the one that is
    /// meant. Most often the module was left as it was when the robot changed.
    ///
    /// Write the module again, from the robot as it is now.
    CMP001 "composition-index-out-of-range", Error, clause "6.6.2", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let composition = document!(context, Composition)?;
    let robot = context.robot()?;
    let mut judge = |pointer: String, what: &str, index: usize, count: usize| {
        if index >= count {
            let finding =
                finding_in(Kind::Composition, pointer, format!("there is no such {what}"));
            findings.report(finding.values(format!("below {count}"), index));
        }
    };
    let (links, joints) = (robot.links.len(), robot.joints.len());
    if let Some(base) = &composition.base {
        let pointer = "/base/link_idx".to_owned();
        judge(pointer, "link", base.link_idx.get(), links);
    }
    for (place, part) in composition.parts.iter().enumerate() {
        let at = |rest: String| format!("/parts/{place}/{rest}");
        for (idx, link) in part.links.iter().enumerate() {
            let pointer = at(format!("links/{idx}/link_idx"));
            judge(pointer, "link", link.link_idx.get(), links);
        }
        for (idx, joint) in part.joints.iter().enumerate() {
            let pointer = at(format!("joints/{idx}/joint_idx"));
            judge(pointer, "joint", joint.joint_idx.get(), joints);
        }
        for (idx, joint) in part.frozen_joints.iter().enumerate() {
            let pointer = at(format!("frozen_joints/{idx}/joint_idx"));
            judge(pointer, "joint", joint.joint_idx.get(), joints);
        }
        if let Some(attachment) = &part.attachment {
            let of = |key: &str| at(format!("attachment/{key}"));
            judge(of("link_idx"), "link", attachment.link_idx.get(), links);
            judge(of("joint_idx"), "joint", attachment.joint_idx.get(), joints);
            if let Some(part) = attachment.part_idx {
                judge(of("part_idx"), "part", part.get(), composition.parts.len());
            }
        }
    }
    Some(())
}
