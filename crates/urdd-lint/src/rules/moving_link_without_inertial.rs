use super::prelude::*;
use crate::inertial::mass;
use urdd_format::urdf::JointType;

declare_lint! {
    /// A joint moves links of which none has a mass.
    ///
    /// MuJoCo fills collision shapes with 1000 kg/m³, and refuses the robot where the links have none. PyBullet
    /// gives such a link 1 kg, Pinocchio 0 kg. Gazebo leaves out the link with its joint. Links that fixed joints hold together count as one.
    ///
    /// Write an `<inertial>`, or make the joint `fixed`.
    LNT006 "moving-link-without-inertial", Warning, WrongMotion, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let has_mass = |link: usize| mass(&robot.links[link]).is_some_and(|mass| mass != 0.0);
    // SRC003 tells of a moving link that says 0.
    let says_zero = |link: usize| mass(&robot.links[link]) == Some(0.0);
    let moves = |joint: &usize| robot.joints[*joint].joint_type != JointType::Fixed;
    if !(0..robot.links.len()).any(has_mass) {
        let is_told = bodies.tops().any(says_zero);
        if !is_told && (0..robot.joints.len()).any(|joint| moves(&joint)) {
            let message = "no link has a mass; write an `<inertial>` for each";
            urdf.at(urdf.root, message).report(findings);
        }
        return Some(());
    }
    for top in bodies.tops() {
        let Some(joint) = bodies.tree.parent_joint[top].filter(moves) else {
            continue;
        };
        if !bodies.members(top).any(has_mass) && !says_zero(top) {
            let message = format!(
                "joint `{}` moves this link, and it has no mass; write an `<inertial>`",
                robot.joints[joint].name
            );
            urdf.at(urdf.links[top], message).report(findings);
        }
    }
    Some(())
}
