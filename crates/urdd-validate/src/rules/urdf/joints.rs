use super::tree::circles;
use crate::reference::urdf_text::compare::first_names;
use crate::rules::prelude::*;

declare_rule! {
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
