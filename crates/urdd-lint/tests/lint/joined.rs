//! Which findings have what programs do: those of the same fault, and no others.

use super::{linted, written};
use urdd_format::report::{Deed, Finding};
use urdd_lint::LintSettings;

const INERTIAL: &str = r#"<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"#;

fn link(name: &str) -> String {
    format!("<link name=\"{name}\">{INERTIAL}</link>\n")
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, inside: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>{inside}</joint>\n"
    )
}

fn found(text: &str) -> Vec<Finding> {
    let (_folder, file) = written(text);
    linted(&file, &LintSettings::default()).report.urdds.remove(0).findings
}

/// The code and line of each place, and the programs that refuse the robot there.
fn refusing(text: &str) -> Vec<(String, usize, Vec<String>)> {
    let of = |finding: &Finding| {
        let refuses = finding.programs.iter().filter(|one| one.does >= Deed::Refuses);
        let line = finding.line.map_or(0, |line| line.get());
        (finding.code.clone(), line, refuses.map(|one| one.program.clone()).collect())
    };
    found(text).iter().map(of).collect()
}

/// The codes and lines of findings with a program that refuses the robot.
fn refused(text: &str, program: &str) -> Vec<(String, usize)> {
    let all = refusing(text).into_iter();
    let refused = all.filter(|(.., programs)| programs.iter().any(|one| one == program));
    refused.map(|(code, line, _)| (code, line)).collect()
}

#[test]
fn a_text_that_is_no_xml_has_the_fault_of_its_xml_and_others_have_theirs() {
    let bad = "<origin xyz=\"0.07, 0, -0.69\"/>";
    let parts = link("a") + &link("b") + &joint("j", "fixed", "a", "b", bad);
    let robot = format!("<robot name=\"r\">\n{parts}</robot>\n");
    // ROS reads any version of XML, and no commas between numbers; three.js refuses the version.
    let versioned = format!("<?xml version=\"0.0\"?>\n{robot}");
    assert_eq!(refused(&versioned, "urdfdom6"), [("LNT060".to_owned(), 5)]);
    assert!(refused(&versioned, "urdf_loader").contains(&("URD011".to_owned(), 1)));
    assert_eq!(refused(&versioned.replace(bad, ""), "urdfdom6"), []);
    // Lines that are cut off are counted, and prefixes that are declared move nothing.
    let late = format!("\n\n<?xml version=\"1.0\"?>\n{robot}");
    let late_line = late.lines().position(|line| line.contains(bad)).expect("a line") + 1;
    let lines = found(&late).into_iter().filter(|one| one.code == "LNT060").map(|one| one.line);
    assert!(lines.flatten().all(|line| line.get() == late_line), "{late}");
    let prefixed = robot.replace("<link name=\"b\">", "<link name=\"b\" drake:x=\"1\">");
    assert_eq!(refused(&prefixed, "urdfdom6"), [("LNT060".to_owned(), 4)]);
    // What cannot be mended, and tinyxml2 reads: an entity that nobody declared.
    let broken = robot.replace("</robot>", "<!-- a -- b --></robot>");
    assert_eq!(refused(&broken, "urdfdom6"), [("LNT060".to_owned(), 4)]);
    assert!(refusing(&broken).iter().any(|(code, ..)| code == "URD011"));
}

#[test]
fn a_name_that_is_refused_is_that_of_its_part() {
    let parts = link("base") + &link("/slash") + &joint("j", "fixed", "base", "/slash", "");
    let found = refused(&format!("<robot name=\"/r\">\n{parts}</robot>"), "usd");
    assert_eq!(found, [("LNT060".to_owned(), 1)]);
    // MuJoCo says it of the joint.
    let world = link("base")
        + &link("world")
        + &joint("j", "continuous", "base", "world", "<axis xyz=\"0 0 1\"/>");
    let found = refused(&format!("<robot name=\"r\">\n{world}</robot>"), "mujoco");
    assert_eq!(found, [("LNT015".to_owned(), 3)]);
}

#[test]
fn a_link_without_a_mass_is_no_reason_for_another_one() {
    let axis = "<axis xyz=\"0 0 1\"/>";
    let joints =
        joint("j1", "continuous", "base", "a", axis) + &joint("j2", "continuous", "a", "b", axis);
    let robot = |base: &str, a: &str| {
        format!("<robot name=\"r\">\n{base}{a}<link name=\"b\"/>\n{joints}</robot>")
    };
    let empty = |name: &str| format!("<link name=\"{name}\"/>\n");
    let found = refused(&robot(&empty("base"), &link("a")), "sdformat");
    assert_eq!(found, [("LNT060".to_owned(), 2)]);
    // Where no link has a mass, that is the fault.
    let found = refused(&robot(&empty("base"), &empty("a")), "sdformat");
    assert_eq!(found, [("LNT006".to_owned(), 1)]);
}

#[test]
fn a_material_that_is_not_defined_is_one_finding_wherever_it_is_used() {
    let visual = |name: &str| {
        format!(
            "<visual><geometry><sphere radius=\"1\"/></geometry><material name=\"{name}\"/></visual>"
        )
    };
    let link = |name: &str, material: &str| {
        format!("<link name=\"{name}\">{INERTIAL}{}</link>\n", visual(material))
    };
    let joints = joint("j1", "fixed", "a", "b", "") + &joint("j2", "fixed", "a", "c", "");
    let text = format!(
        "<robot name=\"r\">\n{}{}{}{joints}</robot>",
        link("a", "red"),
        link("b", "red"),
        link("c", "blue")
    );
    let line = |one: Option<urdd_format::index::Count>| one.map_or(0, |line| line.get());
    let lines: Vec<(String, usize)> = found(&text)
        .iter()
        .flat_map(|one| one.places.iter().map(|place| (one.code.clone(), line(place.line))))
        .collect();
    assert_eq!(lines, [("LNT041".to_owned(), 2), ("LNT041".to_owned(), 4)]);
}

#[test]
fn an_empty_name_is_one_finding_where_it_is_and_where_it_is_used() {
    let parts = link("a") + &link("") + &joint("j", "fixed", "a", "", "");
    let text = format!("<robot name=\"r\">\n{parts}</robot>");
    let codes: Vec<(String, usize)> =
        refusing(&text).into_iter().map(|(code, line, _)| (code, line)).collect();
    assert_eq!(codes, [("LNT015".to_owned(), 3)]);
    assert_eq!(refused(&text, "urdfdom6"), codes);
    assert_eq!(refused(&text, "drake"), codes);
}
