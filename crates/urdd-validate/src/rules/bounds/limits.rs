//! The DOFs of joints with position limits, and their bounds.

use crate::context::Context;
use crate::tolerance::numbers_agree;
use urdd_document::robot::Joint;
use urdd_format::bounds::BoundsModule;

/// A DOF of a joint with position limits, and the bounds that the module gives it.
pub(in crate::rules) struct LimitedDof<'a> {
    pub dof: usize,
    pub joint: &'a Joint,
    pub limits: [f64; 2],
    pub bounds: [f64; 2],
}

/// Every DOF whose joint has position limits.
pub(in crate::rules) fn limited_dofs(context: &Context) -> Option<Vec<LimitedDof<'_>>> {
    let bounds = context.bounds()?.bounds.iter();
    let dofs = bounds.zip(dofs(context)?).filter_map(|(bounds, (dof, joint))| {
        let (lower, upper) = joint.position_limits()?;
        Some(LimitedDof { dof, joint, limits: [lower, upper], bounds: *bounds })
    });
    Some(dofs.collect())
}

/// Every DOF of the robot with its joint.
pub(in crate::rules) fn dofs(context: &Context) -> Option<impl Iterator<Item = (usize, &Joint)>> {
    let robot = context.robot()?;
    let joints = context.dof_layout()?.joint_of_dof.iter().enumerate();
    Some(joints.filter_map(|(dof, joint)| Some((dof, robot.joints.get(*joint)?))))
}

/// Whether `bounds` and the list of that end agree on a DOF; otherwise BND002 reports it.
pub(in crate::rules) fn columns_agree(bounds: &BoundsModule, dof: usize, end: usize) -> bool {
    let list = [&bounds.dof_lower_bounds, &bounds.dof_upper_bounds][end];
    let pair = bounds.bounds.get(dof);
    pair.zip(list.get(dof)).is_none_or(|(pair, value)| numbers_agree(pair[end], *value))
}

/// By how much legacy modules raised an upper bound equal to the lower one (SPEC 10.3).
pub(in crate::rules) const LEGACY_WIDENING: f64 = 1e-7;
