//! BND: `bounds_module`.

use crate::rules::prelude::*;
use urdd_document::dof_layout::bounds_without_limits;
use urdd_document::robot::Joint;
use urdd_format::bounds::BoundsModule;

declare_rule! {
    /// A list of `bounds_module` does not hold one entry per DOF.
    ///
    /// A configuration has `num_dofs` numbers (`dof_module`), and a planner that reads bounds of
    /// another length fails, or worse, bounds the wrong joint. Most often the module is stale: it
    /// was written before the joints or the way in which mimic joints are counted changed.
    ///
    /// Write `bounds_module` again from the same URDF as `dof_module`.
    BND001 "bound-count-wrong", Error, clause "6.5.1", since "0.1.0",
    phase References, needs [Module(Kind::Bounds), Passed(DOF003)], check bound_count_wrong,

    /// `dof_lower_bounds` or `dof_upper_bounds` is not the column of `bounds`.
    ///
    /// The module says the same twice, for programs that want pairs and for programs that want two
    /// vectors. Where the two differ, programs disagree about the robot.
    ///
    /// Write all three lists from the limits of the joints (SPEC 6.5.2, and 6.5.3 for DOFs without limits):
    /// these decide which of the two is right, and the finding is at the other.
    BND002 "bounds-columns-differ", Error, clause "6.5.1", since "0.1.0",
    phase References, needs [Module(Kind::Bounds), Passed(BND001)], check bounds_columns_differ,

    /// The bounds of a limited joint are not its limits.
    ///
    /// Planners keep within the bounds. Wider than the limits, they drive the joint into its stops;
    /// narrower, they never use a part of its range.
    ///
    /// Copy `lower` and `upper` of the joint's `limit` (one of the two that is absent is 0). A joint that
    /// others mimic keeps its own limits, and a joint with lower = upper has bounds that are equal. If the
    /// limits have changed in the URDF, write `bounds_module` again.
    BND003 "bound-differs-from-limit", Error, clause "6.5.2", since "0.1.0",
    phase References, needs [Passed(DOF005), Passed(BND001)], check bound_differs_from_limit,

    /// `dof_limited` does not say which DOFs the robot's source limits.
    ///
    /// A DOF that is not limited has bounds too, only so that it can be sampled. A program that takes them
    /// for limits will not turn a continuous joint past half a turn; one that takes limits for such bounds
    /// drives a joint into its stops.
    ///
    /// Write true for DOFs of revolute and prismatic joints whose `limit` has `lower` or `upper`, and false
    /// for all others, those of continuous joints included.
    BND004 "limited-flag-wrong", Error, clause "6.5.2", since "0.1.0",
    phase References, needs [Version1, Passed(DOF005), Passed(BND001), ModuleV1(Kind::Bounds)],
    check limited_flag_wrong,

    /// The velocity or effort limit of a DOF is not the joint's.
    ///
    /// Trajectories are timed by these numbers: too high a limit asks of a motor what it cannot give, and 0
    /// where the URDF says nothing stops the joint for good.
    ///
    /// Copy `velocity` and `effort` of the `limit` of joints of one DOF. Write null where the URDF has none,
    /// and for the DOFs of planar, floating and spherical joints.
    BND005 "speed-or-effort-differs", Error, clause "6.5.4", since "0.1.0",
    phase References, needs [Version1, Passed(DOF005), Passed(BND001), ModuleV1(Kind::Bounds)],
    check speed_or_effort_differs,

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

fn bound_count_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let dofs = context.dofs()?.num_dofs;
    let bounds = context.bounds()?;
    let mut lists = vec![
        ("bounds", bounds.bounds.len()),
        ("dof_lower_bounds", bounds.dof_lower_bounds.len()),
        ("dof_upper_bounds", bounds.dof_upper_bounds.len()),
    ];
    if let Some(v1) = document!(context, Bounds) {
        lists.push(("dof_limited", v1.dof_limited.len()));
        lists.push(("dof_velocity_limits", v1.dof_velocity_limits.len()));
        lists.push(("dof_effort_limits", v1.dof_effort_limits.len()));
    }
    let Some(wrong) = wrong_lengths(&lists, dofs.get()) else { return Some(()) };
    let length = wrong.length;
    let message = match wrong.are_all {
        false => format!("one entry per DOF is needed: {}", wrong.in_words),
        true => {
            // Configurations are sampled within the bounds.
            let statistics = context.module(Kind::LinkShapesDistanceStatistics);
            let also = statistics.map_or("", |_| {
                ", and the distance statistics, which are sampled within these bounds, with what is derived from them"
            });
            format!(
                "every list here has {length} entries, but num_dofs of dof_module is {dofs}: the module is stale; write it again from the same robot{also}"
            )
        }
    };
    finding_in(Kind::Bounds, wrong.pointer, message)
        .values(format!("{dofs} entries (num_dofs of dof_module)"), format!("{length} entries"))
        .report(findings);
    Some(())
}

