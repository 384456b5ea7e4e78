//! SHP022 to SHP025: distances in the sampled configurations.

use serde_json::json;
use urdd_format::urdf::{Axis, JointType};
use urdd_validate::code::Code::*;

use super::{REACH, STATISTICS, number, set_pair};
use crate::meshes::{boxy, robot_of};
use crate::{Case, changed};
use testkit::fixture::Fixture;
use testkit::robot::*;

/// Two boxes, 1 m apart; one rotates about its own centre.
fn turning_boxes() -> Fixture {
    let mut robot = robot_of(vec![boxy("a"), boxy("b")]);
    robot.urdf.joints[0].joint_type = JointType::Revolute;
    robot.urdf.joints[0].axis = Some(Axis { xyz: Some([0.0, 1.0, 0.0]) });
    robot.urdf.joints[0].limit = limit(-1.0, 1.0);
    Fixture::full_with_edits(&robot, Vec::new())
}

/// Sets the number of samples in the statistics to more than a validator checks.
fn of_a_billion(f: &mut Fixture) {
    f.set(STATISTICS, "/num_samples", json!(1_000_000_000));
}

/// Rounds all distances as a producer may.
fn to_seven_digits(f: &mut Fixture) {
    let mut changed = 0;
    for kind in ["full", "decomposition"] {
        for shapes in ["convex_hulls", "obbs", "bounding_spheres"] {
            for key in ["mean", "min", "max"] {
                let matrix = format!("/{kind}_{shapes}/{key}_distances");
                let rows: Vec<Vec<f64>> =
                    serde_json::from_value(f.get(STATISTICS, &matrix).clone()).expect("a matrix");
                let rounded = |x: &f64| format!("{x:.6e}").parse::<f64>().expect("a number");
                let rounded = rows.iter().map(|row| row.iter().map(rounded).collect::<Vec<f64>>());
                let rounded: Vec<Vec<f64>> = rounded.collect();
                changed += usize::from(rounded != rows);
                f.set(STATISTICS, &matrix, json!(rounded));
            }
        }
    }
    assert!(changed > 6, "{changed} matrices have more digits");
}

/// Moves the smallest and the largest distance of two equal boxes apart, by 0.8 of the tolerance each. `reach` is the
/// robot's reach, m.
fn moved_apart(f: &mut Fixture, reach: f64) {
    let of_shape = number(f, REACH, "/full_obbs_maximum_distances/0");
    let by = 0.8e-5 * 2.0 * (reach + of_shape);
    for (key, by) in [("min", -by), ("max", by)] {
        let matrix = format!("/full_obbs/{key}_distances");
        let old = number(f, STATISTICS, &format!("{matrix}/0/1"));
        set_pair(f, STATISTICS, &matrix, (0, 1), json!(old + by));
    }
}

/// SHP022 to SHP025.
pub fn cases() -> Vec<Case> {
    let scale_pair = |f: &mut Fixture, matrix: &str, pair: (usize, usize), factor: f64| {
        let old = number(f, STATISTICS, &format!("{matrix}/{}/{}", pair.0, pair.1));
        assert_ne!(old, 0.0);
        set_pair(f, STATISTICS, matrix, pair, json!(old * factor));
    };
    vec![
        changed(
            SHP022,
            "locked-joint-between",
            false,
            || super::sliding(0.3, 0.0, 0.0),
            |f| moved_apart(f, 1.7),
        ),
        changed(SHP023, "of-few-samples", true, turning_boxes, of_a_billion),
        changed(SHP023, "of-more-samples", false, turning_boxes, move |f| {
            of_a_billion(f);
            for kind in ["full", "decomposition"] {
                for shapes in ["convex_hulls", "obbs", "bounding_spheres"] {
                    let rows = f.get(STATISTICS, &format!("/{kind}_{shapes}/mean_distances"));
                    let n = rows.as_array().map_or(0, Vec::len);
                    for pair in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
                        let at = |key: &str| format!("/{kind}_{shapes}/{key}_distances");
                        let mean = format!("{}/{}/{}", at("mean"), pair.0, pair.1);
                        if f.get(STATISTICS, &format!("{}/{}/{}", at("min"), pair.0, pair.1))
                            != f.get(STATISTICS, &format!("{}/{}/{}", at("max"), pair.0, pair.1))
                        {
                            assert_ne!(number(f, STATISTICS, &mean), 0.0);
                            scale_pair(f, &at("min"), pair, 0.5);
                            scale_pair(f, &at("max"), pair, 2.0);
                        }
                    }
                }
            }
        }),
        changed(SHP024, "seven-digits", false, turning_boxes, to_seven_digits),
    ]
}
