use super::prelude::*;
use urdd_format::readable::number as shown;

declare_lint! {
    /// The limits of a revolute joint look like degrees.
    ///
    /// URDF's angles are radians, and every program takes them as such: with `upper="90"` the joint turns 14 times around
    /// before it stops. Planners and random sampling then use poses that the robot cannot take.
    ///
    /// Divide by 57.2958 (180/π). A joint without limits is `continuous`.
    LNT010 "limits-look-like-degrees", Warning, WrongMotion, since "1.1.0"
}

/// Sizes of the larger bound that are degrees. No revolute joint of 1,758 URDFs has one.
const FROM: f64 = 25.0;
const TO: f64 = 720.0;
/// Bounds on both sides that mean "unlimited".
const UNLIMITED: [f64; 3] = [50.0, 100.0, 500.0];

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for joint in urdf.joints_of(&["revolute"]) {
        let Some(limit) = child(joint, "limit") else {
            continue;
        };
        let (Some(lower), Some(upper)) = (number(limit, "lower"), number(limit, "upper")) else {
            continue;
        };
        let size = lower.abs().max(upper.abs());
        let is_unlimited = lower == -upper && UNLIMITED.contains(&size);
        if !(FROM..=TO).contains(&size) || is_unlimited {
            continue;
        }
        let radians = [lower, upper].map(|angle| shown(angle.to_radians(), 5));
        let message = format!(
            "the limits look like degrees, and are taken as radians; write lower=\"{}\" upper=\"{}\"",
            radians[0], radians[1]
        );
        urdf.at(limit, message).actual(format!("{lower} to {upper}")).report(findings);
    }
    Some(())
}
