//! Frozen joints: computes the fixed origin.

use std::f64::consts::FRAC_PI_2;
use urdd_generate::combine::frozen::*;
use urdd_kinematics::rotation::{from_rpy, rotation_distance};

#[test]
fn angles_keep_the_rotation_to_the_last_digits() {
    let pitches =
        [0.0, 1.0, FRAC_PI_2 - 1e-3, FRAC_PI_2 - 1e-9, FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2 + 2.7e-8];
    for pitch in pitches {
        for (roll, yaw) in [(0.0, 0.0), (0.3, -2.0), (-3.0, 3.1), (1.5, 0.7)] {
            let rotation = from_rpy([roll, pitch, yaw]);
            let again = from_rpy(roll_pitch_yaw(&rotation));
            let apart = rotation_distance(&rotation, &again);
            assert!(apart < 4e-15, "{roll} {pitch} {yaw}: {apart:e}");
        }
    }
}
