//! What programs do with a URDF, in reports.

use super::linted;
use urdd_findings::programs::NAMES;
use urdd_format::report::{Deed, Finding, Severity};
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
