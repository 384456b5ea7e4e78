use super::prelude::*;

declare_lint! {
    /// The effort or velocity of a joint's limit is negative, or one of them is 0.
    ///
    /// Pinocchio refuses the whole robot if one of them is negative, on joints that follow another one too. With
    /// effort 0, Gazebo, ros2_control and whoever asks PyBullet for the limit apply no force. With velocity 0, MoveIt's time
    /// parameterization fails. MuJoCo takes 0 as "no limit".
    ///
    /// Write what the motor can do, in N or N m, and in m/s or rad/s. Where both are 0, SRC009 says so.
    LNT013 "absurd-velocity-or-effort", Warning, WrongMotion, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for joint in urdf.joints_of(&ONE_DOF) {
        let Some(limit) = child(joint, "limit") else {
            continue;
        };
        let bound = |name| number(limit, name).unwrap_or(0.0);
        let is_free = joint.attribute("type") == Some("continuous");
        // PyBullet takes a lower limit above the upper one as "free", and SRC tells others.
        let is_still = !is_free && bound("lower") >= bound("upper");
        let may_be_0 = is_still || child(joint, "mimic").is_some();
        for (name, other) in [("velocity", "effort"), ("effort", "velocity")] {
            let other = number(limit, other);
            let wrong = match number(limit, name) {
                Some(value) if value < 0.0 => "is negative",
                Some(0.0) if !may_be_0 && other.is_some_and(|other| other != 0.0) => {
                    "is 0: programs that keep to it do not move the joint"
                }
                _ => continue,
            };
            let message = format!("`{name}` {wrong}; write what the motor can do");
            urdf.at_attribute(limit, name, message).report(findings);
        }
    }
    Some(())
}
