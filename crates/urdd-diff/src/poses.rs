//! Where the links are, relative to the root link, with all joints at zero.

use nalgebra::{Matrix3, Vector3};
use std::collections::HashMap;

use crate::side::Side;
use urdd_document::robot::Robot;
use urdd_document::tree::Tree;
use urdd_format::diff_report::PoseDifference;

/// Differences up to this, metres and radians, are due to rounding.
const ROUNDING: f64 = 1e-9;

type Pose = (Matrix3<f64>, Vector3<f64>);

/// The links that are elsewhere; `None` if there are none, or if the joints of one robot form no tree.
pub(super) fn difference(before: &Side, after: &Side, tolerance: f64) -> Option<PoseDifference> {
    let tolerance = tolerance.max(ROUNDING);
    let (a, b) = (poses(&before.view)?, poses(&after.view)?);
    let by_name: HashMap<&str, &Pose> = after.link_names().into_iter().zip(&b).collect();
    let mut found: Option<PoseDifference> = None;
    for (name, (turn, place)) in before.link_names().into_iter().zip(&a) {
        let Some((other_turn, other_place)) = by_name.get(name) else { continue };
        let distance = (other_place - place).norm();
        // Half of the norm of the difference is the sine of half the angle, times the square root of 2.
        let sine = (other_turn - turn).norm() / (2.0 * std::f64::consts::SQRT_2);
        let angle = 2.0 * sine.clamp(0.0, 1.0).asin();
        let is_finite = distance.is_finite() && angle.is_finite();
        if !is_finite || (distance <= tolerance && angle <= tolerance) {
            continue;
        }
        let found = found.get_or_insert_with(|| PoseDifference {
            links: Vec::new(),
            farthest: name.to_owned(),
            distance,
            angle,
        });
        found.links.push(name.to_owned());
        found.angle = found.angle.max(angle);
        if distance > found.distance {
            (found.distance, found.farthest) = (distance, name.to_owned());
        }
    }
    found
}

/// The pose of each link in the frame of the root link.
fn poses(robot: &Robot) -> Option<Vec<Pose>> {
    let tree = Tree::new(robot)?;
    let mut poses = vec![(Matrix3::identity(), Vector3::zeros()); robot.links.len()];
    for &link in &tree.order {
        let (Some(parent), Some(joint)) = (tree.parent_link[link], tree.parent_joint[link]) else {
            continue;
        };
        let origin = robot.joints.get(joint)?.origin;
        let (turn, place) = poses[parent];
        poses[link] = (turn * origin.rotation(), place + turn * Vector3::from(origin.xyz));
    }
    Some(poses)
}
