//! What programs do with a URDF, in reports.

use std::fs;

use super::{linted, written};
use urdd_findings::report::human;
use urdd_findings::report::programs::NAMES;
use urdd_findings::report::style::Style;
use urdd_format::report::{Consequence, Deed, Finding, Severity};
use urdd_lint::{LintSettings, lint};
use urdd_programs::Program;

#[test]
fn every_program_has_its_names_in_settings() {
    let mut names: Vec<&str> = Vec::new();
    for name in Program::ALL.into_iter().flat_map(Program::settings) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
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
        let refusing = [
            "urdfdom6",
            "urdfdom4",
            "urdfdom3",
            "sdformat",
            "sdformat14",
            "sdformat16",
            "pinocchio",
        ];
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
fn of_many_urdfs_a_refusal_that_no_finding_says_has_its_reason() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = "<geometry><mesh filename=\"package://none/a.stl\"/></geometry>";
    for name in ["a", "b", "c", "d"] {
        let link = format!("<link name=\"l\"><collision>{mesh}</collision></link>");
        let text = format!("<robot name=\"{name}\">{link}</robot>");
        fs::write(folder.path().join(format!("{name}.urdf")), text).unwrap();
    }
    let run = lint(&[folder.path().to_owned()], &LintSettings::default()).unwrap();
    let mut text = String::new();
    human::write(&run.report, Style { width: 500, ..Style::default() }, &mut text).unwrap();
    let line = text.lines().find(|line| line.trim().starts_with("MuJoCo 4")).unwrap();
    assert!(line.contains("4 refused; 4: MuJoCo takes `scheme://` as a folder"), "{text}");
}

#[test]
fn a_mass_that_is_next_to_nothing_is_one_finding() {
    let link = |name: &str, mass: &str| {
        let inertia =
            "<inertia ixx=\"1e-9\" ixy=\"0\" ixz=\"0\" iyy=\"1e-9\" iyz=\"0\" izz=\"1e-9\"/>";
        let inertial = format!("<inertial><mass value=\"{mass}\"/>{inertia}</inertial>");
        let shape = "<geometry><box size=\"0.1 0.1 0.1\"/></geometry>";
        format!("<link name=\"{name}\">{inertial}<collision>{shape}</collision></link>")
    };
    let ends =
        "<parent link=\"base\"/><child link=\"arm\"/><origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/>";
    let limit = "<limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"1\"/>";
    let joint = format!("<joint name=\"turn\" type=\"revolute\">{ends}{limit}</joint>");
    let parts = link("base", "1") + &link("arm", "1e-6") + &joint;
    let (_folder, file) = written(&format!("<robot name=\"arm\">{parts}</robot>"));
    let findings = linted(&file, &LintSettings::default()).report.urdds.remove(0).findings;
    let density = findings.iter().find(|one| one.code == "LNT003").expect("a density");
    assert!(density.programs.iter().any(|one| one.program == "sdformat"), "{findings:#?}");
    assert!(
        findings.iter().all(|one| !["LNT060", "LNT061"].contains(&&*one.code)),
        "{findings:#?}"
    );
}

#[test]
fn a_robot_without_links_is_one_finding() {
    let control = "<ros2_control name=\"c\" type=\"system\"><hardware><plugin>a/B</plugin></hardware><joint name=\"j\"/></ros2_control>";
    for inside in ["", control] {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.urdf");
        fs::write(&file, format!("<robot name=\"a\">{inside}</robot>")).expect("written");
        let findings = linted(&file, &LintSettings::default()).report.urdds.remove(0).findings;
        let [finding] = &findings[..] else { panic!("{inside}: {findings:#?}") };
        assert_eq!(finding.code, "URD004");
        assert!(finding.programs.iter().any(|one| one.does == Deed::Refuses), "{finding:#?}");
    }
}

