use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::tolerance::MIMIC_LIMIT;
use urdd_format::readable::number;
use urdd_format::urdf::JointType;

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
    phase References, judges Source, needs [
        SourceRobot, Passed(URD008), Passed(URD009), Passed(URD012),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(mimics), Some(file)) =
        (context.robot(), context.mimics(), context.robot_file())
    else {
        return;
    };
    for (index, (joint, resolved)) in robot.joints.iter().zip(&mimics.by_joint).enumerate() {
        let Some(driver) = resolved.and_then(|resolved| robot.joints.get(resolved.driver)) else {
            continue;
        };
        // A fixed driver stands at 0.
        let driven = match driver.joint_type {
            JointType::Fixed => Some((0.0, 0.0)),
            _ => driver.position_limits(),
        };
        let (Some(resolved), Some(own), Some(limits)) = (resolved, joint.position_limits(), driven)
        else {
            continue;
        };
        // Crossed limits are SRC001's.
        if own.0 > own.1 || limits.0 > limits.1 {
            continue;
        }
        let (range, tolerance) = (
            follow(limits, resolved.multiplier, resolved.offset),
            MIMIC_LIMIT * own.0.abs().max(own.1.abs()),
        );
        let beyond = (own.0 - range.0).max(range.1 - own.1);
        if beyond <= tolerance {
            continue;
        }
        findings.report(
            Finding::at(
                &file,
                format!("/joints/{index}/limit"),
                format!(
                    "joint `{}` follows joint `{}`, and leaves its own limits by up to {} while the driver is within its limits",
                    joint.name,
                    driver.name,
                    number(beyond, 6)
                ),
            )
            .expected(format!("joint `{}` within {}", joint.name, interval(own)))
            .actual(format!(
                "{} for `{}` from {} to {}",
                interval(range),
                driver.name,
                number(limits.0, 6),
                number(limits.1, 6)
            ))
            .tolerance(tolerance),
        );
    }
}

/// Where a mimic goes while its driver goes through an interval.
fn follow(driver: (f64, f64), multiplier: f64, offset: f64) -> (f64, f64) {
    let (a, b) = (
        multiplier * driver.0 + offset,
        multiplier * driver.1 + offset,
    );
    (a.min(b), a.max(b))
}

fn interval((lower, upper): (f64, f64)) -> String {
    format!("[{}, {}]", number(lower, 6), number(upper, 6))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_negative_multiplier_turns_the_interval_round() {
        assert_eq!(follow((-1.0, 2.0), -0.5, 0.25), (-0.75, 0.75));
        assert_eq!(follow((-1.0, 2.0), 2.0, 0.0), (-2.0, 4.0));
        assert_eq!(follow((-1.0, 2.0), 0.0, 0.5), (0.5, 0.5));
    }
}
