//! `bounds_module` from the robot and its DOFs: SPEC 6.5.

use std::f64::consts::PI;

use urdd_format::bounds::BoundsModule;
use urdd_format::dof::{DofModule, Quantity};
use urdd_format::urdf::{JointType, UrdfModule};

pub(super) fn bounds_module(robot: &UrdfModule, dof: &DofModule) -> BoundsModule {
    let mut module = BoundsModule {
        bounds: Vec::new(),
        dof_lower_bounds: Vec::new(),
        dof_upper_bounds: Vec::new(),
        dof_limited: Vec::new(),
        dof_velocity_limits: Vec::new(),
        dof_effort_limits: Vec::new(),
    };
    for dof in &dof.dofs {
        let joint = &robot.joints[dof.joint_idx.get()];
        let limit = joint.limit.as_ref();
        let kind = joint.joint_type;
        let can_be_limited = matches!(kind, JointType::Revolute | JointType::Prismatic);
        let written = limit
            .filter(|limit| can_be_limited && (limit.lower.is_some() || limit.upper.is_some()));
        let [lower, upper] = match (written, dof.quantity) {
            (Some(limit), _) => [limit.lower.unwrap_or(0.0), limit.upper.unwrap_or(0.0)],
            (None, Quantity::Angle) => [-PI, PI],
            (None, Quantity::Length) => [-1.0, 1.0],
        };
        let of_one_dof = limit.filter(|_| can_be_limited || kind == JointType::Continuous);
        module.bounds.push([lower, upper]);
        module.dof_lower_bounds.push(lower);
        module.dof_upper_bounds.push(upper);
        module.dof_limited.push(written.is_some());
        let velocity = of_one_dof.and_then(|limit| limit.velocity);
        let effort = of_one_dof.and_then(|limit| limit.effort);
        module.dof_velocity_limits.push(velocity);
        module.dof_effort_limits.push(effort);
    }
    module
}
