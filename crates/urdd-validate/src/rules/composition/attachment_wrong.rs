use crate::rules::prelude::*;
use urdd_format::composition::CompositionPart;

declare_rule! {
    /// A part of a composed robot is not attached where `composition_module` says.
    ///
    /// The joints of a part connect its own links; one more joint attaches it to a link of another part, or to the
    /// base. A program that takes a part off, or puts another in its place, cuts the robot at the wrong joint.
    ///
    /// Name the joint above the part's root link, the link that carries that joint, and the part which has this
    /// link.
    CMP005 "composition-attachment-wrong", Error, clause "6.6.5", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND, Passed(CMP001), Passed(CMP003)],
}

fn has(part: &CompositionPart, link: usize) -> bool {
    part.links.iter().any(|of| of.link_idx.get() == link)
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let composition = document!(context, Composition)?;
    let robot = context.robot()?;
    let parts = &composition.parts;
    let mut report = |pointer: String, message: &str| {
        finding_in(Kind::Composition, pointer, message).report(findings);
    };
    let ends = |joint: usize| {
        let joint = &robot.joints[joint];
        let of = |name: &str| robot.link(name).unwrap_or(robot.links.len());
        (of(&joint.parent), of(&joint.child))
    };
    for (place, part) in parts.iter().enumerate() {
        for (idx, joint) in part.joints.iter().enumerate() {
            let (parent, child) = ends(joint.joint_idx.get());
            if !(has(part, parent) && has(part, child)) {
                let pointer = format!("/parts/{place}/joints/{idx}");
                report(pointer, "the joint does not connect two links of the part");
            }
        }
        let Some(attachment) = &part.attachment else {
            continue;
        };
        let link = attachment.link_idx.get();
        let (parent, child) = ends(attachment.joint_idx.get());
        let is_there = match attachment.part_idx {
            Some(carrier) => has(&parts[carrier.get()], link),
            None => (composition.base.as_ref()).is_some_and(|base| base.link_idx.get() == link),
        };
        let at = |key: &str| format!("/parts/{place}/attachment/{key}");
        if !is_there {
            let message = "the link is not of the part that is named, or not the base";
            report(at("link_idx"), message);
        } else if parent != link {
            report(at("link_idx"), "the joint is not attached to this link");
        }
        if !has(part, child) {
            let message = "the joint does not move a link of the part";
            report(at("joint_idx"), message);
        }
    }
    let roots = parts.iter().filter(|part| part.attachment.is_none()).count();
    let expected = usize::from(composition.base.is_none());
    if roots != expected {
        let message = "exactly one part without `attach`, or none if there is a base";
        finding_in(Kind::Composition, "/parts", message).values(expected, roots).report(findings);
    }
    Some(())
}
