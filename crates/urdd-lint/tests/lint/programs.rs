//! What programs do with a URDF, in reports.

use std::fs;

use super::{linted, written};
use urdd_findings::programs::NAMES;
use urdd_format::report::{Consequence, Deed, Finding, Severity};
use urdd_lint::LintSettings;
use urdd_programs::Program;

#[test]
fn every_program_has_its_names_in_settings() {
    let names: Vec<&str> = Program::ALL.into_iter().flat_map(Program::settings).collect();
    assert_eq!(NAMES, names);
}

/// What is found in a case, for these programs.
fn found(case: &str, programs: &[&str]) -> (Vec<Finding>, Vec<(String, Option<Deed>)>) {
    let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases").join(case);
    let mut settings = LintSettings::default();
    settings.report.programs = programs.iter().map(|name| (*name).to_owned()).collect();
    let urdf = linted(&file, &settings).report.urdds.remove(0);
    let programs = urdf.programs.into_iter().map(|program| (program.program, program.does));
    (urdf.findings, programs.collect())
}

#[test]
fn a_finding_names_each_program_once_and_is_as_severe_as_the_chosen_ones_take_it() {
    // A safety controller without k_velocity: urdfdom refuses it, others never read it.
    let case = "LNT060/invalid.urdf";
    for (chosen, severity) in [
        (&[][..], Severity::Error),
        (&["ros"], Severity::Error),
        (&["mujoco", "humble"], Severity::Error),
        (&["mujoco"], Severity::Info),
    ] {
        let (findings, programs) = found(case, chosen);
        let [finding] = &findings[..] else { panic!("{findings:#?}") };
        assert_eq!(finding.severity, severity, "{chosen:?}");
        let does = finding.programs.iter().map(|one| (one.program.as_str(), one.does));
        let refusing = ["urdfdom6", "urdfdom4", "urdfdom3", "sdformat", "pinocchio"];
        let mut does: Vec<_> = does.collect();
        does.sort_by_key(|(program, _)| refusing.iter().position(|one| one == program));
        assert_eq!(does, refusing.map(|program| (program, Deed::Refuses)), "{chosen:?}");
        let first = programs.first().map(|(program, _)| program.as_str());
        assert_eq!(
            first,
            Some(chosen.first().map_or("urdfdom6", |name| match *name {
                "ros" => "urdfdom6",
                other => other,
            }))
        );
    }
}

#[test]
fn a_finding_of_another_rule_names_the_programs() {
    // LNT017 is the rule of a `<limit>` without effort: one message.
    let (findings, _) = found("LNT017/invalid.urdf", &[]);
    let [finding] = &findings[..] else { panic!("{findings:#?}") };
    assert_eq!(finding.code, "LNT017");
    assert!(finding.message.contains("ROS, Gazebo"), "{}", finding.message);
    assert!(finding.programs.iter().any(|one| one.program == "pinocchio"));
}

/// What is found in a robot of links that hold these visuals and collisions, with `mesh.obj` beside it.
fn found_with(robot: &str, links: &[&str]) -> Vec<Finding> {
    let mut text = format!("<robot name=\"arm\">{robot}");
    for (index, inside) in links.iter().enumerate() {
        let inertial = r#"<inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>"#;
        text += &format!("<link name=\"l{index}\">{inertial}{inside}</link>");
    }
    for index in 1..links.len() {
        let ends = format!(r#"<parent link="l0"/><child link="l{index}"/>"#);
        text += &format!("<joint name=\"j{index}\" type=\"fixed\">{ends}</joint>");
    }
    let (folder, file) = written(&format!("{text}</robot>"));
    let corners = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"].map(|corner| format!("v {corner}\n"));
    let mesh = corners.concat() + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    fs::write(folder.path().join("mesh.obj"), mesh).unwrap();
    let findings = linted(&file, &LintSettings::default()).report.urdds.remove(0).findings;
    findings.into_iter().filter(|one| ["LNT060", "LNT061"].contains(&&*one.code)).collect()
}

#[test]
fn colours_of_one_name_are_about_looks() {
    let material = |color| format!("<material name=\"m\"><color rgba=\"{color}\"/></material>");
    let visual = |color| {
        format!("<visual><geometry><sphere radius=\"0.1\"/></geometry>{}</visual>", material(color))
    };
    let (red, blue) = (visual("1 0 0 1"), visual("0 0 1 1"));
    // Drake refuses it; the first wins in ROS, the last in PyBullet.
    let [refused, other] = &found_with("", &[&red, &blue])[..] else { panic!() };
    assert_eq!((&*refused.code, refused.consequence), ("LNT060", Consequence::Format));
    assert!(refused.message.contains("ROS, Gazebo, Pinocchio"), "{}", refused.message);
    assert!(refused.message.contains("read `1 0 0 1`"), "{}", refused.message);
    assert_eq!((&*other.code, other.consequence), ("LNT061", Consequence::Appearance));
    assert!(other.message.contains("PyBullet reads `0 0 1 1`"), "{}", other.message);
    // Colours that nobody tells apart; colours without a name are for PyBullet alone to mix up.
    assert_eq!(found_with("", &[&red, &visual("1.0 0.0 0 1")]), []);
    let nameless = |color| visual(color).replace("name=\"m\"", "name=\"\"");
    let only = &found_with("", &[&nameless("1 0 0 1"), &nameless("0 0 1 1")])[..];
    assert!(only.iter().all(|one| !one.message.contains("ROS")), "{only:#?}");
}

#[test]
fn a_capsule_before_its_version_is_one_finding() {
    let shape = r#"<geometry><capsule radius="0.1" length="1"/></geometry>"#;
    let found = found_with("", &[&format!("<visual>{shape}</visual>")]);
    let [finding] = &found[..] else { panic!("{found:#?}") };
    let names = finding.programs.iter().map(|one| &*one.program).collect::<Vec<_>>();
    assert!(names.contains(&"urdfdom6") && names.contains(&"urdfdom4"), "{names:?}");
}

#[test]
fn a_mesh_that_meshdir_hides_from_mujoco_is_said() {
    let shape = r#"<collision><geometry><mesh filename="mesh.obj"/></geometry></collision>"#;
    assert_eq!(found_with("", &[shape]), []);
    let settings = r#"<mujoco><compiler meshdir="meshes"/></mujoco>"#;
    let found = found_with(settings, &[shape]);
    let [finding] = &found[..] else { panic!("{found:#?}") };
    assert!(finding.message.contains("`meshdir`"), "{}", finding.message);
}