fn bounds_columns_differ(context: &Context, findings: &mut Findings) -> Option<()> {
    let bounds = context.bounds()?;
    for (column, (name, values)) in [
        ("dof_lower_bounds", &bounds.dof_lower_bounds),
        ("dof_upper_bounds", &bounds.dof_upper_bounds),
    ]
    .into_iter()
    .enumerate()
    {
        for (dof, (pair, value)) in bounds.bounds.iter().zip(values).enumerate() {
            let paired = pair[column];
            if numbers_agree(paired, *value) {
                continue;
            }
            let (of_pairs, of_list) = (format!("/bounds/{dof}/{column}"), format!("/{name}/{dof}"));
            let decided = decided(context, dof, column);
            let is = |written: f64| {
                let bound = decided.as_ref().map(|(bound, _)| *bound);
                bound.is_some_and(|bound| numbers_agree(bound, written))
            };
            let (wrong, written, right, other) = match is(*value) {
                true => (of_pairs, paired, *value, of_list),
                false => (of_list, *value, paired, of_pairs),
            };
            let (message, expected) = match &decided {
                Some((_, why)) if is(*value) || is(paired) => (
                    format!("DOF {dof}: this is not the value of `{other}`, and {why}"),
                    format!("{right:?}, as `{other}` has it"),
                ),
                Some((bound, why)) => (
                    format!(
                        "DOF {dof}: this is not the value of `{other}`, and neither is right: {why}"
                    ),
                    format!("{bound:?} in both places"),
                ),
                None => (
                    format!("DOF {dof}: this is not the value of `{other}`; one of them is wrong"),
                    format!("{right:?}, as `{other}` has it"),
                ),
            };
            finding_in(Kind::Bounds, wrong, message)
                .values(expected, format!("{written:?}"))
                .tolerance(number_tolerance(right, written))
                .off_by(right - written, "")
                .report(findings);
        }
    }
    Some(())
}

/// The right bound and why it is, if the robot and `dof_module` agree on the joint of the DOF. `None` in legacy modules, which may
/// have other bounds.
fn decided(context: &Context, dof: usize, end: usize) -> Option<(f64, String)> {
    document!(context, Bounds)?;
    let (joint, place) = context.dof_layout()?.place(dof)?;
    let stated = context.dofs()?.dof_idx_to_joint_idx_mapping.get(dof)?.get();
    if stated != joint {
        return None;
    }
    let joint = context.robot()?.joints.get(joint)?;
    let side = ["lower", "upper"][end];
    let (bounds, what, without) = match joint.position_limits() {
        Some((lower, upper)) => ([lower, upper], "limit", ""),
        None => {
            (bounds_without_limits(joint.joint_type, place)?, "bound", ", which has no limits,")
        }
    };
    let (bound, name) = (bounds[end], &joint.name);
    Some((bound, format!("the {side} {what} of joint `{name}`{without} is {bound:?}")))
}