#[test]
fn a_missing_file_that_a_link_names_twice_is_one_finding() {
    let shape = |kind, file| {
        format!("<{kind}><geometry><mesh filename=\"file:///{file}\"/></geometry></{kind}>")
    };
    let arm = |collision| {
        let shapes = shape("visual", "no/such.dae") + &shape("collision", collision);
        let inertia = "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>";
        let inertial = format!("<inertial><mass value=\"1\"/>{inertia}</inertial>");
        written(&format!("<robot name=\"arm\"><link name=\"a\">{inertial}{shapes}</link></robot>"))
    };
    let found = |collision| {
        let (_folder, file) = arm(collision);
        let findings = linted(&file, &LintSettings::default()).report.urdds.remove(0).findings;
        findings.iter().flat_map(|one| vec![one.code.clone(); one.count.get()]).collect::<Vec<_>>()
    };
    assert_eq!(found("no/such.dae"), ["LNT026"]);
    assert_eq!(found("no/other.dae"), ["LNT026", "LNT026"]);
}

#[test]
fn the_version_of_a_file_is_not_that_of_urdf() {
    assert_eq!(found_with("<version>2025-09-17_13-38-40</version>", &[""]), []);
    let found = found_with("<version>1.1</version>", &[""]);
    let [finding] = &found[..] else { panic!("{found:#?}") };
    assert!(finding.message.contains("`<version>` is where URDF does not have it"));
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
    let says = "another material has no name either: PyBullet";
    assert!(only.iter().any(|one| one.message.starts_with(says)), "{only:#?}");
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

/// libsdformat 12 makes one link of those that fixed joints join, and refuses that one: what has to be mended is the link
/// that spoils it.
#[test]
fn an_inertia_of_no_body_is_one_finding_whichever_link_it_is_merged_into() {
    let link = |name: &str, izz: &str| {
        format!(
            r#"<link name="{name}"><inertial><mass value="1"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="{izz}"/></inertial></link>"#
        )
    };
    let fixed = |name: &str, parent: &str, child: &str| {
        format!(
            r#"<joint name="{name}" type="fixed"><parent link="{parent}"/><child link="{child}"/></joint>"#
        )
    };
    let text = format!(
        r#"<robot name="r"><link name="base_footprint"/>{}{}{}{}</robot>"#,
        link("base_link", "0.001"),
        fixed("f", "base_footprint", "base_link"),
        link("plate", "0.1"),
        fixed("g", "base_link", "plate"),
    );
    let (_folder, file) = written(&text);
    let urdf = linted(&file, &LintSettings::default()).report.urdds.remove(0);
    let found: Vec<_> = urdf.findings.iter().map(|one| (one.code.as_str(), &one.subject)).collect();
    // Two programs refuse the robot, so that it is an error, and SRC005 is named by it.
    assert_eq!(found, [("LNT060", &Some("link `plate`".to_owned()))]);
    let places = urdf.findings[0].places.iter().flat_map(|place| &place.related);
    let named: Vec<_> = places.filter_map(|one| one.message.as_deref()).collect();
    assert!(named.iter().any(|said| said.starts_with("SRC005 ")), "{named:?}");
    let refuses = |name| urdf.findings[0].programs.iter().any(|one| one.program == name);
    assert!(refuses("sdformat") && refuses("mujoco"), "{:?}", urdf.findings[0].programs);
}

/// The line about programs in the report for people, for a robot of links with masses and what is given.
fn line(inside: &str, links: &[&str], programs: &[&str]) -> String {
    let link = |name: &&str| {
        format!(
            r#"<link name="{name}"><inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>"#
        )
    };
    let links: String = links.iter().map(link).collect();
    let (_folder, file) = written(&format!(r#"<robot name="arm">{links}{inside}</robot>"#));
    let mut settings = LintSettings::default();
    settings.report.programs = programs.iter().map(|name| (*name).to_owned()).collect();
    let mut text = String::new();
    let style = urdd_findings::report::style::Style::default();
    urdd_findings::report::human::write(&linted(&file, &settings).report, style, &mut text)
        .unwrap();
    text.lines().find(|line| line.contains(" · ")).unwrap().trim().to_owned()
}

fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], inside: &str) -> String {
    let limit = r#"<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="9" velocity="1"/>"#;
    format!(
        r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{limit}{inside}</joint>"#
    )
}

#[test]
fn the_line_names_what_is_lost_and_the_versions_of_gazebo() {
    let mimic = r#"<mimic joint="open"/>"#;
    let joints = [
        joint("open", "prismatic", ["base", "left"], ""),
        joint("close", "prismatic", ["base", "right"], mimic),
    ];
    let said = line(&joints.concat(), &["base", "left", "right"], &["gazebo"]);
    let expected = "Gazebo Harmonic and Jetty load it · ";
    assert!(said.contains(expected), "{said}");
    let expected = "Gazebo Fortress loads it without the mimic of `close` · ";
    assert!(said.starts_with(expected), "{said}");
    let said = line(&joints.concat(), &["base", "left", "right"], &["harmonic"]);
    assert!(said.starts_with("Gazebo Harmonic loads it · "), "{said}");
    // Fixed joints are merged; more than three are counted.
    let names = ["a", "b", "c", "d", "e"];
    let fixed = names.map(|name| joint(&format!("to_{name}"), "fixed", ["base", name], ""));
    let said = line(&fixed.concat(), &["base", "a", "b", "c", "d", "e"], &["gazebo"]);
    let expected = "Gazebo loads it without the joints `to_a`, `to_b`, `to_c` and 2 more · ";
    assert!(said.starts_with(expected), "{said}");
    // MuJoCo reads the range of a joint, and no limit of its velocity.
    let turns = joint("turn", "revolute", ["base", "left"], "");
    let said = line(&turns, &["base", "left"], &["mujoco"]);
    assert!(said.starts_with("MuJoCo loads it without "), "{said}");
    assert!(said.contains("the velocity limit of `turn` · "), "{said}");
    // A name is escaped, and a fixed joint may not have that of its link in later ones.
    let bad = joint("base", "fixed", ["base", "\u{9b}31m"], "");
    let said = line(&bad, &["base", "\u{9b}31m"], &["gazebo"]);
    assert!(said.contains("Gazebo Harmonic and Jetty refuse it (LNT015 at "), "{said}");
    assert!(!said.contains('\u{9b}'), "{said}");
}

/// A robot of one link that a joint moves, with what is in it, in a folder with a mesh `box.obj`: a package's folder `arm`.
fn moved(inside: &str) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("arm");
    fs::create_dir(&package).unwrap();
    fs::write(package.join("package.xml"), "<package><name>arm</name></package>").unwrap();
    let corners = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"].map(|corner| format!("v {corner}\n"));
    let mesh = corners.concat() + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    fs::write(package.join("box.obj"), mesh).unwrap();
    let turn = joint("turn", "revolute", ["base", "tip"], "");
    let base = r#"<inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>"#;
    let file = package.join("arm.urdf");
    let text = format!(
        r#"<robot name="arm"><link name="base">{base}</link><link name="tip">{inside}</link>{turn}</robot>"#
    );
    fs::write(&file, text).unwrap();
    (folder, file)
}

