//! Rules that say an error where ROS or two programs refuse the whole robot, and a warning or an info elsewhere.

use std::fs;
use std::path::Path;

use super::cases::copied;
use super::linted;
use urdd_format::report::Severity::{self, Error, Info, Warning};
use urdd_lint::LintSettings;

const HUGE: &str = "huge.stl";

/// A binary STL of one triangle more than MuJoCo reads.
fn huge() -> Vec<u8> {
    const COUNT: u32 = 200_001;
    let corners: [f32; 12] = [0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.];
    let mut triangle = corners.map(f32::to_le_bytes).concat();
    triangle.extend([0, 0]);
    let head = [&[0; 80][..], &COUNT.to_le_bytes()].concat();
    [head, triangle.repeat(COUNT as usize)].concat()
}

/// The finding of a case's rule, its only one, after a text was replaced by another.
fn severity(case: &str, old: &str, new: &str) -> Severity {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let (copy, file) = copied(&folder.join(case));
    let text = fs::read_to_string(&file).expect("a case");
    assert!(text.contains(old), "{case}: {old}");
    fs::write(&file, text.replace(old, new)).expect("written");
    if new == HUGE {
        fs::write(copy.path().join(HUGE), huge()).expect("written");
    }
    let found = linted(&file, &LintSettings::default()).report.urdds.remove(0).findings;
    let code = &case[.."LNT000".len()];
    let own: Vec<Severity> =
        (found.iter().filter(|one| one.code == code)).map(|one| one.severity).collect();
    assert_eq!(own.len(), 1, "{case}, {new}: {found:#?}");
    own[0]
}

#[test]
fn what_programs_refuse_whole_is_an_error() {
    for (case, old, new, expected) in [
        ("LNT006/invalid_all.urdf", "", "", Warning),
        ("LNT006/invalid_all.urdf", "collision>", "visual>", Error),
        ("LNT013/invalid.urdf", "", "", Warning),
        ("LNT013/invalid_negative.urdf", "", "", Error),
        ("LNT015/invalid.urdf", "", "", Warning),
        ("LNT015/invalid_world.urdf", "", "", Error),
        ("LNT015/invalid_carried_world.urdf", "", "", Warning),
        ("LNT017/invalid.urdf", "", "", Error),
        ("LNT023/invalid.urdf", "", "", Warning),
        ("LNT023/invalid.urdf", "1 -1 1", "1 0 1", Error),
        ("LNT024/invalid.urdf", "", "", Info),
        ("LNT024/invalid.urdf", "heavy.obj", HUGE, Warning),
        ("LNT034/invalid.urdf", "", "", Warning),
        ("LNT034/invalid.urdf", "collision>", "visual>", Warning),
        ("LNT063/invalid_robot.urdf", "", "", Warning),
        ("LNT063/invalid_xml.urdf", "", "", Error),
    ] {
        assert_eq!(severity(case, old, new), expected, "{case}, {new}");
    }
}

#[test]
fn a_single_tiny_mesh_is_a_warning_and_several_are_an_error() {
    let text = include_str!("../cases/LNT022/invalid_tiny.urdf");
    let mesh = include_bytes!("../cases/LNT022/big.stl");
    for (text, severity) in [
        (text.to_owned(), Severity::Warning),
        (text.replace("0.001 0.001 0.001", "0.000001 0.000001 0.000001"), Severity::Error),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("big.stl"), mesh).expect("written");
        let file = folder.path().join("arm.urdf");
        std::fs::write(&file, text).expect("written");
        let run = super::linted(&file, &LintSettings::default());
        let findings = run.report.urdds.into_iter().flat_map(|urdf| urdf.findings);
        let found: Vec<Severity> =
            findings.filter(|one| one.code == "LNT022").map(|one| one.severity).collect();
        assert!(!found.is_empty() && found.iter().all(|one| *one == severity), "{found:?}");
    }
}
