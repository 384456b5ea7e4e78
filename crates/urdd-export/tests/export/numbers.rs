//! Numbers as the shortest text that denotes the same binary64, and rotations as roll, pitch, yaw.

use urdd_export::numbers::*;

#[test]
fn numbers_are_short_and_mean_the_same() {
    assert_eq!(numbers(&[1.0, -0.0, 0.1, 1e-9, 1e300]), "1 0 0.1 1e-9 1e300");
    for value in [std::f64::consts::PI, 1.0 / 3.0, 5e-324, -1e22] {
        assert_eq!(number(value).parse::<f64>(), Ok(value));
    }
}

#[test]
fn roll_pitch_yaw_are_the_rotation() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let near = [0.0, 1e-16, 1e-12, 1e-9, 1e-8, 3e-8, 1e-6, 0.3];
    for pitch in near.iter().flat_map(|x| [quarter - x, x - quarter, *x]) {
        for (roll, yaw) in [(0.0, 0.0), (0.4, -2.9), (-3.1, 1.2), (quarter, -quarter)] {
            let rotation = urdd_document::pose::rotation_of_rpy([roll, pitch, yaw]);
            let again = urdd_document::pose::rotation_of_rpy(rpy(&rotation));
            let apart = (again - rotation).abs().max();
            assert!(apart < 1e-14, "{roll} {pitch} {yaw}: {apart}");
        }
    }
}
