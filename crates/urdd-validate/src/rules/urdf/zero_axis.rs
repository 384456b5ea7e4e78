use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;

declare_rule! {
    /// A joint that needs an axis has an axis without a direction.
    ///
    /// Made a unit vector, a zero vector is 0/0, and every pose below the joint becomes NaN. An axis is
    /// reported too when the square of its length is 0 or infinite in binary64. Fixed, floating and
    /// spherical joints do not use their axis: it may be anything.
    ///
    /// Give the joint an axis in the URDF (without one it is `1 0 0`), and write the URDD again.
    URD010 "zero-axis", Error, clause "6.1.6", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    for (index, joint) in robot.joints.iter().enumerate() {
        if !joint.has_axis() || has_direction(joint.axis) {
            continue;
        }
        findings.report(
            Finding::at(
                file.clone(),
                format!("/joints/{index}/axis/xyz"),
                format!(
                    "the axis of joint `{}` ({}) has no direction",
                    joint.name, joint.joint_type
                ),
            )
            .expected("a vector other than zero")
            .actual(format!("{:?}", joint.axis)),
        );
    }
}

/// Whether the vector can be made a unit vector in binary64.
fn has_direction(axis: [f64; 3]) -> bool {
    axis.iter().map(|x| x * x).sum::<f64>().is_normal()
}

#[cfg(test)]
mod tests {
    use super::has_direction;

    #[test]
    fn short_axes_have_a_direction() {
        assert!(has_direction([0.001, 0.002, -0.002]));
        assert!(has_direction([0.0, -1e-9, 0.0]));
        for axis in [[0.0; 3], [-0.0; 3], [1e-200; 3], [1e200, 0.0, 0.0]] {
            assert!(!has_direction(axis), "{axis:?}");
        }
    }
}
