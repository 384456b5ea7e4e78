//! CMP: how a robot was put together from others.

use crate::rules::prelude::*;
use urdd_format::composition::CompositionPart;

declare_rule! {
    /// `composition_module` names a link, a joint or a part that is not there.
    ///
    /// A program that follows the index finds nothing, or takes a link of another part for the one that is
    /// meant. Most often the module was left as it was when the robot changed.
    ///
    /// Write the module again, from the robot as it is now.
    CMP001 "composition-index-out-of-range", Error, clause "6.6.2", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND], check index_out_of_range,

    /// The ids of a composed robot's parts do not tell them apart.
    ///
    /// A link of a part is named `id/link`: with two parts of one id, or a slash in an id, nobody knows
    /// which link is meant.
    ///
    /// Give each part an id of its own, without `/`.
    CMP002 "composition-part-ids", Error, clause "6.6.2", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND], check part_ids,

    /// The name of a link or joint is not the name in its part, after the part's prefix.
    ///
    /// Whoever looks for a link of a part puts the prefix before its name. Under another name it is not
    /// found, or another link is.
    ///
    /// Write the name that the link or joint has in the part, and the prefix that all its names have.
    CMP004 "composition-renamed-otherwise", Error, clause "6.6.4", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND, Passed(CMP001), Passed(CMP003)],
    check renamed_otherwise,

    /// A joint that was made fixed, as `composition_module` says, moves, is of another part, or is listed twice.
    ///
    /// A program that reads that a joint was frozen expects no DOF of it. One that frees the joint again puts it at
    /// `position`, a value for each DOF that it had.
    ///
    /// List the part's own joints that moved in it and are fixed here, each once and in ascending order, and no others.
    /// A joint of one DOF has one value, a planar or spherical one three, a floating one six.
    CMP006 "composition-frozen-joint-moves", Error, clause "6.6.6", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND, Passed(CMP001), Passed(CMP003)],
    check frozen_joint_moves,

    /// `composition_module` does not say exactly once where each link and joint came from.
    ///
    /// Each link is one of a part, or that of the base; each joint is one of a part, or the one by which a
    /// part hangs on what carries it. A link that is in no part is left out where a program takes a part by
    /// itself, and one that is in two is taken twice.
    ///
    /// List the links and joints of each part in ascending order, each in one part, and none of its names twice.
    CMP003 "composition-not-one-to-one", Error, clause "6.6.3", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND, Passed(CMP001)], check not_one_to_one,

    /// A part of a composed robot is not attached where `composition_module` says.
    ///
    /// The joints of a part connect its own links; one more joint attaches it to a link of another part, or to the
    /// base. A program that takes a part off, or puts another in its place, cuts the robot at the wrong joint.
    ///
    /// Name the joint above the part's root link, the link that carries that joint, and the part which has this
    /// link.
    CMP005 "composition-attachment-wrong", Error, clause "6.6.5", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND, Passed(CMP001), Passed(CMP003)],
    check attachment_wrong,
}

