//! The degrees of freedom of a robot (SPEC 5.8).

use std::f64::consts::PI;
use std::ops::Range;

use super::robot::{Joint, Robot, dofs};
use urdd_format::dof::Quantity;
use urdd_format::urdf::JointType;

/// The degrees of freedom of a robot, in joint order.
#[derive(Debug, Clone)]
pub struct DofLayout {
    /// DOFs of each joint.
    pub dofs_of_joint: Vec<Range<usize>>,
    /// Joint of each DOF.
    pub joint_of_dof: Vec<usize>,
}

impl DofLayout {
    /// The degrees of freedom of a robot. With `mimics_too`, mimic joints have their own.
    pub fn new(robot: &Robot, mimics_too: bool) -> DofLayout {
        let mut layout = DofLayout {
            dofs_of_joint: Vec::with_capacity(robot.joints.len()),
            joint_of_dof: Vec::new(),
        };
        for (index, joint) in robot.joints.iter().enumerate() {
            let start = layout.joint_of_dof.len();
            let dofs = if mimics_too { joint.num_dofs() } else { own_dofs(joint) };
            layout.joint_of_dof.extend((0..dofs).map(|_| index));
            layout.dofs_of_joint.push(start..start + dofs);
        }
        layout
    }

    /// The joint of a DOF, and its place among that joint's DOFs.
    pub fn place(&self, dof: usize) -> Option<(usize, usize)> {
        let joint = *self.joint_of_dof.get(dof)?;
        let first = self.dofs_of_joint.get(joint)?.start;
        Some((joint, dof.checked_sub(first)?))
    }
}

/// Number of DOFs that a joint contributes to the robot. A mimic joint of a single-DOF type contributes none.
pub fn own_dofs(joint: &Joint) -> usize {
    match (joint.num_dofs(), &joint.mimic) {
        (1, Some(_)) => 0,
        (dofs, _) => dofs,
    }
}

/// The suffix that a DOF's name adds to its joint's name (empty for a joint with one DOF), and the quantity that it
/// measures. `place` is its place among the joint's DOFs.
pub fn describe(joint_type: JointType, place: usize) -> Option<(&'static str, Quantity)> {
    dofs(joint_type).get(place).copied()
}

/// Bounds of an unlimited DOF (SPEC 6.5.3). `place` is its place among the joint's DOFs.
pub fn bounds_without_limits(joint_type: JointType, place: usize) -> Option<[f64; 2]> {
    let (_, quantity) = describe(joint_type, place)?;
    let end = match quantity {
        Quantity::Angle => PI,
        Quantity::Length => 1.0,
    };
    Some([-end, end])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As SPEC 5.8 counts them.
    #[test]
    fn every_dof_of_every_joint_type_is_described() {
        let numbers = JointType::ALL.iter().map(|joint_type| {
            let described = (0..).take_while(|place| describe(*joint_type, *place).is_some());
            (*joint_type, described.count())
        });
        let stated = [
            (JointType::Revolute, 1),
            (JointType::Continuous, 1),
            (JointType::Prismatic, 1),
            (JointType::Fixed, 0),
            (JointType::Floating, 6),
            (JointType::Planar, 3),
            (JointType::Spherical, 3),
        ];
        assert_eq!(numbers.collect::<Vec<_>>(), stated);
    }
}
