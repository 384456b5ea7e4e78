//! Mimic joints that leave their limits by the rounding of these.

use std::fs;

use super::{codes, linted};
use urdd_lint::LintSettings;

/// A gripper whose driver goes to 0.725, and what its finger may reach.
fn gripper(driver: &str, multiplier: &str, finger: &str) -> String {
    let link = |name: &str| {
        format!(
            "<link name='{name}'><inertial><mass value='1'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/>\
             </inertial></link>"
        )
    };
    let joint = |name: &str, upper: &str, more: &str| {
        format!(
            "<joint name='{name}' type='revolute'><parent link='base'/><child link='{name}_link'/><axis xyz='0 0 1'/>\
             <limit lower='0' upper='{upper}' effort='1' velocity='1'/>{more}</joint>"
        )
    };
    let mimic = format!("<mimic joint='driver' multiplier='{multiplier}'/>");
    let parts = ["base", "driver_link", "finger_link"].map(link).concat();
    format!(
        "<robot name='gripper'>{parts}{}{}</robot>",
        joint("driver", driver, ""),
        joint("finger", finger, &mimic)
    )
}

#[test]
fn what_rounding_explains_is_no_finding() {
    for (driver, multiplier, finger, is_found) in [
        // 0.725 x 0.676 = 0.4901
        ("0.725", "0.676", "0.49", false),
        ("0.72500", "0.67600", "0.49000", true),
        ("0.725", "0.676", "0.48", true),
        // Whole numbers are exact.
        ("1", "1", "0.9996", true),
        ("1.000", "1", "0.9996", false),
        ("0.8", "1", "0.8", false),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("gripper.urdf");
        fs::write(&file, gripper(driver, multiplier, finger)).expect("written");
        let found = codes(&linted(&file, &LintSettings::default()));
        let has = found.contains(&"SRC002".to_owned());
        assert_eq!(has, is_found, "{driver} {multiplier} {finger}: {found:?}");
    }
}