fn index_out_of_range(context: &Context, findings: &mut Findings) -> Option<()> {
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
        judge("/base/link_idx".to_owned(), "link", base.link_idx.get(), links);
    }
    for (place, part) in composition.parts.iter().enumerate() {
        let at = |rest: String| format!("/parts/{place}/{rest}");
        for (idx, link) in part.links.iter().enumerate() {
            judge(at(format!("links/{idx}/link_idx")), "link", link.link_idx.get(), links);
        }
        for (idx, joint) in part.joints.iter().enumerate() {
            judge(at(format!("joints/{idx}/joint_idx")), "joint", joint.joint_idx.get(), joints);
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

fn part_ids(context: &Context, findings: &mut Findings) -> Option<()> {
    let composition = document!(context, Composition)?;
    let parts = &composition.parts;
    for (place, part) in parts.iter().enumerate() {
        let is_taken = parts[..place].iter().any(|before| before.id == part.id);
        let message = match () {
            () if part.id.is_empty() => "the id is empty",
            () if part.id.contains('/') => "the id contains a `/`",
            () if is_taken => "another part has this id",
            () => continue,
        };
        finding_in(Kind::Composition, format!("/parts/{place}/id"), message)
            .actual(format!("`{}`", part.id))
            .report(findings);
    }
    Some(())
}

fn renamed_otherwise(context: &Context, findings: &mut Findings) -> Option<()> {
    let composition = document!(context, Composition)?;
    let robot = context.robot()?;
    for (place, part) in composition.parts.iter().enumerate() {
        let links = part.links.iter().map(|of| (&of.name, &robot.links[of.link_idx.get()].name));
        let joints = part.joints.iter();
        let joints = joints.map(|of| (&of.name, &robot.joints[of.joint_idx.get()].name));
        let links = links.enumerate().map(|names| ("links", names));
        let joints = joints.enumerate().map(|names| ("joints", names));
        for (key, (idx, (own, name))) in links.chain(joints) {
            let renamed = format!("{}{own}", part.prefix);
            if renamed != *name {
                let message = "prefix and name are not the name in this robot";
                finding_in(Kind::Composition, format!("/parts/{place}/{key}/{idx}/name"), message)
                    .values(format!("`{name}`"), format!("`{renamed}`"))
                    .report(findings);
            }
        }
    }
    Some(())
}

fn frozen_joint_moves(context: &Context, findings: &mut Findings) -> Option<()> {
    let composition = document!(context, Composition)?;
    let robot = context.robot()?;
    for (place, part) in composition.parts.iter().enumerate() {
        let mut before = None;
        for (idx, frozen) in part.frozen_joints.iter().enumerate() {
            let joint = &robot.joints[frozen.joint_idx.get()];
            let mut own = part.joints.iter().map(|of| of.joint_idx);
            let is_own = own.any(|own| own == frozen.joint_idx);
            let ascends = before < Some(frozen.joint_idx);
            before = Some(frozen.joint_idx);
            let message = match (is_own, joint.joint_type, ascends) {
                (true, JointType::Fixed, true) => None,
                (false, _, _) => Some("the joint is not one of the part's"),
                (true, JointType::Fixed, false) => {
                    Some("the frozen joints are not in ascending order")
                }
                (true, _, _) => Some("the joint moves"),
            };
            let at = |key: &str| format!("/parts/{place}/frozen_joints/{idx}/{key}");
            if let Some(message) = message {
                finding_in(Kind::Composition, at("joint_idx"), message)
                    .expected("a fixed joint of the part, after the one before")
                    .actual(format!("joint `{}`, {}", joint.name, joint.joint_type))
                    .report(findings);
            }
            let values = frozen.position.len();
            if !matches!(values, 1 | 3 | 6) {
                let finding =
                    finding_in(Kind::Composition, at("position"), "no joint has so many DOFs");
                findings.report(finding.values("1, 3 or 6 values", values));
            }
        }
    }
    Some(())
}

fn not_one_to_one(context: &Context, findings: &mut Findings) -> Option<()> {
    let composition = document!(context, Composition)?;
    let robot = context.robot()?;
    let mut report = |pointer: String, message: String| {
        finding_in(Kind::Composition, pointer, message).report(findings);
    };
    let mut links: Vec<u32> = vec![0; robot.links.len()];
    let mut joints: Vec<u32> = vec![0; robot.joints.len()];
    if let Some(base) = &composition.base {
        links[base.link_idx.get()] += 1;
    }
    for (place, part) in composition.parts.iter().enumerate() {
        for of in &part.links {
            links[of.link_idx.get()] += 1;
        }
        for of in &part.joints {
            joints[of.joint_idx.get()] += 1;
        }
        if let Some(attachment) = &part.attachment {
            joints[attachment.joint_idx.get()] += 1;
        }
        let link_order = part.links.iter().map(|of| of.link_idx.get());
        let joint_order = part.joints.iter().map(|of| of.joint_idx.get());
        let links: Vec<&String> = part.links.iter().map(|of| &of.name).collect();
        let joints: Vec<&String> = part.joints.iter().map(|of| &of.name).collect();
        for (key, order) in
            [("links", link_order.collect::<Vec<_>>()), ("joints", joint_order.collect())]
        {
            if let Some(at) = order.windows(2).position(|two| two[0] > two[1]) {
                let pointer = format!("/parts/{place}/{key}/{}", at + 1);
                report(pointer, format!("the {key} are not in ascending order"));
            }
        }
        for (key, kept, dropped) in [
            ("dropped_links", links, &part.dropped_links),
            ("dropped_joints", joints, &part.dropped_joints),
        ] {
            let mut seen = BTreeSet::new();
            let mut all = kept.into_iter().chain(dropped);
            if let Some(name) = all.find(|name| !seen.insert(*name)) {
                let message =
                    format!("the part's name `{name}` is here, but also in an earlier entry");
                report(format!("/parts/{place}/{key}"), message);
            }
        }
    }
    for (what, counts) in [("link", &links), ("joint", &joints)] {
        let names = |idx: usize| match what {
            "link" => &robot.links[idx].name,
            _ => &robot.joints[idx].name,
        };
        for (idx, count) in counts.iter().enumerate().filter(|(_, count)| **count != 1) {
            let often = match count {
                0 => "in no part".to_owned(),
                count => format!("listed {count} times"),
            };
            let message = format!("{what} `{}` is {often}", names(idx));
            report("/parts".to_owned(), message);
        }
    }
    Some(())
}

fn has(part: &CompositionPart, link: usize) -> bool {
    part.links.iter().any(|of| of.link_idx.get() == link)
}

fn attachment_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
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
        let Some(attachment) = &part.attachment else { continue };
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
