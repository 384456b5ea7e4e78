//! That the robot is a tree of links, and that its joints can be moved.

use crate::reference::urdf_text::compare::first_names;
use crate::rules::prelude::*;

declare_rule! {
    /// The robot has several roots, or no link at all.
    ///
    /// The root is the one link that is not the child of a joint; all poses are in its frame. With two
    /// such links the robot is in parts that no joint connects: readers keep one part, or refuse.
    ///
    /// Connect the parts by joints (a fixed one will do) in the URDF, or make each a robot of its
    /// own. Then write the URDD again.
    URD004 "not-one-root", Error, clause "6.1.4", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD005)], of Robot, check not_one_root,

    /// A link is the child of two joints.
    ///
    /// A URDF is a tree. A link with two parents would have two poses; readers take one of them, or
    /// refuse. Closed chains (parallel grippers, delta robots) cannot be written this way.
    ///
    /// Keep one of the joints in the URDF, and say in NAME.loops.toml beside it what closes the chain: the
    /// URDD has it in `loops_module` then, and `urdd export mjcf` writes `<connect>` or `<weld>`. (Drake
    /// takes `<drake:ball_constraint>`, PyBullet `createConstraint`, Pinocchio a constraint model.) Where a joint follows another one at a constant rate,
    /// as in many grippers, `<mimic>` is enough. Then write the URDD again.
    URD005 "link-with-two-parents", Error, clause "6.1.4", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD003), Passed(URD007)], of Robot, check two_parents,

    /// A joint names a parent or child link that does not exist.
    ///
    /// The joint connects nothing: no tree can be built, and nothing that is derived from the tree has
    /// a meaning. Most often a link was renamed and its joints were not, or a part of the robot was
    /// left out.
    ///
    /// Correct the name, or add the link, in the URDF, and write the URDD again.
    URD007 "unknown-link", Error, clause "6.1.4", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD002)], of Robot, check unknown_link,

    /// Joints connect links in a circle.
    ///
    /// A URDF is a tree: from every link, going from parent to parent ends at the root. Links in a
    /// circle, and the links below them, have no pose. A program that walks the tree may never end.
    ///
    /// Swap parent and child of one of the joints, or remove the joint, in the URDF. Then write the URDD
    /// again.
    URD006 "links-in-a-circle", Error, clause "6.1.4", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD005)], of Robot, check cycle,

    /// Two links have one name.
    ///
    /// Joints, skips and most programs say which link they mean by its name. With two of one name
    /// each reader takes the one it finds first, or last.
    ///
    /// Give every link a different name in the URDF, and write the URDD again.
    URD002 "duplicate-link-name", Error, clause "6.1.3", since "0.1.0",
    phase References, needs [Module(Kind::Urdf)], of Robot, check |described, findings| repeated_name(described, "link", findings),

    /// Two joints have one name.
    ///
    /// Mimics, joint states, commands and controllers say which joint they mean by its name. With
    /// two of one name the wrong motor may turn. (A joint and a link may share a name.)
    ///
    /// Give every joint a different name in the URDF, and write the URDD again.
    URD003 "duplicate-joint-name", Error, clause "6.1.3", since "0.1.0",
    phase References, needs [Module(Kind::Urdf)], of Robot, check |described, findings| repeated_name(described, "joint", findings),

    /// A joint that needs an axis has an axis without a direction.
    ///
    /// Made a unit vector, a zero vector is 0/0, and every pose below the joint becomes NaN. An axis is
    /// reported too when the square of its length is 0 or infinite in binary64. Fixed, floating and
    /// spherical joints do not use their axis: it may be anything.
    ///
    /// Give the joint an axis in the URDF (without one it is `1 0 0`), and write the URDD again.
    URD010 "zero-axis", Error, clause "6.1.6", since "0.1.0",
    phase References, needs [Module(Kind::Urdf)], of Robot, check zero_axis,

    /// A mimic joint names a joint that does not exist.
    ///
    /// The joint has no DOF of its own and nothing to follow, so its position is unknown. Most often
    /// the driver was renamed, or its part of the robot was left out. (`<mimic>` on a fixed joint has no
    /// meaning and is ignored.)
    ///
    /// Correct `joint` of the `<mimic>`, or remove the `<mimic>`, in the URDF. Then write the URDD again.
    URD008 "unknown-mimic-driver", Error, clause "6.1.5", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD003)], of Robot, check unknown_mimic_driver,

    /// Mimic joints follow each other in a circle.
    ///
    /// A mimic joint must lead, directly or through other mimic joints, to a joint that follows
    /// nothing. In a circle, no joint has a position of its own. A joint that follows itself is one too.
    ///
    /// Remove the `<mimic>` of the joint that is driven, in the URDF, and write the URDD again.
    URD009 "mimics-in-a-circle", Error, clause "6.1.5", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD008)], of Robot, check mimic_circle,

    /// A mimic joint, or the joint that it follows, has more than one DOF.
    ///
    /// `multiplier * position + offset` says how one number follows from one number. For a planar,
    /// floating or spherical joint it has no meaning.
    ///
    /// Take the `<mimic>` out of the joint, or write the joint as several joints of one DOF, in the
    /// URDF, and write the URDD again.
    URD012 "mimic-of-many-dofs", Error, clause "6.1.5", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD008)], of Robot, check mimic_of_many_dofs,
}

