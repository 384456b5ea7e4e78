use std::f64::consts::TAU;

use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_format::urdf::JointType;
use urdd_validate::finding::Findings;

declare_lint! {
    /// The limits of a revolute joint look like degrees.
    ///
    /// URDF's angles are radians. A joint with `upper="90"` turns 14 times around before it stops: planners find
    /// motions that the robot cannot make, and drawn sliders are of no use.
    ///
    /// Divide by 57.2958 (180/π). A joint without limits is `continuous`.
    LNT010 "limits-look-like-degrees", Warning, WrongMotion, since "1.1.0"
}

/// Whole turns up to this many are taken for meant: hoses and cables allow a few.
const TURNS: f64 = 3.0;
/// Limits from here on are "none".
const NONE: f64 = 1000.0;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let robot = urdf.robot(findings)?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(limit) = joint
            .limit
            .as_ref()
            .filter(|_| joint.joint_type == JointType::Revolute)
        else {
            continue;
        };
        let limits = [("lower", limit.lower), ("upper", limit.upper)];
        let odd = limits.into_iter().find_map(|(name, value)| {
            let value = value?;
            let size = value.abs();
            let is_degrees = size > TURNS * TAU && size < NONE && size % 5.0 == 0.0;
            is_degrees.then_some((name, value))
        });
        if let Some((name, value)) = odd {
            let node = urdf.joints[index];
            let limit = node.children().find(|child| child.has_tag_name("limit"));
            let message = format!(
                "`{name}` is {value} rad, {:.0} turns: it looks like degrees; write {:.4}",
                (value / TAU).abs(),
                value.to_radians()
            );
            urdf.at_attribute(limit.unwrap_or(node), name, message)
                .report(findings);
        }
    }
    Some(())
}
