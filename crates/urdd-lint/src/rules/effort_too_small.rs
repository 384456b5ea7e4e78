use nalgebra::Isometry3;

use super::prelude::*;
use crate::pose::{at_default, default_position};
use urdd_document::pose::unit;
use urdd_document::robot::{Joint, Robot};
use urdd_document::tree::Mimics;
use urdd_format::readable;
use urdd_format::urdf::JointType;
use urdd_kinematics::{Load, gather};

declare_lint! {
    /// The effort of a joint's limit is too small to hold the links beyond the joint against gravity.
    ///
    /// Programs that keep to the limit let the joint sag. An arm that needs 3.9 N m and has the effort 3 fell by 1.1 rad in
    /// MuJoCo 4.0 and Drake 1.51, which keep to it for every motor, and by 1 rad in PyBullet where the limit was given as the
    /// motor's force. With 4.5, it stayed.
    ///
    /// Each joint is at 0, or at the limit nearest to it, and gravity is along -z of the root link. A joint holds what is beyond
    /// the joints that mimic it, too. Left out: joints that gravity pushes against a stop within 0.01 rad or m, and links
    /// with `<turnGravityOff>`.
    ///
    /// Write what the motor can do, in N m, or N for a prismatic joint: `<limit effort="3">` becomes
    /// `<limit effort="30">`. If the motor is that weak, correct the masses, or balance the arm. `urdd info --statics` says
    /// what each joint of a URDD needs.
    LNT062 "effort-too-small", Warning, WrongMotion, since "1.3.0"
}

/// m/s², along -z of the root link.
const GRAVITY: f64 = 9.81;
/// A joint that is no farther from its stop sags no farther, rad or m.
const SLACK: f64 = 0.01;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let tree = &bodies.tree;
    let poses = at_default(robot, tree);
    let weightless = weightless(urdf);
    let own = robot.links.iter().zip(&poses).map(|(link, pose)| match &link.inertial {
        Some(inertial) if !weightless.contains(link.name.as_str()) => {
            Load::new(inertial.mass.unwrap_or(0.0), inertial.origin.xyz.into(), pose)
        }
        _ => Load::default(),
    });
    let mut loads: Vec<Load> = own.collect();
    let up = tree.order.iter().rev();
    gather(&mut loads, up.filter_map(|child| Some((tree.parent_link[*child]?, *child))));

    // A joint that others follow holds what is beyond them too.
    let mimics = Mimics::resolve(robot).map(|mimics| mimics.by_joint);
    let mimic = |joint: usize| mimics.as_ref().and_then(|all| all[joint]);
    let followed: BTreeSet<usize> =
        (0..robot.joints.len()).filter_map(|joint| Some(mimic(joint)?.driver)).collect();
    let mut needed = vec![0.0; robot.joints.len()];
    for (index, joint) in robot.joints.iter().enumerate() {
        let child = tree.joint_links[index].1;
        let effort = effort(joint, &poses[child], &loads[child]);
        let (driver, factor) =
            mimic(index).map_or((index, 1.0), |mimic| (mimic.driver, mimic.multiplier));
        needed[driver] += factor * effort;
    }
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(limit) = joint.limit.and_then(|limit| limit.effort) else {
            continue;
        };
        let needed = needed[index];
        if limit <= 0.0
            || needed.abs() <= limit
            || mimic(index).is_some()
            || is_at_stop(robot, joint, needed)
        {
            continue;
        }
        let unit = if joint.joint_type == JointType::Prismatic { "N" } else { "N m" };
        let mass = loads[tree.joint_links[index].1].mass;
        let [needed, limit, mass] =
            [needed.abs(), limit, mass].map(|value| readable::number(value, 3));
        let others = if followed.contains(&index) { " and what its followers hold" } else { "" };
        let message = format!(
            "in the default configuration, the joint needs {needed} {unit} to hold the {mass} kg beyond it{others}, and `effort` \
            is {limit}: it sags; write what the motor can do, in {unit}"
        );
        let node = urdf.joints[index];
        urdf.at_attribute(child(node, "limit").unwrap_or(node), "effort", message).report(findings);
    }
    Some(())
}

/// The links that Gazebo turns gravity off for.
fn weightless<'a>(urdf: &Subject<'a>) -> BTreeSet<&'a str> {
    let links = named(urdf.root, "gazebo").filter_map(|node| {
        let text = child(node, "turnGravityOff")?.text()?.trim();
        matches!(text, "true" | "True" | "1").then(|| node.attribute("reference"))?
    });
    links.collect()
}

/// What a joint of one degree of freedom must give to hold a load, N m or N.
fn effort(joint: &Joint, child: &Isometry3<f64>, load: &Load) -> f64 {
    let (Some(centre), Some(axis)) = (load.centre(), unit(joint.axis)) else {
        return 0.0;
    };
    let axis = child.rotation * axis;
    let lift = match joint.joint_type {
        JointType::Prismatic => axis.z,
        JointType::Revolute | JointType::Continuous => {
            axis.cross(&(centre.coords - child.translation.vector)).z
        }
        _ => 0.0,
    };
    GRAVITY * load.mass * lift
}

/// Whether gravity pushes a joint against its stop, or nearly.
fn is_at_stop(robot: &Robot, joint: &Joint, needed: f64) -> bool {
    joint.position_limits().is_some_and(|(lower, upper)| {
        let position = default_position(robot, joint);
        let left = if needed > 0.0 { position - lower } else { upper - position };
        left <= SLACK
    })
}
