use crate::rules::prelude::*;
use urdd_document::dof_layout::bounds_without_limits;
use urdd_document::robot::Joint;
use urdd_format::bounds::BoundsModule;

declare_rule! {
    /// A DOF without limits does not have the bounds that SPEC 6.5.3 gives it.
    ///
    /// Bounds are always finite, so that any program can sample them. For a DOF without limits they are
    /// [-pi, pi] for an angle and [-1, 1] for a length. In published URDDs such joints often have
    /// [0, 1e-7], made from limits that are absent: to a planner these joints do not move at all.
    ///
    /// Write these intervals for every DOF that is not limited, those of continuous joints included. If
    /// the joint should have limits, give it some in the URDF. (Legacy modules may repeat what limits the
    /// joint has; only frozen DOFs, and bounds of no known origin, are reported.)
    BND006 "unlimited-bounds-wrong", Error, clause "6.5.3", since "0.1.0",
    phase References, needs [Passed(DOF005), Passed(BND001)], check unlimited_bounds_wrong,
}

fn unlimited_bounds_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let layout = context.dof_layout()?;
    let bounds = context.bounds()?;
    for (pair, (dof, joint)) in bounds.bounds.iter().zip(dofs(context)?) {
        if joint.position_limits().is_some() {
            continue;
        }
        let (_, place) = layout.place(dof)?;
        let ends = bounds_without_limits(joint.joint_type, place)?;
        if agree(*pair, ends) {
            continue;
        }
        let kind = joint.joint_type;
        if context.is_legacy(Kind::Bounds) {
            let is_one = columns_agree(bounds, dof, 0) && columns_agree(bounds, dof, 1);
            if is_one && !legacy_copy(*pair, joint) {
                let message = match is_frozen(*pair) {
                    true => format!(
                        "joint {:?} ({kind}, without limits) cannot move within these bounds: write {ends:?}, or give the joint limits in the URDF",
                        joint.name
                    ),
                    false => format!(
                        "joint {:?} ({kind}) has no limits in the URDF, and these are not the bounds of a DOF without limits",
                        joint.name
                    ),
                };
                finding_in(Kind::Bounds, format!("/bounds/{dof}"), message)
                    .literals(ends, pair)
                    .report(findings);
            }
            continue;
        }
        for (end, (right, written)) in ends.into_iter().zip(*pair).enumerate() {
            if !numbers_agree(right, written) && columns_agree(bounds, dof, end) {
                let pointer = format!("/bounds/{dof}/{end}");
                let message = format!(
                    "DOF {dof} of joint {:?} ({kind}) has no limits, and this is not the bound of a DOF without limits",
                    joint.name
                );
                finding_in(Kind::Bounds, pointer, message)
                    .numbers(right, written, number_tolerance(right, written))
                    .report(findings);
            }
        }
    }
    Some(())
}

fn agree(a: [f64; 2], b: [f64; 2]) -> bool {
    numbers_agree(a[0], b[0]) && numbers_agree(a[1], b[1])
}

/// Whether a legacy module repeats the joint's limits and leaves it a range.
fn legacy_copy(pair: [f64; 2], joint: &Joint) -> bool {
    let limit = joint.limit;
    let end = |end: Option<f64>| end.unwrap_or(0.0);
    let ends = limit.map_or([0.0; 2], |limit| [end(limit.lower), end(limit.upper)]);
    agree(pair, ends) && !is_frozen(pair)
}

/// Whether bounds leave no range, or only the one that legacy modules added.
pub fn is_frozen([lower, upper]: [f64; 2]) -> bool {
    (upper - lower).abs() <= LEGACY_WIDENING + NUMBER_ABSOLUTE
}

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
