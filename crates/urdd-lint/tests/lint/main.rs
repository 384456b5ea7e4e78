//! The rules by their cases, and what leaves out or mends what they find.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod allow;
mod baseline;
mod cases;
mod closed_chain;
mod consequences;
mod encodings;
mod fix;
mod hull;
mod imported;
mod imports;
mod in_memory;
mod in_programs;
mod joined;
mod large;
mod meaning;
mod messages;
mod parses;
mod primitives;
mod programs;
mod rounding;
mod rules_mass_beyond_shapes;
mod severities;
mod skips;
mod srdf;
mod vocabulary;

use std::fs;
use std::path::Path;

use urdd_lint::{LintSettings, lint};
use urdd_validate::Run;

/// A slide whose axis has length 1.01: one finding of LNT012, with a fix.
const SLIDE: &str = include_str!("../cases/LNT012/invalid.urdf");

/// What is found in one file.
fn linted(file: &Path, settings: &LintSettings) -> Run {
    lint(&[file.to_owned()], settings).expect("a report")
}

/// The codes of all places, in the order of the report.
fn codes(run: &Run) -> Vec<String> {
    let findings = run.report.urdds.iter().flat_map(|urdf| &urdf.findings);
    let places = findings.flat_map(|finding| vec![finding.code.clone(); finding.count.get()]);
    places.collect()
}

/// A folder with a file `slide.urdf` of this text, and its path.
fn written(text: &str) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("slide.urdf");
    fs::write(&file, text).expect("written");
    (folder, file)
}

#[test]
fn a_xacro_file_in_a_folder_is_left_out_unless_it_is_asked_for() {
    let (folder, file) = written(SLIDE);
    fs::write(folder.path().join("arm.urdf.xacro"), "<robot").expect("written");
    let run = lint(&[folder.path().to_owned()], &LintSettings::default()).expect("a report");
    let names: Vec<&str> = run.report.urdds.iter().map(|urdf| urdf.path.as_str()).collect();
    assert_eq!(names, ["slide.urdf"]);
    fs::remove_file(&file).expect("removed");
    let refused = lint(&[folder.path().to_owned()], &LintSettings::default());
    assert_eq!(refused.err(), Some(urdd_lint::LintError::OnlyXacro));
}

/// A case with a text in place of another, and what is found in it.
fn changed(case: &str, old: &str, new: &str) -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let text = fs::read_to_string(folder.join(case)).expect("a case");
    assert!(text.contains(old), "{case}");
    let (_folder, file) = written(&text.replace(old, new));
    let run = lint(&[file], &LintSettings::default()).expect("a report");
    let findings = run.report.urdds.into_iter().flat_map(|urdf| urdf.findings);
    findings.map(|finding| finding.code).collect()
}

#[test]
fn what_the_validator_says_is_not_said_again() {
    let link = "<link name=\"upper\">\n";
    let zero = "<inertial><mass value=\"0\"/><inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial>";
    let massless = format!("{link}{zero}");
    // That no other link has a mass is another fault.
    assert_eq!(changed("LNT006/invalid_all.urdf", link, &massless), ["SRC003", "LNT060"]);
    let limits = "lower=\"-2\" upper=\"2\"";
    let crossed = "lower=\"1\" upper=\"-1\"";
    assert_eq!(changed("LNT013/invalid.urdf", limits, crossed), ["SRC001"]);
    // A tensor that no body has: that it is also larger than the link's shapes allow follows. What two programs refuse is an
    // error, and has SRC004 in it.
    let izz = "izz=\"0.002\"";
    assert_eq!(changed("LNT001/invalid.urdf", izz, "izz=\"-0.002\""), ["LNT060"]);
    // A pose that cannot be read: nothing is said about where shapes are.
    let pose = "<origin xyz=";
    assert_eq!(changed("LNT050/invalid.urdf", pose, "<origin rpy=\"0 0 0 0\" xyz="), ["URD011"]);
}

#[test]
fn a_robot_that_is_no_xml_is_looked_at_as_far_as_it_can_be_mended() {
    let name = "<robot name=\"arm\">";
    let late = format!("\n<?xml version=\"1.0\"?>\n{name}");
    let izz = "izz=\"0.002\"";
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/LNT001");
    let text = fs::read_to_string(folder.join("invalid.urdf")).expect("a case");
    let text = text.replace(name, &late).replace(izz, "izz=\"-0.002\"");
    let (_folder, file) = written(&text);
    let run = linted(&file, &LintSettings::default());
    assert_eq!(codes(&run), ["URD011", "LNT060"]);
    let line = run.report.urdds[0].findings[1].line.expect("a line").get();
    let shown = text.lines().nth(line - 1).expect("a line");
    assert!(shown.contains("<inertia ") || shown.contains("<link "), "{shown}");
}
