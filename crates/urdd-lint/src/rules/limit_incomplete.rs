use super::prelude::*;

declare_lint! {
    /// A `<limit>` has no effort or no velocity, or a revolute or prismatic joint has no `<limit>`.
    ///
    /// urdfdom, so all of ROS and Pinocchio, refuses the whole file. A `<limit>` needs both on joints of any type, and a joint
    /// that follows another needs a `<limit>`: `Could not parse limit element`, `did not specify limits`. MuJoCo, PyBullet and yourdfpy load it, so that nobody sees it.
    ///
    /// Write what is missing: what the motor can do, in N or N m, and in m/s or rad/s.
    LNT017 "limit-incomplete", Error, Format, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for joint in &urdf.joints {
        let Some(limit) = child(*joint, "limit") else {
            if matches!(joint.attribute("type"), Some("revolute" | "prismatic")) {
                let message = "the joint has no `<limit>`; write it, with effort and velocity";
                urdf.at(*joint, message).report(findings);
            }
            continue;
        };
        let mut missing = vec!["effort", "velocity"];
        missing.retain(|name| !limit.has_attribute(*name));
        if !missing.is_empty() {
            let what = if missing.len() == 1 { "it" } else { "both" };
            let message = format!("`<limit>` has no {}; write {what}", missing.join(" and no "));
            urdf.at(limit, message).report(findings);
        }
    }
    Some(())
}
