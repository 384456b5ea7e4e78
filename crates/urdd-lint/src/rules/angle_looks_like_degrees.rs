use super::prelude::*;

declare_lint! {
    /// An angle of an `<origin>` looks like degrees.
    ///
    /// URDF's angles are radians: 90 is 14 turns and 117 degrees. Every program turns the part without a word.
    ///
    /// Divide by 57.2958 (180/π): 90 degrees are 1.570796.
    LNT018 "angle-looks-like-degrees", Warning, WrongPlace, since "1.1.0"
}

/// More than a turn, rad.
const MORE_THAN_A_TURN: f64 = 7.0;
/// Degrees that somebody types are mostly multiples of this. Drones have 55 and 95 rad, and mean them.
const STEP: f64 = 15.0;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let origins = urdf.parts().filter(|node| node.tag_name().name() == "origin");
    for origin in origins {
        let Some(angles) = numbers::<3>(origin, "rpy") else {
            continue;
        };
        let is_degrees = |angle: &f64| {
            let steps = angle / STEP;
            angle.abs() >= MORE_THAN_A_TURN && (steps - steps.round()).abs() < 1e-9
        };
        if angles.iter().any(is_degrees) {
            let message =
                "the angles look like degrees, and are taken as radians; divide them by 57.2958";
            let [roll, pitch, yaw] = angles;
            urdf.at_attribute(origin, "rpy", message)
                .actual(format!("{roll} {pitch} {yaw}"))
                .report(findings);
        }
    }
    Some(())
}
