//! Angles from rotations.

use std::f64::consts::FRAC_PI_2;

use urdd_kinematics::rotation::{from_rpy, rotation_distance, to_rpy};

#[test]
fn angles_keep_the_rotation_to_the_last_digits() {
    let near = [0.0, 1e-16, 1e-12, 1e-9, 1e-8, 2.7e-8, 1e-6, 1e-3, 0.3, 1.0];
    for pitch in near.iter().flat_map(|x| [FRAC_PI_2 - x, x - FRAC_PI_2, *x]) {
        for (roll, yaw) in [(0.0, 0.0), (0.3, -2.0), (-3.0, 3.1), (FRAC_PI_2, -FRAC_PI_2)] {
            let rotation = from_rpy([roll, pitch, yaw]);
            let again = from_rpy(to_rpy(rotation.to_rotation_matrix().matrix()));
            let apart = rotation_distance(&rotation, &again);
            assert!(apart < 4e-15, "{roll} {pitch} {yaw}: {apart:e}");
        }
    }
}
