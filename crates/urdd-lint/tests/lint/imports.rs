//! MJCFs and SDFs: which are found in folders, and what programs do with what is made of them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::{SLIDE, linted};
use urdd_format::report::Deed;
use urdd_lint::{LintSettings, lint};

/// What is imported as a person may ask for it: revolute joints, and a mass of all that moves.
fn settings() -> LintSettings {
    let mut settings = LintSettings::default();
    settings.source.import.has_revolute_balls = true;
    settings.source.import.has_tiny_masses = true;
    settings
}

#[test]
fn what_is_made_of_an_mjcf_loads_in_programs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/figures/imports/mjcf");
    let files = fs::read_dir(folder).expect("fixtures").map(|entry| entry.expect("a file").path());
    let files: Vec<_> =
        files.filter(|file| file.extension().is_some_and(|of| of == "xml")).collect();
    assert!(files.len() >= 17);
    let mut refused = BTreeSet::new();
    for file in files {
        let run = linted(&file, &settings());
        for finding in run.report.urdds.iter().flat_map(|urdf| &urdf.findings) {
            let is_fatal = |deed| matches!(deed, Deed::Refuses | Deed::Crashes);
            let does = finding.programs.iter().filter(|of| is_fatal(of.does));
            refused.extend(does.map(|of| format!("{} {}", finding.code, of.program)));
        }
    }
    // A body and a joint of one name, which MuJoCo takes and keeps; and in joints.xml, all that the base carries is below
    // a link of 1e-9 kg, which is no mass for Fortress.
    let refused: Vec<&str> = refused.iter().map(String::as_str).collect();
    let gazebo = ["sdformat", "sdformat14", "sdformat16"];
    let mut all = gazebo.map(|program| format!("LNT015 {program}")).to_vec();
    all.push("LNT060 sdformat".to_owned());
    assert_eq!(refused, all);
}

#[test]
fn a_folder_without_urdfs_has_other_descriptions() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("written");
    };
    let body = r#"<body name="b"><joint name="j" range="-1 1"/><geom size="0.1"/></body>"#;
    write("legs.xml", &format!("<mujoco><worldbody>{body}</worldbody></mujoco>"));
    write("arm.xml", r#"<mujoco><include file="legs.xml"/></mujoco>"#);
    write("look.xml", "<mujoco><asset/></mujoco>");
    write("package.xml", "<package/>");
    write("lamp.sdf", r#"<sdf version="1.9"><model name="m"><link name="l"/></model></sdf>"#);
    write("sun.sdf", r#"<sdf version="1.9"><light name="sun" type="point"/></sdf>"#);
    let names = || -> Vec<String> {
        let run = lint(&[folder.path().to_owned()], &LintSettings::default()).expect("a report");
        run.report.urdds.into_iter().map(|urdf| urdf.path).collect()
    };
    assert_eq!(names(), ["arm.xml", "lamp.sdf"]);
    // As before, where there are URDFs.
    write("slide.urdf", SLIDE);
    assert_eq!(names(), ["slide.urdf"]);
}
