use crate::rules::prelude::*;
use urdd_format::composition::CompositionPart;

declare_rule! {
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
