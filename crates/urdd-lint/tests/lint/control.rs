//! Faults in `<ros2_control>`: each is a finding at its place.

use std::fs;
use std::path::Path;

use urdd_format::report::{Finding, Severity, Urdd};
use urdd_lint::LintSettings;

use crate::linted;

const HARDWARE: &str = "<hardware><plugin>mock_components/GenericSystem</plugin></hardware>";
const POSITION: &str = "<state_interface name=\"position\"/>";
const COMMAND: &str = "<command_interface name=\"position\"/>";

/// A gripper of two fingers, the second a mimic, and a camera that is fixed.
fn gripper(controls: &str) -> String {
    let link = |name: &str| {
        format!(
            r#"<link name="{name}"><inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>"#
        )
    };
    let joint = |name: &str, kind: &str, child: &str, inside: &str| {
        format!(
            r#"<joint name="{name}" type="{kind}"><parent link="palm"/><child link="{child}"/>{inside}</joint>"#
        )
    };
    let moves = r#"<axis xyz="0 1 0"/><limit lower="0" upper="0.03" effort="20" velocity="0.1"/>"#;
    let parts = [
        ["palm", "left", "right", "camera"].map(link).concat(),
        joint("grip", "prismatic", "left", moves),
        joint("follow", "prismatic", "right", &format!("{moves}<mimic joint=\"grip\"/>")),
        joint("mount", "fixed", "camera", ""),
    ];
    format!("<robot name=\"gripper\">\n{}\n{controls}\n</robot>\n", parts.join("\n"))
}

fn control(attributes: &str, hardware: &str, inside: &[&str]) -> String {
    format!("<ros2_control {attributes}>\n{hardware}\n{}\n</ros2_control>", inside.join("\n"))
}

fn joint(attributes: &str, inside: &[&str]) -> String {
    format!("<joint {attributes}>\n{}\n</joint>", inside.join("\n"))
}

fn lint(text: &str, programs: &[&str]) -> Urdd {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.urdf");
    fs::write(&file, text).unwrap();
    of_file(&file, programs)
}

fn of_file(file: &Path, programs: &[&str]) -> Urdd {
    let mut settings = LintSettings::default();
    settings.report.programs = programs.iter().map(|name| (*name).to_owned()).collect();
    linted(file, &settings).report.urdds.remove(0)
}

/// Where a finding is: the text from there to the end of its line.
fn at<'t>(text: &'t str, finding: &Finding) -> &'t str {
    let place = &finding.places[0];
    let line = text.lines().nth(place.line.unwrap().get() - 1).unwrap();
    &line[place.column.unwrap().get() - 1..]
}

