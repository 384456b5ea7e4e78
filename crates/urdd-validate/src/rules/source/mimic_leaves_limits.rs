use crate::rules::prelude::*;

declare_rule! {
    /// A mimic joint leaves its own limits while its driver is within its limits.
    ///
    /// The bounds in a URDD are those of the driver. A position within these bounds puts the mimic joint
    /// beyond its own `<limit>`: some programs refuse such a state, some stop the driver early, some
    /// ignore it. Chains of mimics are followed to their end. Mimics of a driver without limits are not
    /// checked.
    ///
    /// Narrow the driver's limits, widen the mimic's, or correct `multiplier` and `offset`, in the
    /// URDF, and write the URDD again.
    SRC002 "mimic-leaves-its-limits", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [SourceRobot, Passed(URD008), Passed(URD009), Passed(URD012)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let mimics = context.mimics()?;
    for (index, (joint, resolved)) in robot.joints.iter().zip(&mimics.by_joint).enumerate() {
        let (Some(resolved), Some(own)) = (resolved, joint.position_limits()) else { continue };
        let driver = robot.joints.get(resolved.driver)?;
        // A fixed driver stays at 0.
        let limits = match driver.joint_type {
            JointType::Fixed => Some((0.0, 0.0)),
            _ => driver.position_limits(),
        };
        // SRC001 reports crossed limits.
        let Some(limits) = limits.filter(|limits| limits.0 <= limits.1 && own.0 <= own.1) else {
            continue;
        };
        let range = follow(limits, resolved.multiplier, resolved.offset);
        let tolerance = MIMIC_LIMIT * own.0.abs().max(own.1.abs());
        let beyond = (own.0 - range.0).max(range.1 - own.1);
        if beyond <= tolerance {
            continue;
        }
        let pointer = format!("/joints/{index}/limit");
        let message = format!(
            "joint `{}` follows joint `{}`, and leaves its own limits by up to {} while the driver is within its limits",
            joint.name,
            driver.name,
            number(beyond, 6)
        );
        finding_in(context, pointer, message)
            .expected(format!("joint `{}` within {}", joint.name, interval(own)))
            .actual(format!(
                "{} for `{}` from {} to {}",
                interval(range),
                driver.name,
                number(limits.0, 6),
                number(limits.1, 6)
            ))
            .tolerance(tolerance)
            .report(findings);
    }
    Some(())
}

/// The interval of a mimic while its driver moves through an interval.
pub fn follow(driver: (f64, f64), multiplier: f64, offset: f64) -> (f64, f64) {
    let at = |position: f64| multiplier * position + offset;
    let (a, b) = (at(driver.0), at(driver.1));
    (a.min(b), a.max(b))
}

fn interval((lower, upper): (f64, f64)) -> String {
    format!("[{}, {}]", number(lower, 6), number(upper, 6))
}