fn not_one_root(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    let children: HashSet<usize> =
        (robot.joints.iter()).filter_map(|joint| robot.link(&joint.child)).collect();
    let links = robot.links.iter().enumerate();
    let roots = links.filter(|(index, _)| !children.contains(index));
    let roots: Vec<&str> = roots.map(|(_, link)| link.name.as_str()).collect();
    let (message, actual) = match roots.len() {
        0 if robot.links.is_empty() => ("the robot has no link", "no link".to_owned()),
        // Without a root, all links are in circles: URD006 reports these.
        0 | 1 => return Some(()),
        count => (
            "the links are not one tree: connect these links by joints",
            format!("{count}: {}", first_names(&roots)),
        ),
    };
    finding_in(described, "/links", message)
        .values("one link that is not the child of a joint", actual)
        .report(findings);
    Some(())
}

fn two_parents(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    let mut held_by: HashMap<&str, (usize, &str)> = HashMap::new();
    for (index, joint) in robot.joints.iter().enumerate() {
        let link = &joint.child;
        let (first, other) = *held_by.entry(link).or_insert((index, &joint.name));
        if first != index {
            let message = format!(
                "link `{link}` is the child of joint `{}` and of joint `{other}`; a link has one parent",
                joint.name
            );
            finding_in(described, format!("/joints/{index}/child/link"), message)
                .expected("a link that no other joint has as its child")
                .actual(format!("`{link}`, child of /joints/{first} too"))
                .report(findings);
        }
    }
    Some(())
}

fn unknown_link(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        for (end, link) in [("parent", &joint.parent), ("child", &joint.child)] {
            if robot.link(link).is_none() {
                let message = format!("{end} of joint `{}` is not a link of the robot", joint.name);
                finding_in(described, format!("/joints/{index}/{end}/link"), message)
                    .values("the name of a link", format!("`{link}`"))
                    .report(findings);
            }
        }
    }
    Some(())
}

fn cycle(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for circle in circles(&parents(robot)) {
        let links = circle.iter().filter_map(|link| robot.links.get(*link));
        let names: Vec<&str> = links.map(|link| link.name.as_str()).collect();
        let message = format!(
            "{} form a cycle, each the child of the next: remove one of their joints, or swap its parent and child",
            first_names(&names)
        );
        finding_in(described, format!("/links/{}", circle.first()?), message)
            .expected("a path from every link to the root")
            .actual(format!("a cycle of {} links", circle.len()))
            .report(findings);
    }
    Some(())
}

/// The parent link of each link.
fn parents(robot: &Robot) -> Vec<Option<usize>> {
    let mut parents = vec![None; robot.links.len()];
    for joint in &robot.joints {
        if let (Some(parent), Some(child)) = (robot.link(&joint.parent), robot.link(&joint.child))
            && let Some(slot) = parents.get_mut(child)
        {
            *slot = Some(parent);
        }
    }
    parents
}

/// The circles of a map, each starting at its lowest member.
pub fn circles(next: &[Option<usize>]) -> Vec<Vec<usize>> {
    // The walk that first reached each member.
    let mut walk_of: Vec<Option<usize>> = vec![None; next.len()];
    let mut circles = Vec::new();
    for start in 0..next.len() {
        let mut at = start;
        let closes = loop {
            match walk_of.get_mut(at) {
                Some(walk @ None) => *walk = Some(start),
                Some(Some(walk)) => break *walk == start,
                None => break false,
            }
            match next.get(at).copied().flatten() {
                Some(then) => at = then,
                None => break false,
            }
        };
        if closes {
            // Starts are ascending, but a walk may enter a circle anywhere.
            let mut circle = vec![at];
            while let Some(then) = circle.last().and_then(|last| next.get(*last).copied().flatten())
                && then != at
            {
                circle.push(then);
            }
            let lowest = circle.iter().enumerate().min_by_key(|(_, member)| **member);
            let place = lowest.map_or(0, |(place, _)| place);
            circle.rotate_left(place);
            circles.push(circle);
        }
    }
    circles
}