/// The same with an inertia that no body has, behind a collision with a mesh of this name.
fn impossible(mesh: &str) -> (tempfile::TempDir, std::path::PathBuf) {
    let inertial = r#"<inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="9"/></inertial>"#;
    let (folder, file) = moved(inertial);
    let shape = format!(r#"<collision><geometry><mesh filename="{mesh}"/></geometry></collision>"#);
    let text = fs::read_to_string(&file).unwrap();
    let base = r#"izz="0.1"/></inertial>"#;
    fs::write(&file, text.replacen(base, &format!("{base}{shape}"), 1)).unwrap();
    (folder, file)
}

#[test]
fn a_mesh_that_a_program_does_not_take_hides_no_other_fault_from_it() {
    let found = |mesh: &str| {
        let (_folder, file) = impossible(mesh);
        let urdf = linted(&file, &LintSettings::default()).report.urdds.remove(0);
        let finding = urdf.findings.into_iter().find(|one| one.message.contains("inertia"));
        let finding = finding.unwrap();
        let does: Vec<String> = finding.programs.iter().map(|one| one.program.clone()).collect();
        (finding.code, finding.severity, does)
    };
    let there = found("box.obj");
    assert_eq!(there.1, Severity::Error);
    assert!(there.2.contains(&"mujoco".to_owned()), "{:?}", there.2);
    // A package, another package, a file that is not there, a format that nobody reads.
    for mesh in ["package://arm/box.obj", "package://none/box.obj", "none.obj", "box.step"] {
        assert_eq!(found(mesh), there, "{mesh}");
    }
}

#[test]
fn what_a_program_refuses_first_is_why_and_the_next_is_what_it_would_refuse_then() {
    let (_folder, file) = impossible("package://arm/box.obj");
    let mut settings = LintSettings::default();
    settings.report.programs = vec!["mujoco".to_owned()];
    let run = linted(&file, &settings);
    let mut text = String::new();
    let style = Style { width: 500, ..Style::default() };
    human::write(&run.report, style, &mut text).unwrap();
    let line = text.lines().find(|line| line.trim().starts_with("MuJoCo refuses")).unwrap();
    assert!(line.contains("refuses it (MuJoCo takes `scheme://` as a folder"), "{line}");
    assert!(line.contains("; with that mended, LNT060 at 1:"), "{line}");
    let mujoco = run.report.urdds[0].programs.iter().find(|one| one.program == "mujoco").unwrap();
    let refusals = mujoco.effects.iter().filter(|one| one.does == Deed::Refuses);
    let mut supposed: Vec<bool> = refusals.map(|one| one.is_supposed).collect();
    supposed.sort_unstable();
    assert_eq!(supposed, [false, true]);
}

#[test]
fn a_mesh_of_a_format_that_few_programs_read_is_a_finding() {
    for name in ["part.step", "part.FBX", "part.ply", "part.wrl", "part.3ds", "part"] {
        let shape = format!(r#"<geometry><mesh filename="{name}"/></geometry>"#);
        let (folder, file) = moved(&format!(
            r#"<inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial><visual>{shape}</visual><collision>{shape}</collision>"#
        ));
        fs::write(folder.path().join("arm").join(name), "ISO-10303-21;").unwrap();
        let findings = linted(&file, &LintSettings::default()).report.urdds.remove(0).findings;
        let error = findings.iter().find(|one| one.severity == Severity::Error);
        let error = error.unwrap_or_else(|| panic!("{name}: {findings:#?}"));
        assert!(error.message.contains("export it as STL, OBJ or COLLADA"), "{}", error.message);
        for program in ["mujoco", "drake", "pybullet"] {
            let mut does = findings.iter().flat_map(|finding| &finding.programs);
            assert!(does.any(|one| one.program == program), "{name} {program}");
        }
    }
}

/// Tried in Drake 1.51.1, PyBullet 3.2.7 and Pinocchio 4.1.0.
#[test]
fn a_package_that_is_not_here_is_refused_by_those_that_need_it() {
    let geometry = r#"<geometry><mesh filename="package://none/box.obj"/></geometry>"#;
    let inertial = r#"<inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>"#;
    let refusing = |settings: &LintSettings| {
        let (_folder, file) = moved(&format!("{inertial}<visual>{geometry}</visual>"));
        let urdf = linted(&file, settings).report.urdds.remove(0);
        assert!(urdf.findings.iter().all(|one| one.severity != Severity::Error));
        let programs = urdf.programs.into_iter().filter(|one| one.does == Some(Deed::Refuses));
        programs.map(|one| one.program).collect::<Vec<_>>()
    };
    assert_eq!(refusing(&LintSettings::default()), ["pinocchio", "drake", "pybullet"]);
    let without = LintSettings { without_meshes: true, ..LintSettings::default() };
    assert_eq!(refusing(&without), [""; 0]);
}

/// Drake says: loop joints are not supported in MultibodyPlant.
#[test]
fn a_refusal_is_never_usual() {
    let closing = r#"<loop_joint name="l" type="continuous"><link1 link="tip"/><link2 link="base"/></loop_joint>"#;
    let inside = [joint("turn", "revolute", ["base", "tip"], ""), closing.to_owned()].concat();
    let said = line(&inside, &["base", "tip"], &["drake"]);
    assert!(said.starts_with("Drake refuses it (`<loop_joint>` is not supported at 1:"), "{said}");
}
