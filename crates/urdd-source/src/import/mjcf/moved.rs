//! What a joint moves: an entry of the diagonal of the mass matrix, which MuJoCo makes ratios of damping with.

use nalgebra::Matrix3;

use super::super::model::{Body, JointKind};
use super::made::Made;

/// The inertia about the axis of a joint, kg m², or the mass along it, kg, of all that hangs on it, where all joints are at
/// their references, with the inertia of its motor.
pub fn moved(made: &Made, (body, joint): (usize, usize)) -> f64 {
    let joint = &made.bodies[body].joints[joint];
    let origin = joint.frame.translation.vector;
    let axis = (joint.frame.rotation * joint.axis).try_normalize(0.0).unwrap_or_default();
    let mut sum = joint.armature.unwrap_or(0.0);
    // The pose of each body that hangs on it in the joint's body.
    let mut poses = vec![None; made.bodies.len()];
    poses[body] = Some(nalgebra::Isometry3::identity());
    for (index, Body { parent, pose, inertial, .. }) in made.bodies.iter().enumerate().skip(body) {
        let above = parent.and_then(|parent| poses[parent]);
        poses[index] = poses[index].or(above.map(|above| above * pose));
        let (Some(pose), Some(of)) = (poses[index], inertial) else { continue };
        sum += match joint.kind {
            JointKind::Slide => of.mass,
            JointKind::Hinge | JointKind::Ball => {
                let turn: Matrix3<f64> = pose.rotation.to_rotation_matrix().into_inner();
                let arm = axis.cross(&((pose * of.centre).coords - origin));
                axis.dot(&(turn * of.inertia * turn.transpose() * axis))
                    + of.mass * arm.norm_squared()
            }
        };
    }
    sum
}
