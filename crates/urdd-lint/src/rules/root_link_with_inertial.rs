use super::prelude::*;
use crate::inertial::mass;

declare_lint! {
    /// The root link has a mass.
    ///
    /// KDL, which ROS uses in `robot_state_publisher`, loses it, and warns: `KDL does not support a root link with an
    /// inertia`. Other programs take it.
    ///
    /// Where KDL computes dynamics, put an empty root link above, with a fixed joint. Leave it in a robot that floats:
    /// PyBullet gives an empty root 1 kg.
    LNT007 "root-link-with-inertial", Info, WrongMotion, since "1.1.0", off by default
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let root = bodies.tree.root;
    let has_mass = mass(&robot.links[root]).is_some_and(|mass| mass != 0.0);
    if has_mass && robot.links.len() > 1 {
        let message = "the root link has an inertial, which KDL leaves out; where KDL computes dynamics, put an empty root link above it";
        urdf.at(urdf.links[root], message).report(findings);
    }
    Some(())
}