/// Reports each repeated name of a `link` or a `joint`.
fn repeated_name(described: &Described, one: &str, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    let names: Vec<&str> = match one {
        "link" => robot.links.iter().map(|link| link.name.as_str()).collect(),
        _ => robot.joints.iter().map(|joint| joint.name.as_str()).collect(),
    };
    for (index, first, name) in repeated(names.into_iter()) {
        let at = |index: usize, message: String| {
            finding_in(described, format!("/{one}s/{index}/name"), message)
        };
        let message =
            format!("another {one} is already named `{name}`; give this one a name of its own");
        at(index, message)
            .values(format!("a name that no other {one} has"), format!("`{name}`"))
            .related(at(first, format!("the first {one} of this name")))
            .report(findings);
    }
    Some(())
}

fn zero_axis(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        if joint.has_axis() && !has_direction(joint.axis) {
            let (name, kind) = (&joint.name, joint.joint_type);
            let message = format!("the axis of joint `{name}` ({kind}) has no direction");
            finding_in(described, format!("/joints/{index}/axis/xyz"), message)
                .values("a vector other than zero", format!("{:?}", joint.axis))
                .report(findings);
        }
    }
    Some(())
}

/// Whether the vector can be normalised in binary64.
pub fn has_direction(axis: [f64; 3]) -> bool {
    axis.iter().map(|x| x * x).sum::<f64>().is_normal()
}

fn unknown_mimic_driver(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        if let Some(mimic) = joint.active_mimic()
            && robot.joint(&mimic.joint).is_none()
        {
            let name = &joint.name;
            let message = format!("joint `{name}` follows a joint that the robot does not have");
            finding_in(described, format!("/joints/{index}/mimic/joint"), message)
                .values("the name of a joint", format!("`{}`", mimic.joint))
                .report(findings);
        }
    }
    Some(())
}

fn mimic_circle(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    let joints = robot.joints.iter();
    let follows = joints.map(|joint| robot.joint(&joint.active_mimic()?.joint));
    for circle in circles(&follows.collect::<Vec<_>>()) {
        let joints = circle.iter().filter_map(|joint| robot.joints.get(*joint));
        let names: Vec<&str> = joints.map(|joint| joint.name.as_str()).collect();
        let message = match names.as_slice() {
            [name] => format!("joint `{name}` follows itself"),
            _ => format!(
                "joints {} follow each other in a cycle, each the next",
                first_names(&names)
            ),
        };
        finding_in(described, format!("/joints/{}/mimic/joint", circle.first()?), message)
            .expected("a joint that leads to one that follows nothing")
            .actual(format!("a circle of {}", names.len()))
            .report(findings);
    }
    Some(())
}

fn mimic_of_many_dofs(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(mimic) = joint.active_mimic() else { continue };
        let name = &joint.name;
        let driver = robot.joints.get(robot.joint(&mimic.joint)?)?;
        let (message, culprit) = if joint.num_dofs() > 1 {
            let message = format!("joint `{name}` is a mimic, but has several DOFs");
            (message, joint)
        } else if driver.num_dofs() > 1 && driver.active_mimic().is_none() {
            let followed = &driver.name;
            let message =
                format!("joint `{name}` follows joint `{followed}`, which has several DOFs");
            (message, driver)
        } else {
            continue;
        };
        let (kind, dofs) = (culprit.joint_type, culprit.num_dofs());
        finding_in(described, format!("/joints/{index}/mimic"), message)
            .values("a joint of one DOF, or a fixed one", format!("{kind}, with {dofs} DOFs"))
            .report(findings);
    }
    Some(())
}

/// Names that occurred before: index, index of the first occurrence, name.
pub fn repeated<'a>(
    names: impl Iterator<Item = &'a str>,
) -> impl Iterator<Item = (usize, usize, &'a str)> {
    let mut seen: HashMap<&str, usize> = HashMap::new();
    names.enumerate().filter_map(move |(index, name)| {
        let first = *seen.entry(name).or_insert(index);
        (first != index).then_some((index, first, name))
    })
}
