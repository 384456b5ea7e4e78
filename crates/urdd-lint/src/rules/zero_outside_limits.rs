use super::prelude::*;

declare_lint! {
    /// The limits of a joint leave out 0.
    ///
    /// Most programs begin with every joint at 0, which this joint cannot take. MuJoCo pushes it into its range from the
    /// first step: without any load it was at 1.2 rad/s after 0.4 s. MoveIt refuses 0 as a start, and RViz shows a pose
    /// that the robot does not have.
    ///
    /// Give programs a start within the limits, such as a `<group_state>` of the SRDF, a keyframe of MuJoCo, or
    /// `initial_value` of ros2_control. A joint that is still being designed can have its 0 within the limits.
    LNT011 "zero-outside-limits", Info, WrongMotion, since "1.1.0"
}

/// A rounded 0 is within the limits, rad or m.
const MARGIN: f64 = 1e-6;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for joint in urdf.joints_of(&["revolute", "prismatic"]) {
        let Some(limit) = child(joint, "limit").filter(|_| child(joint, "mimic").is_none()) else {
            continue;
        };
        let bound = |name| number(limit, name).unwrap_or(0.0);
        let (lower, upper) = (bound("lower"), bound("upper"));
        // SRC001 finds crossed limits.
        if lower > upper || (lower <= MARGIN && upper >= -MARGIN) {
            continue;
        }
        let message = format!(
            "0 is outside of the limits {lower} to {upper}, and most programs start there; give them another \
            start"
        );
        urdf.at(limit, message).report(findings);
    }
    Some(())
}
