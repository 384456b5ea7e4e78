//! What could not be checked is said, with its reason.

use std::fs;

use super::cases::copied;
use super::{linted, written};
use urdd_lint::LintSettings;

/// A robot of two links.
const ARM: &str = include_str!("../cases/LNT040/near_miss.urdf");
/// A file of macros.
const MACROS: &str = include_str!("../cases/LNT051/invalid.urdf");

/// The rules that are said not to have checked a text, with their reasons.
fn not_checked(text: &str, select: &[&str]) -> Vec<(Vec<String>, String)> {
    let (_folder, file) = written(text);
    let mut settings = LintSettings::default();
    let select = select.iter().map(|codes| codes.parse().expect("codes"));
    settings.report.selection.select = select.collect();
    let run = linted(&file, &settings);
    let open = run.report.urdds.into_iter().flat_map(|urdf| urdf.not_checked);
    open.map(|open| (open.codes, open.reason)).collect()
}

#[test]
fn macros_leave_every_rule_but_one_not_checked() {
    for (select, rules) in [(&["SRC006"][..], 1), (&["LNT001", "SRC006"], 2), (&[], 50)] {
        let open = not_checked(MACROS, select);
        let [(codes, reason)] = &open[..] else {
            panic!("{open:?}");
        };
        assert!(codes.len() >= rules && codes.contains(&"SRC006".to_owned()));
        assert!(reason.contains("LNT051"), "{reason}");
    }
    assert_eq!(not_checked(MACROS, &["LNT051"]), []);
}

#[test]
fn an_srdf_is_called_one() {
    for element in ["<group name=\"arm\"/>", "<passive_joint name=\"elbow\"/>"] {
        let text = format!("<robot name=\"r\">{element}</robot>");
        let open = not_checked(&text, &["LNT001"]);
        let [(_, reason)] = &open[..] else {
            panic!("{open:?}");
        };
        assert!(reason.contains("elements of an SRDF"), "{reason}");
    }
}

#[test]
fn the_rule_that_refused_the_file_is_named() {
    let reason = |from: &str, to: &str| {
        assert!(ARM.contains(from), "{from}");
        let open = not_checked(&ARM.replace(from, to), &["LNT001", "LNT029"]);
        let [(codes, reason)] = &open[..] else {
            panic!("{open:?}");
        };
        assert_eq!(codes, &["LNT001", "LNT029"]);
        reason.clone()
    };
    let unknown = reason("child link=\"upper\"", "child link=\"uper\"");
    assert_eq!(unknown, "URD007 found a fault");
    let two = reason("link name=\"upper\"", "link name=\"base\"");
    assert_eq!(two, "URD002 found a fault");
    let unknown_type = reason("revolute", "revolve");
    assert_eq!(unknown_type, "URD011 found a fault");
    let axis = reason("xyz=\"0 0 1\"", "xyz=\"0 0 0\"");
    assert_eq!(axis, "URD010 found a fault");
    let no_xml = reason("</robot>", "<<<");
    assert_eq!(no_xml, "URD011 found a fault");
}

/// LNT029 says why, and counts: then nothing is left to say of the link.
#[test]
fn a_mesh_of_a_package_of_a_near_name_is_a_finding_alone() {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases/LNT029/invalid_near_package.urdf");
    let report = linted(case.as_ref(), &LintSettings::default()).report.urdds.remove(0);
    let codes: Vec<&str> = report.findings.iter().map(|finding| finding.code.as_str()).collect();
    assert_eq!((codes, report.geometry_not_verified), (vec!["LNT029"], Vec::new()));
}

#[test]
fn links_whose_meshes_were_not_read_are_named() {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases/LNT029/near_miss.urdf");
    let (folder, file) = copied(case.as_ref());
    let text = fs::read_to_string(&file).expect("it");
    let elsewhere = tempfile::tempdir().expect("a folder");
    let outside = elsewhere.path().join("box.stl");
    fs::copy(folder.path().join("meshes/box.stl"), &outside).expect("copied");
    fs::write(folder.path().join("box.vtk"), "a format").expect("written");
    let mut settings = LintSettings::default();
    settings.report.selection.ignore = vec!["LNT026".parse().expect("a code")];
    // The links that a robot with this mesh has not verified, by how many rules, and why.
    let open = |name: &str, settings: &LintSettings| {
        fs::write(&file, text.replace("meshes/box.stl", name)).expect("written");
        let report = linted(&file, settings).report.urdds.remove(0);
        assert_eq!(report.findings, [], "{name}");
        let links = report.geometry_not_verified.into_iter();
        let open = links.map(|link| (link.link.get(), link.codes.len(), link.reasons.join("; ")));
        open.collect::<Vec<_>>()
    };
    for (name, reason) in [
        (outside.to_str().expect("UTF-8"), "--allow-folder"),
        ("package://not_here/box.stl", "--package"),
        ("box.vtk", "format"),
    ] {
        let open = open(name, &settings);
        let [(1, rules, why)] = &open[..] else {
            panic!("{name}: {open:?}");
        };
        assert!(*rules > 5 && why.contains(reason), "{name}: {open:?}");
    }
    assert_eq!(open("meshes/box.stl", &settings), []);
    settings.source.allowed_folders = vec![elsewhere.path().to_owned()];
    assert_eq!(open(outside.to_str().expect("UTF-8"), &settings), []);
}
