use super::inertia_not_positive_definite::positive;
use super::moments;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::tolerance::INERTIA_TRIANGLE;
use urdd_format::readable::number;

declare_rule! {
    /// A principal moment of inertia is larger than the sum of the other two.
    ///
    /// No body has such moments. For a flat plate the largest is the sum of the others; for every other
    /// body it is less. Some simulators refuse the link (MuJoCo, Drake), others simulate an impossible
    /// body. Most often the numbers were made up, the axes mixed, or the units wrong in some of them
    /// (g mm² for kg m²).
    ///
    /// Compute the tensor again, correct the URDF, and write the URDD again.
    SRC005 "inertia-breaks-the-triangle-inequality", Warning, clause "6.1.7", since "0.1.0",
    phase References, judges Source, needs [SourceRobot],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    for (index, link) in robot.links.iter().enumerate() {
        let Some(tensor) = link.inertial.and_then(|inertial| inertial.inertia) else {
            continue;
        };
        let moments = moments::principal(tensor);
        // What is not positive definite is SRC004's.
        if !positive(moments) || excess(moments) <= INERTIA_TRIANGLE {
            continue;
        }
        findings.report(
            Finding::at(
                &file,
                format!("/links/{index}/inertial/inertia"),
                format!(
                    "link `{}`: no body has this inertia; its largest principal moment is larger than the sum of the others by {:.2} %",
                    link.name,
                    100.0 * excess(moments)
                ),
            )
            .expected(format!("at most {} kg m²", number(moments[0] + moments[1], 5)))
            .actual(format!("link `{}`: {}", link.name, moments::show(moments)))
            .tolerance(INERTIA_TRIANGLE * moments[2]),
        );
    }
}

/// By what part of itself the largest of three moments, ascending, is more than the others' sum.
fn excess(moments: [f64; 3]) -> f64 {
    1.0 - moments[0] / moments[2] - moments[1] / moments[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flat_plate_is_a_body() {
        assert!(excess([0.3, 0.7, 1.0]) <= INERTIA_TRIANGLE);
        assert!(excess([0.3, 0.699_999_8, 1.0]) <= INERTIA_TRIANGLE);
        assert!(excess([0.3, 0.699_998, 1.0]) > INERTIA_TRIANGLE);
    }
}
