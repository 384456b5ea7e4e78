//! What rules say of variants of one fault, and do not.

use std::fs;
use std::path::Path;

use super::cases::copied;
use super::linted;
use urdd_lint::LintSettings;

/// The message of a case's rule after a text was replaced by another; empty without one.
fn said(case: &str, old: &str, new: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let (_copy, file) = copied(&folder.join(case));
    let text = fs::read_to_string(&file).expect("a case");
    assert!(text.contains(old), "{case}: {old}");
    fs::write(&file, text.replace(old, new)).expect("written");
    let found = linted(&file, &LintSettings::default()).report.urdds.remove(0).findings;
    let own = found.into_iter().find(|one| one.code == case[..6]);
    own.map(|one| one.message).unwrap_or_default()
}

/// Reached in PyBullet 3.2.7 with targets of ±1 and -3, and the limits of the joint in Drake 1.5x:
/// `-1` and `1` without limits, 0 with `lower="0" upper="0"`, 0 to 0.5 with `upper="0.5"`; Drake ends for crossed limits.
#[test]
fn limits_of_a_continuous_joint_are_told_by_their_form() {
    let limits = "lower=\"-2\" upper=\"2\"";
    for (new, words) in [
        ("lower=\"-2\" upper=\"2\"", "the limits -2 to 2, which Drake and PyBullet keep to"),
        ("lower=\"0\" upper=\"0\"", "both limits of a continuous joint are 0"),
        ("lower=\"1\" upper=\"-1\"", "Drake refuses the robot"),
        ("lower=\"-0.5\"", "only a lower limit, -0.5: Drake keeps to it, PyBullet ignores it"),
        ("lower=\"-2\"", "PyBullet cuts targets to -2 to -1"),
        (
            "upper=\"0.5\"",
            "only an upper limit, 0.5: Drake keeps to it, PyBullet cuts targets to 0 to 0.5",
        ),
        ("upper=\"-0.5\"", "PyBullet ignores it"),
    ] {
        let said = said("LNT014/invalid.urdf", limits, new);
        assert!(said.contains(words), "{new}: {said}");
    }
    assert_eq!(said("LNT014/invalid.urdf", limits, "lower=\"x\" upper=\"0\""), "");
}

#[test]
fn a_scale_is_to_be_removed_where_there_is_one() {
    let scale = "scale=\"0.001 0.001 0.001\"";
    let mesh = "filename=\"big.stl\"";
    for (new, words) in [
        (String::new(), "if it is in millimetres, write scale="),
        (
            format!("{mesh} scale=\"1000 1000 1000\""),
            "far more than the robot; if it is in metres, remove the scale",
        ),
        (
            format!("{mesh} scale=\"1e-7 1e-7 1e-7\""),
            "less than a millimetre; if it is in metres, remove the scale",
        ),
    ] {
        let new = if new.is_empty() { mesh } else { &new };
        let said = said("LNT022/invalid.urdf", mesh, new);
        assert!(said.contains(words), "{new}: {said}");
        assert!(!said.contains(scale) || words.contains("write"), "{new}: {said}");
    }
}

#[test]
fn a_mesh_that_cannot_be_read_says_once_what_to_do() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/LNT035/invalid.urdf");
    for (content, message) in [
        (&b""[..], "the mesh cannot be read: the file is empty; export the mesh again"),
        (
            b"solid a\nendsolid a\n",
            "the mesh cannot be read: it holds no triangle with an area; export the mesh again",
        ),
    ] {
        let (copy, file) = copied(&folder);
        fs::write(copy.path().join("pointer.stl"), content).expect("written");
        let found = linted(&file, &LintSettings::default()).report.urdds.remove(0).findings;
        let [one] = &found[..] else { panic!("{found:#?}") };
        // In brackets, what programs do.
        assert_eq!(one.message.split(" (").next(), Some(message));
    }
}
