use super::inertia_not_positive_definite::positive;
use super::moments;
use crate::rules::prelude::*;

declare_rule! {
    /// A principal moment of inertia is larger than the sum of the other two.
    ///
    /// No body has such moments. For a flat plate the largest is the sum of the others; for every other
    /// body it is less. Some simulators refuse the robot (MuJoCo, Gazebo), others simulate an impossible
    /// body. Most often the numbers were made up, the axes mixed, or the units wrong in some of them
    /// (g mm² for kg m²).
    ///
    /// Compute the tensor again, correct the URDF, and write the URDD again.
    SRC005 "inertia-breaks-the-triangle-inequality", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [SourceRobot],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    for (index, link) in robot.links.iter().enumerate() {
        let Some(tensor) = link.inertial.and_then(|inertial| inertial.inertia) else {
            continue;
        };
        let moments = moments::principal(tensor);
        // SRC004 reports tensors that are not positive definite.
        if !positive(moments) || excess(moments) <= INERTIA_TRIANGLE {
            continue;
        }
        let least = number(moments[0] + moments[1], 5);
        let pointer = format!("/links/{index}/inertial/inertia");
        let message = format!(
            "link `{}`: no body has this inertia; its largest principal moment is larger than the sum of the others by {:.2} %",
            link.name,
            100.0 * beyond(moments)
        );
        Finding::at(&file, pointer, message)
            .expected(format!("at most {least} kg m²"))
            .actual(format!("link `{}`: {}", link.name, moments::show(moments)))
            .tolerance(INERTIA_TRIANGLE * moments[2])
            .report(findings);
    }
    Some(())
}

/// By what fraction of the sum of the others the largest of three ascending moments exceeds it.
pub fn beyond(moments: [f64; 3]) -> f64 {
    moments[2] / (moments[0] + moments[1]) - 1.0
}

/// By what fraction of itself the largest of three ascending moments exceeds the sum of the others.
pub fn excess(moments: [f64; 3]) -> f64 {
    1.0 - moments[0] / moments[2] - moments[1] / moments[2]
}
