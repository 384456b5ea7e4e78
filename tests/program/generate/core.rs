//! The content of modules, compared with the validator and with `tests/support`, an independent producer.

use std::fs;
use std::path::Path;

use proptest::test_runner::{Config, TestCaseError, TestRunner};
use urdd_format::registry::ModuleKind;
use urdd_generate::{Selection, Settings, generate};

use crate::generate::{findings_of, our_robots, read_json};
use testkit::difference::difference;
use testkit::fixture::Fixture;
use testkit::robot::{Robot, arbitrary_robot};
use testkit::robots::{made_of, made_with_notes};
use testkit::trials::trials;

#[test]
fn our_robots_have_no_findings() {
    for (name, path) in our_robots() {
        let (_folder, target, mut notes) = made_with_notes(&path);
        notes.retain(|note| note.kind.changes_robot());
        assert_eq!(notes, [], "{name}");
        assert_eq!(findings_of(&target), [], "{name}");
    }
}

#[test]
fn arbitrary_robots_are_as_the_others_have_them() {
    let core = Selection::parse(["core", "kinematics_samples"]).unwrap();
    on_arbitrary_robots(trials(12), &core);
}

/// With meshes, pieces, boxes and distances.
#[test]
fn arbitrary_robots_have_no_findings() {
    on_arbitrary_robots(trials(2), &Selection::all());
}

/// Found by `.ci/full`: points inside, in the notch between two spheres, became a piece of three points in a line.
#[test]
fn two_spheres_that_overlap_have_no_findings() {
    let urdf = r#"<robot name="a"><link name="a">
        <visual><origin xyz="-0.1312080394398778 0.887 -1.152" rpy="1.959 -3.141592653589793 0.573"/>
            <geometry><sphere radius="1.0980075315931104"/></geometry></visual>
        <visual><origin xyz="-1.5993753573380964 -1.0 -0.21447663315745355"/>
            <geometry><sphere radius="1.2379947201203267"/></geometry></visual>
    </link></robot>"#;
    let (_folder, target) = made_of(urdf);
    assert_eq!(findings_of(&target), []);
}

fn on_arbitrary_robots(cases: u32, selection: &Selection) {
    let config =
        Config { cases, failure_persistence: None, max_shrink_iters: 100, ..Config::default() };
    let settings = Settings { selection: selection.clone(), ..Settings::default() };
    let outcome = TestRunner::new(config)
        .run(&arbitrary_robot(), |robot| compare(&robot, &settings).map_err(TestCaseError::fail));
    outcome.unwrap_or_else(|failure| panic!("{failure}"));
}

fn compare(robot: &Robot, settings: &Settings) -> Result<(), String> {
    let folder = testkit::temporary::folder();
    let (source, target) = (folder.path().join("robot.urdf"), folder.path().join("out"));
    let xml = robot.to_urdf_xml();
    fs::write(&source, &xml).unwrap();
    generate(&source, &target, settings, &()).map_err(|error| error.to_string())?;
    let carried = fs::read_to_string(target.join("robot.urdf")).unwrap();
    if carried != xml {
        return Err("the URDF was changed".to_owned());
    }
    let findings = findings_of(&target);
    if let Some(finding) = findings.iter().find(|(code, ..)| !code.starts_with("SRC")) {
        return Err(format!("{finding:?}"));
    }
    let theirs = Fixture::core(robot);
    let mut compared = 0;
    for kind in ModuleKind::ALL.iter().filter(|kind| !kind.folder().contains('/')) {
        let Some(theirs) = theirs.documents.get(kind.name()) else {
            continue;
        };
        let ours = read_json(&target.join(kind.folder()).join("module.json"));
        let found = difference(&ours, theirs, "");
        found.map_or(Ok(()), |found| Err(format!("{}{found}", kind.name())))?;
        compared += 1;
    }
    if compared != 6 {
        return Err(format!("{compared} modules were compared"));
    }
    Ok(())
}

#[test]
fn what_is_asked_for_is_made_and_the_core_class_with_it() {
    let folder = testkit::temporary::folder();
    let selection = Selection::parse(["dof"]).unwrap();
    let settings = Settings { selection, ..Settings::default() };
    let (_, robot) = our_robots().remove(0);
    let target = folder.path().join("out");
    generate(&robot, &target, &settings, &()).unwrap();
    assert!(exists(&target, "connections_module"));
    assert!(!exists(&target, "kinematics_samples_module"));
    assert!(!exists(&target, "mesh_modules"));
    let codes: Vec<String> = findings_of(&target).into_iter().map(|(code, ..)| code).collect();
    assert_eq!(codes, ["KIN005"], "the samples are recommended");
    let error = Selection::parse(["dof", "dofs"]).unwrap_err();
    assert_eq!(error.word, "dofs");
}

fn exists(target: &Path, name: &str) -> bool {
    target.join(name).exists()
}
