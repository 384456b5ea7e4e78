use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_format::urdf::JointType;
use urdd_validate::finding::Findings;

declare_lint! {
    /// The axis of a joint is not of length 1.
    ///
    /// URDF asks for a unit vector. Most readers normalise; those that do not (KDL before 2021, hand-written ones) turn
    /// the joint faster or slower by the axis' length.
    ///
    /// Divide the numbers by their length.
    LNT012 "axis-not-unit", Info, WrongMotion, since "1.1.0"
}

/// How far the length may be from 1: axes are often written with three digits.
const TOLERANCE: f64 = 1e-3;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let robot = urdf.robot(findings)?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(axis) = joint.axis.as_ref().and_then(|axis| axis.xyz) else {
            continue;
        };
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        // URD010 finds axes of length 0.
        if length == 0.0 || (length - 1.0).abs() <= TOLERANCE || !has_axis(joint.joint_type) {
            continue;
        }
        let node = urdf.joints[index];
        let element = node.children().find(|child| child.has_tag_name("axis"));
        let node = element.unwrap_or(node);
        let mended = axis.map(|x| format!("{:?}", x / length)).join(" ");
        let message = format!("the axis has length {length:.4}; write `{mended}`");
        let finding = urdf.at_attribute(node, "xyz", message);
        let range = node.attribute_node("xyz").map(|one| one.range_value());
        let fix = range.map(|range| urdf.fix("write the axis with length 1", range, mended));
        match fix {
            Some(fix) => finding.fix(fix),
            None => finding,
        }
        .report(findings);
    }
    Some(())
}

fn has_axis(kind: JointType) -> bool {
    matches!(
        kind,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic | JointType::Planar
    )
}