fn bound_differs_from_limit(context: &Context, findings: &mut Findings) -> Option<()> {
    let bounds = context.bounds()?;
    for limited in limited_dofs(context)? {
        let (dof, [lower, upper]) = (limited.dof, limited.limits);
        for (end, key) in ["lower", "upper"].into_iter().enumerate() {
            let (limit, bound) = (limited.limits[end], limited.bounds[end]);
            // Legacy modules give a locked joint a range; LEG006 reports it.
            let widened = context.is_legacy(Kind::Bounds) && end == 1 && lower == upper;
            let agree = numbers_agree(limit, bound)
                || (widened && numbers_agree(limit + LEGACY_WIDENING, bound));
            if !agree && columns_agree(bounds, dof, end) {
                let name = &limited.joint.name;
                let message = format!("DOF {dof}: this is not the {key} limit of joint {name:?}");
                finding_in(Kind::Bounds, format!("/bounds/{dof}/{end}"), message)
                    .numbers(limit, bound, number_tolerance(limit, bound))
                    .report(findings);
            }
        }
    }
    Some(())
}

fn limited_flag_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let bounds = document!(context, Bounds)?;
    for (written, (dof, joint)) in bounds.dof_limited.iter().zip(dofs(context)?) {
        let limited = joint.position_limits().is_some();
        if *written != limited {
            let why = match limited {
                true => "has limits in urdf_module".to_owned(),
                false => format!("is a {} joint without position limits", joint.joint_type),
            };
            let message = format!("DOF {dof} moves joint {:?}, which {why}", joint.name);
            finding_in(Kind::Bounds, format!("/dof_limited/{dof}"), message)
                .values(limited, written)
                .report(findings);
        }
    }
    Some(())
}

fn speed_or_effort_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let bounds = document!(context, Bounds)?;
    let lists = bounds.dof_velocity_limits.iter().zip(&bounds.dof_effort_limits);
    for ((dof, joint), (speed, effort)) in dofs(context)?.zip(lists) {
        let limit = joint.limit.filter(|_| joint.num_dofs() == 1);
        let right_speed = limit.and_then(|limit| limit.velocity);
        let right_effort = limit.and_then(|limit| limit.effort);
        for (key, right, written) in [
            ("dof_velocity_limits", right_speed, *speed),
            ("dof_effort_limits", right_effort, *effort),
        ] {
            let both = right.zip(written);
            if both.map_or(right == written, |(a, b)| numbers_agree(a, b)) {
                continue;
            }
            let message = format!(
                "this is not what urdf_module says of joint {:?}, which DOF {dof} moves",
                joint.name
            );
            let finding = finding_in(Kind::Bounds, format!("/{key}/{dof}"), message);
            findings.report(match both {
                Some((right, written)) => {
                    finding.numbers(right, written, number_tolerance(right, written))
                }
                None => finding.values(or_null(right), or_null(written)),
            });
        }
    }
    Some(())
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
pub struct LimitedDof<'a> {
    pub dof: usize,
    pub joint: &'a Joint,
    pub limits: [f64; 2],
    pub bounds: [f64; 2],
}

/// Every DOF whose joint has position limits.
pub fn limited_dofs(context: &Context) -> Option<Vec<LimitedDof<'_>>> {
    let bounds = context.bounds()?.bounds.iter();
    let dofs = bounds.zip(dofs(context)?).filter_map(|(bounds, (dof, joint))| {
        let (lower, upper) = joint.position_limits()?;
        Some(LimitedDof { dof, joint, limits: [lower, upper], bounds: *bounds })
    });
    Some(dofs.collect())
}

/// Every DOF of the robot with its joint.
pub fn dofs(context: &Context) -> Option<impl Iterator<Item = (usize, &Joint)>> {
    let robot = context.robot()?;
    let joints = context.dof_layout()?.joint_of_dof.iter().enumerate();
    Some(joints.filter_map(|(dof, joint)| Some((dof, robot.joints.get(*joint)?))))
}

/// Whether `bounds` and the list of that end agree on a DOF; otherwise BND002 reports it.
pub fn columns_agree(bounds: &BoundsModule, dof: usize, end: usize) -> bool {
    let list = [&bounds.dof_lower_bounds, &bounds.dof_upper_bounds][end];
    let pair = bounds.bounds.get(dof);
    pair.zip(list.get(dof)).is_none_or(|(pair, value)| numbers_agree(pair[end], *value))
}

/// By how much legacy modules raised an upper bound equal to the lower one (SPEC 10.3).
pub const LEGACY_WIDENING: f64 = 1e-7;
