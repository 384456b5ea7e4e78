//! The SRDF: groups, states, end effectors, the virtual joint, passive joints, and pairs.

use super::config::Config;
use crate::names::{ANOTHER, check_names};
use crate::{ExportError, Members, Note, Taken, srdf};
use urdd_srdf::write;
use urdd_xml::number::number;
use urdd_xml::writer::Element;

const NO_GROUPS: &str =
    "MoveIt plans for groups, and there are none: write some in the file of `urdd export init`";

pub(super) fn srdf(config: &Config, notes: &mut Vec<Note>) -> Result<String, ExportError> {
    let subject = config.subject;
    let groups = &config.setup.groups;
    let ends = &config.setup.end_effectors;
    let names: [(&str, Vec<&str>); 3] = [
        ("group", groups.iter().map(|group| group.value.name.as_str()).collect()),
        ("end effector", ends.iter().map(|end| end.value.name.as_str()).collect()),
        ("configuration", config.configurations.iter().map(|it| it.name.as_str()).collect()),
    ];
    for (what, names) in names {
        check_names(subject.format, what, names.into_iter(), ANOTHER)?;
    }
    if groups.is_empty() {
        notes.push(Note::Robot(NO_GROUPS));
    }
    let mut robot = Element::new("robot").with("name", subject.urdf.name.as_str());
    for group in groups {
        robot.push(self::group(config, &group.value.name, &group.value.members));
    }
    states(config, &mut robot);
    for end in ends {
        let end = &end.value;
        let parent = end.parent_group.map(|group| groups[group].value.name.as_str());
        robot.push(
            Element::new("end_effector")
                .with("name", end.name.as_str())
                .with("parent_link", subject.links[end.parent_link].as_str())
                .with("group", groups[end.group].value.name.as_str())
                .with_some("parent_group", parent),
        );
    }
    let root = subject.tree.root;
    if !subject.is_world(root) {
        let kind = if config.setup.floating.value { "floating" } else { "fixed" };
        let mut taken = Taken::new(subject.view.joints.iter().map(|joint| &joint.name));
        robot.push(
            Element::new("virtual_joint")
                .with("name", taken.free("virtual_joint".to_owned()))
                .with("type", kind)
                .with("parent_frame", "world")
                .with("child_link", subject.links[root].as_str()),
        );
    }
    for joint in passive(config) {
        robot.push(Element::new("passive_joint").with("name", config.joint(joint)));
    }
    srdf::push_pairs(subject, &mut robot);
    notes.extend(subject.notes());
    Ok(robot.document(&subject.comments(srdf::basis(subject)?, notes)?))
}

fn group(config: &Config, name: &str, members: &Members) -> Element {
    let mut group = write::group(name);
    match members {
        Members::Chain { base, tip } => {
            let [base, tip] = [base, tip].map(|link| config.subject.links[*link].as_str());
            group.push(Element::new("chain").with("base_link", base).with("tip_link", tip));
        }
        Members::Joints(joints) => {
            for joint in joints {
                group.push(write::joint(config.joint(*joint)));
            }
        }
        Members::Groups(groups) => {
            for other in groups {
                let name = config.setup.groups[*other].value.name.as_str();
                group.push(write::group(name));
            }
        }
    }
    group
}

/// A state of each group for each named configuration that sets one of its joints.
fn states(config: &Config, robot: &mut Element) {
    for (group, joints) in config.setup.groups.iter().zip(&config.joints) {
        for named in config.configurations {
            let is_set = |joint: &&usize| {
                let name = config.joint(**joint);
                named.positions.iter().any(|set| set.dof_name == name)
            };
            if !joints.iter().any(|joint| is_set(&joint)) {
                continue;
            }
            let driven = joints.iter().filter(|joint| config.subject.is_driven(**joint));
            let values = driven.map(|joint| {
                (config.joint(*joint), number(config.position(&named.configuration, *joint)))
            });
            robot.push(write::state(named.name.as_str(), &group.value.name, values));
        }
    }
}

/// The joints that follow others, and those of passive groups.
fn passive(config: &Config) -> Vec<usize> {
    let subject = config.subject;
    let joints = 0..subject.view.joints.len();
    let mut passive: Vec<usize> = joints
        .filter(|joint| subject.view.joints[*joint].num_dofs() > 0 && !subject.moves(*joint))
        .collect();
    for (group, joints) in config.setup.groups.iter().zip(&config.joints) {
        if group.value.passive {
            passive.extend(joints);
        }
    }
    passive.sort_unstable();
    passive.dedup();
    passive
}
