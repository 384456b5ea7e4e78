use super::prelude::*;

declare_lint! {
    /// A joint that needs an axis has none.
    ///
    /// Programs take `1 0 0`, although most joints are meant to turn about z, which is the default of MJCF. PyBullet
    /// warns; others say nothing.
    ///
    /// Write the axis, even where it is `1 0 0`.
    LNT016 "axis-missing", Warning, WrongMotion, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for joint in urdf.joints_of(&WITH_AXIS) {
        let axis = child(joint, "axis");
        if axis.is_none_or(|axis| !axis.has_attribute("xyz")) {
            let message =
                "the joint has no axis, and programs take `1 0 0`; write `<axis xyz=\"...\"/>`";
            urdf.at(axis.unwrap_or(joint), message).report(findings);
        }
    }
    Some(())
}
