use super::prelude::*;

declare_lint! {
    /// A continuous joint has a lower and an upper limit.
    ///
    /// URDF has none for continuous joints. MuJoCo, Pinocchio and MoveIt leave them out, PyBullet cuts targets of
    /// positions to them: a steering joint turns without end in one program and stops in another.
    ///
    /// Make the joint `revolute` if it has stops. Otherwise remove `lower` and `upper`.
    LNT014 "continuous-with-limits", Warning, WrongMotion, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for joint in urdf.joints_of(&["continuous"]) {
        let Some(limit) = child(joint, "limit") else {
            continue;
        };
        let (Some(lower), Some(upper)) = (number(limit, "lower"), number(limit, "upper")) else {
            continue;
        };
        if lower < upper {
            let message = format!(
                "a continuous joint has the limits {lower} to {upper}, which most programs ignore; make it `revolute`, \
                or remove them"
            );
            urdf.at_attribute(limit, "lower", message).report(findings);
        }
    }
    Some(())
}
