use super::prelude::*;
use urdd_format::readable::number;

declare_lint! {
    /// The axis of a prismatic or planar joint is not of length 1.
    ///
    /// Programs move the link by different lengths: at 0.5 m along the axis `0 0 2`, PyBullet and yourdfpy move it by
    /// 1 m, MuJoCo and Pinocchio by 0.5 m. SDFormat asks for a unit vector.
    ///
    /// Divide the three numbers by their length.
    LNT012 "axis-not-unit", Warning, WrongMotion, since "1.1.0"
}

/// How far the length may be from 1: three digits are enough, as in `0.707 0.707 0`.
const TOLERANCE: f64 = 1e-3;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for joint in urdf.joints_of(&["prismatic", "planar"]) {
        let Some(element) = child(joint, "axis") else {
            continue;
        };
        let Some(axis) = numbers::<3>(element, "xyz") else {
            continue;
        };
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
