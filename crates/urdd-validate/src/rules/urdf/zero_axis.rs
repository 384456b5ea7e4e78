use crate::rules::prelude::*;

declare_rule! {
    /// A joint that needs an axis has an axis without a direction.
    ///
    /// Made a unit vector, a zero vector is 0/0, and every pose below the joint becomes NaN. An axis is
    /// reported too when the square of its length is 0 or infinite in binary64. Fixed, floating and
    /// spherical joints do not use their axis: it may be anything.
    ///
    /// Give the joint an axis in the URDF (without one it is `1 0 0`), and write the URDD again.
    URD010 "zero-axis", Error, clause "6.1.6", since "0.1.0",
    phase References, needs [Module(Kind::Urdf)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        if joint.has_axis() && !has_direction(joint.axis) {
            let (name, kind) = (&joint.name, joint.joint_type);
            let message = format!("the axis of joint `{name}` ({kind}) has no direction");
            Finding::at(&file, format!("/joints/{index}/axis/xyz"), message)
                .values("a vector other than zero", format!("{:?}", joint.axis))
                .report(findings);
        }
    }
    Some(())
}

/// Whether the vector can be normalised in binary64.
pub fn has_direction(axis: [f64; 3]) -> bool {
    axis.iter().map(|x| x * x).sum::<f64>().is_normal()
}
