use urdd_format::readable::number;

use super::prelude::*;

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
    LNT012 "axis-not-unit", Warning, WrongMotion, since "1.1.0" => axis_not_unit;

    /// An angle of an `<origin>` looks like degrees.
    ///
    /// URDF's angles are radians: 90 is 14 turns and 117 degrees. Every program turns the part without a word.
    ///
    /// Divide by 57.2958 (180/π): 90 degrees are 1.570796.
    LNT018 "angle-looks-like-degrees", Warning, WrongPlace, since "1.1.0" => angle_looks_like_degrees;

    /// The origin of a joint, a visual or a collision is tens of metres away, and the robot's parts are far smaller.
    ///
    /// It is in millimetres. Parts are scattered: RViz shows one of them, because the others are hundreds of metres away, and
    /// planners and simulators take the robot for one of that size.
    ///
    /// Before, between boxes of 0.1 m: `<origin xyz="300 0 50"/>`. After: `<origin xyz="0.3 0 0.05"/>`.
    ///
    /// Write lengths in metres.
    LNT064 "origin-in-millimetres", Warning, WrongPlace, since "1.3.0" => origin_in_millimetres
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

/// More than a turn, rad.
const MORE_THAN_A_TURN: f64 = 7.0;
/// Degrees that somebody types are mostly multiples of this. Drones have 55 and 95 rad, and mean them.
const STEP: f64 = 15.0;

fn angle_looks_like_degrees(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for origin in urdf.parts().filter(|node| node.tag_name().name() == "origin") {
        let Some(angles) = numbers::<3>(origin, "rpy") else { continue };
        let is_degrees = |angle: &f64| {
            let steps = angle / STEP;
            angle.abs() >= MORE_THAN_A_TURN && (steps - steps.round()).abs() < 1e-9
        };
        if angles.iter().any(is_degrees) {
            let message =
                "the angles look like degrees, and are taken as radians; divide them by 57.2958";
            let [roll, pitch, yaw] = angles;
            let finding = urdf.at_attribute(origin, "rpy", message);
            finding.actual(format!("{roll} {pitch} {yaw}")).report(findings);
        }
    }
    Some(())
}

/// The shortest distance, m, that shows that lengths are in millimetres: 1 cm.
const LEAST: f64 = 10.0;
/// How often the largest shape fits into the distance.
const TIMES: f64 = 30.0;

fn origin_in_millimetres(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, _) = urdf.bodies(findings)?;
    let length = |xyz: [f64; 3]| Vector3::from(xyz).norm();
    let joints = robot.joints.iter().zip(&urdf.joints);
    let mut origins: Vec<(f64, Node)> =
        joints.map(|(joint, node)| (length(joint.origin.xyz), *node)).collect();
    for (link, node) in robot.links.iter().zip(&urdf.links) {
        for (kind, name) in
            [(GeometryKind::Visual, "visual"), (GeometryKind::Collision, "collision")]
        {
            let elements = link.elements(kind).iter().zip(named(*node, name));
            origins.extend(elements.map(|(one, node)| (length(one.origin.xyz), node)));
        }
    }
    if origins.iter().all(|(length, _)| *length < LEAST) {
        return Some(());
    }
    let geometry = urdf.geometry(findings)?;
    let shapes = geometry.links.iter().flat_map(|link| &link.shapes);
    let largest = shapes.map(|shape| diagonal(shape.corners())).fold(0.0, f64::max);
    // A shape that is not known may be as large as the distances.
    if geometry.links.iter().any(|link| link.is_partial) || largest == 0.0 {
        return Some(());
    }
    origins.retain(|(length, _)| *length > TIMES * largest);
    if origins.iter().all(|(length, _)| *length < LEAST) {
        return Some(());
    }
    for (length, node) in origins {
        let of = match node.tag_name().name() {
            "joint" => "joint is placed on its parent",
            "visual" => "visual is placed on its link",
            _ => "collision is placed on its link",
        };
        let message = format!(
            "the {of} at a distance of {}, and the largest shape of the robot is {}; if `xyz` is in millimetres, divide it by \
            1000",
            metres(length),
            metres(largest)
        );
        urdf.at(child(node, "origin").unwrap_or(node), message).report(findings);
    }
    Some(())
}
