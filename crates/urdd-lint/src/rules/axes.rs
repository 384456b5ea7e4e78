use super::prelude::*;
use urdd_format::readable::number;

declare_lint! {
    /// A joint that needs an axis has none.
    ///
    /// Programs take `1 0 0`, although most joints are meant to turn about z, which is the default of MJCF. PyBullet
    /// warns; others say nothing.
    ///
    /// Write the axis, even where it is `1 0 0`.
    LNT016 "axis-missing", Warning, WrongMotion, since "1.1.0" => axis_missing;

    /// The axis of a prismatic or planar joint is not of length 1.
    ///
    /// Programs move the link by different lengths: at 0.5 m along the axis `0 0 2`, PyBullet and yourdfpy move it by
    /// 1 m, MuJoCo and Pinocchio by 0.5 m. SDFormat asks for a unit vector.
    ///
    /// Divide the three numbers by their length.
    LNT012 "axis-not-unit", Warning, WrongMotion, since "1.1.0" => axis_not_unit
}

fn axis_missing(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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

/// How far the length may be from 1: three digits are enough, as in `0.707 0.707 0`.
const TOLERANCE: f64 = 1e-3;

fn axis_not_unit(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for joint in urdf.joints_of(&["prismatic", "planar"]) {
        let Some(element) = child(joint, "axis") else { continue };
        let Some(axis) = numbers::<3>(element, "xyz") else { continue };
        let length = axis.iter().fold(0.0, |length: f64, x| length.hypot(*x));
        // URD010 finds axes of length 0.
        if length == 0.0 || !length.is_finite() || (length - 1.0).abs() <= TOLERANCE {
            continue;
        }
        let mended = axis.map(|x| format!("{}", x / length)).join(" ");
        let message = format!(
            "the axis has the length {}, by which some programs multiply the motion; write `{mended}`",
            number(length, 4)
        );
        let range = urdf.value(element, "xyz");
        let fix = range.map(|range| urdf.fix("write the axis with length 1", range, mended));
        urdf.at_attribute(element, "xyz", message).fix(fix).report(findings);
    }
    Some(())
}