#[test]
fn each_fault_is_a_finding_at_its_place() {
    let grip = joint("name=\"grip\"", &[COMMAND, POSITION]);
    let hand = |joints: &[&str]| control("name=\"hand\" type=\"system\"", HARDWARE, joints);
    let with =
        |attributes: &str, inside: &[&str]| gripper(&hand(&[&grip, &joint(attributes, inside)]));
    let first = |attributes: &str| gripper(&control(attributes, HARDWARE, &[&grip]));
    let cases: [(String, &str, &str, &str); 15] = [
        (with("name=\"follow\"", &[COMMAND, POSITION]), "LNT060", COMMAND, "jazzy"),
        (with("name=\"follow\" mimic=\"true\"", &[COMMAND]), "LNT060", COMMAND, "jazzy"),
        (with("name=\"mount\"", &[POSITION]), "LNT060", "<joint name=\"mount\">", "jazzy"),
        (with("name=\"mount\"", &[COMMAND]), "LNT060", "<joint name=\"mount\">", "jazzy"),
        (
            gripper(&hand(&[&joint("name=\"follow\"", &[POSITION])])),
            "LNT060",
            "<joint name=\"follow\">",
            "jazzy",
        ),
        (
            gripper(&hand(&[&joint("name=\"grip\" mimic=\"true\"", &[POSITION])])),
            "LNT060",
            "mimic=\"true\">",
            "jazzy",
        ),
        (with("name=\"grp\"", &[POSITION]), "LNT043", "name=\"grp\">", "jazzy"),
        (first("type=\"system\""), "LNT060", "<ros2_control type=\"system\">", "both"),
        (first("name=\"hand\""), "LNT060", "<ros2_control name=\"hand\">", "both"),
        (first("name=\"hand\" type=\"System\""), "LNT060", "type=\"System\">", "both"),
        (
            gripper(&control("name=\"hand\" type=\"system\"", "", &[&grip])),
            "LNT060",
            "<ros2_control name=\"hand\" type=\"system\">",
            "both",
        ),
        (
            gripper(&control("name=\"hand\" type=\"system\"", "<hardware/>", &[&grip])),
            "LNT060",
            "<hardware/>",
            "both",
        ),
        (
            gripper(&format!("<gazebo>\n{}\n</gazebo>", hand(&[&grip]))),
            "LNT060",
            "<ros2_control name=\"hand\" type=\"system\">",
            "both",
        ),
        (
            gripper(&format!("{}\n{}", hand(&[&grip]), hand(&[]))),
            "LNT060",
            "name=\"hand\" type=\"system\">",
            "both",
        ),
        (
            gripper(&hand(&[&joint(
                "name=\"grip\"",
                &[
                    "<state_interface name=\"position\">\n<param name=\"initial_value\">0.0.1</param>\n</state_interface>",
                ],
            )])),
            "LNT060",
            "<param name=\"initial_value\">0.0.1</param>",
            "both",
        ),
    ];
    for (text, code, place, programs) in &cases {
        let urdf = lint(text, &[]);
        let found: Vec<&Finding> = urdf.findings.iter().filter(|one| one.code == *code).collect();
        let [finding] = &found[..] else { panic!("{text}{:#?}", urdf.findings) };
        assert_eq!(at(text, finding), *place, "{text}");
        let names = finding.programs.iter().map(|one| one.program.as_str());
        let expected: &[&str] = match *programs {
            "jazzy" => &["ros2_control4"],
            _ => &["ros2_control4", "ros2_control2"],
        };
        assert_eq!(names.collect::<Vec<_>>(), expected, "{text}");
        // LNT043 is an error in any case.
        let own = if *code == "LNT043" { Severity::Error } else { Severity::Warning };
        assert_eq!(finding.severity, own, "{text}");
        assert_eq!(
            lint(text, &["jazzy"]).findings.iter().find(|one| one.code == *code).unwrap().severity,
            Severity::Error
        );
    }
}

#[test]
fn a_joint_of_two_hardware_is_lost_in_the_second() {
    let grip = joint("name=\"grip\"", &[COMMAND, POSITION]);
    let hand =
        |name: &str| control(&format!("name=\"{name}\" type=\"system\""), HARDWARE, &[&grip]);
    let text = gripper(&format!("{}\n{}", hand("one"), hand("two")));
    let urdf = lint(&text, &[]);
    let found = urdf.findings.iter().map(|one| (&*one.code, one.line.unwrap().get()));
    // Those of the second: the last lines of these texts.
    let last = |wanted| text.lines().zip(1..).filter(|(line, _)| *line == wanted).last().unwrap().1;
    let expected = [("LNT061", last(COMMAND)), ("LNT061", last(POSITION))];
    assert_eq!(found.collect::<Vec<_>>(), expected, "{:#?}", urdf.findings);
    let says = "ros2_control leaves out the command interface";
    assert!(urdf.findings[0].message.contains(says), "{}", urdf.findings[0].message);
}

#[test]
fn a_sound_gripper_and_one_without_ros2_control_have_no_finding() {
    let joints =
        [joint("name=\"grip\"", &[COMMAND, POSITION]), joint("name=\"follow\"", &[POSITION])];
    let sound = control("name=\"hand\" type=\"system\"", HARDWARE, &[&joints[0], &joints[1]]);
    let driven = sound.replace(
        "<joint name=\"follow\">",
        "<joint name=\"follow\" mimic=\"false\">\n<command_interface name=\"position\"/>",
    );
    let asked = |urdf: &Urdd| urdf.programs.iter().any(|one| one.family == "ros2_control");
    for (text, is_asked) in [(sound.as_str(), true), (&driven, true), ("", false)] {
        for programs in [&[][..], &["ros2_control", "gz_ros2_control"]] {
            let urdf = lint(&gripper(text), programs);
            assert_eq!(urdf.findings, [], "{text}");
            assert_eq!(asked(&urdf), is_asked, "{text}");
        }
    }
}
