//! What ros2_control and gz_ros2_control do. The parser's verdicts are recorded in `tests/figures/programs/control`; what the
//! resource managers do with its hardware follows their sources, which the cases name.

use std::fs;

use urdd_programs::{Deed, Effects, File, Mesh, Program};
use urdd_xml::{Counted, Kind};

use crate::table;

const HUMBLE: Program = Program::Control2;
const JAZZY: Program = Program::Control4;
const GAZEBO: Program = Program::GazeboControl;

fn read(program: Program, text: &str) -> Effects {
    let counted = Counted::new(text.as_bytes(), Kind::Robot).unwrap();
    program.read(&File::new(counted, &|_| Mesh::Missing))
}

/// What a program does: each deed, the text that it points at, and what is lost.
fn does(program: Program, text: &str) -> Vec<(Deed, &str, String)> {
    let effects = read(program, text).into_kept().into_iter();
    let at = |at: usize| text[at..].split('>').next().unwrap_or_default();
    effects.map(|effect| (effect.deed, at(effect.at), effect.part.to_string())).collect()
}

fn refuses(text: &str) -> Vec<(Deed, &str, String)> {
    vec![(Deed::Refuses, text, String::new())]
}

fn drops<'t>(text: &'t str, part: &str) -> (Deed, &'t str, String) {
    (Deed::Drops, text, part.to_owned())
}

fn base() -> String {
    fs::read_to_string(table::folder().join("control/base.urdf")).unwrap()
}

/// The base, changed.
fn changed(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(base(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    })
}

#[test]
fn the_parser_refuses_what_those_of_humble_and_jazzy_refuse() {
    let cases = fs::read_to_string(table::folder().join("control/cases.txt")).unwrap();
    let mut wrong = Vec::new();
    for case in cases.lines().filter(|line| !line.starts_with('#')) {
        let [verdicts, old, new] = case.split('\t').collect::<Vec<_>>()[..] else {
            panic!("{case}")
        };
        let text = changed(&[(old, new)]);
        for (program, verdict) in [HUMBLE, JAZZY].into_iter().zip(verdicts.chars()) {
            let effects = read(program, &text);
            if effects.loads() != (verdict == '+') {
                wrong.push(format!("{} {case}: {:?}", program.id(), effects.kept()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn a_robot_without_ros2_control_is_not_for_it() {
    let is_for = |program: Program, text: &str| {
        let counted = Counted::new(text.as_bytes(), Kind::Robot).unwrap();
        program.is_for(&File::new(counted, &|_| Mesh::Missing))
    };
    let without = changed(&[("ros2_control", "ros1_control")]);
    for (program, expected) in [(HUMBLE, true), (JAZZY, true), (GAZEBO, false)] {
        assert_eq!(is_for(program, &base()), expected, "{}", program.id());
        assert!(!is_for(program, &without) && !is_for(program, "<robot"), "{}", program.id());
    }
    assert!(is_for(GAZEBO, &changed(&[("maker/Arm", "gz_ros2_control/GazeboSimSystem")])));
    assert!(is_for(GAZEBO, &changed(&[("</robot>", &format!("{SYSTEM}</robot>"))])));
}

/// `ResourceManager::load_urdf` of 2.54.0 and `load_and_initialize_components` of 4.46.0.
#[test]
fn the_managers_load_hardware_of_three_types_by_its_plugin() {
    let both = |changes: &[(&str, &str)]| {
        let text = changed(changes);
        let [humble, jazzy] = [HUMBLE, JAZZY].map(|program| does(program, &text));
        assert_eq!(humble, jazzy, "{changes:?}");
        jazzy.into_iter().map(|(deed, at, part)| (deed, at.to_owned(), part)).collect::<Vec<_>>()
    };
    let is = |changes: &[(&str, &str)], expected: &[(Deed, &str, String)]| {
        let expected =
            expected.iter().map(|(deed, at, part)| (*deed, (*at).to_owned(), part.clone()));
        assert_eq!(both(changes), expected.collect::<Vec<_>>(), "{changes:?}");
    };
    is(&[], &[]);
    is(
        &[(
            "name=\"arm\" type=\"system\" rw_rate=\"100\" is_async=\"true\" thread_priority=\"40\"",
            "name=\"arm\" type=\"System\"",
        )],
        &refuses("type=\"System\""),
    );
    let hardware = "<hardware>\n      <plugin>maker/Arm</plugin>\n      <param name=\"port\">/dev/arm</param>\n    </hardware>";
    let start = "ros2_control name=\"arm\" type=\"system\" rw_rate=\"100\" is_async=\"true\" thread_priority=\"40\"";
    is(&[(hardware, "")], &refuses(&format!("<{start}")));
    is(&[("<plugin>maker/Arm</plugin>", "<plugin/>")], &refuses("<plugin/"));
    // Nothing that is written is missing of hardware without interfaces.
    let other = |inside: &str| {
        format!(
            "<ros2_control {inside}<hardware><plugin>a/B</plugin></hardware></ros2_control></robot>"
        )
    };
    let silent = other("name=\"other\" type=\"systems\">");
    is(&[("</robot>", &silent)], &[drops("type=\"systems\"", "hardware/other")]);
    let named = other("type=\"system\" name=\"arm\">");
    is(&[("</robot>", &named)], &refuses("name=\"arm\""));
    // A sensor gives no commands: the first of them is missing.
    is(
        &[("type=\"system\" rw", "type=\"sensor\" rw")],
        &refuses("<command_interface name=\"position\""),
    );
    let joint = |name: &str, interfaces: &str| {
        format!(
            "<ros2_control name=\"other\" type=\"system\"><hardware><plugin>a/B</plugin></hardware><joint name=\"{name}\">{interfaces}</joint></ros2_control></robot>"
        )
    };
    // The same joint, with other interfaces, and with the same.
    is(&[("</robot>", &joint("elbow", "<state_interface name=\"effort\"/>"))], &[]);
    is(
        &[(
            "</robot>",
            &joint(
                "elbow",
                "<command_interface name=\"velocity\" /><state_interface name=\"velocity\" />",
            ),
        )],
        &[
            drops("<command_interface name=\"velocity\" /", "command_interface/elbow"),
            drops("<state_interface name=\"velocity\" /", "state_interface/elbow"),
        ],
    );
    is(
        &[("</robot>", "<gazebo><ros2_control name=\"stray\"/></gazebo></robot>")],
        &[drops("<ros2_control name=\"stray\"/", "hardware/stray")],
    );
}

#[test]
fn numbers_are_read_where_they_are_used() {
    let initial = [(
        "<state_interface name=\"position\"/>",
        "<state_interface name=\"position\"><param name=\"initial_value\">0.0.1</param></state_interface>",
    )];
    let mock = [initial[0], ("maker/Arm", "mock_components/GenericSystem")];
    // Other hardware may take it.
    assert_eq!(does(JAZZY, &changed(&initial)), []);
    for program in [HUMBLE, JAZZY] {
        assert_eq!(does(program, &changed(&mock)), refuses("<param name=\"initial_value\""));
    }
    let limit = [("<param name=\"min\">-1", "<param name=\"min\">-2.87\"")];
    assert_eq!(does(HUMBLE, &changed(&limit)), []);
    let expected = [drops("<param name=\"min\"", "command_interface/shoulder/limit")];
    assert_eq!(does(JAZZY, &changed(&limit)), expected);
    let disabled = [
        limit[0],
        ("<joint name=\"shoulder\">\n", "<joint name=\"shoulder\"><limits enable=\"false\"/>\n"),
    ];
    assert_eq!(does(JAZZY, &changed(&disabled)), []);
    let reduction = [("<mechanical_reduction>50", "<mechanical_reduction>1:50")];
    for program in [HUMBLE, JAZZY] {
        let effects = read(program, &changed(&reduction)).into_kept();
        let made = effects.iter().map(|effect| (effect.deed, effect.makes.as_deref()));
        assert_eq!(made.collect::<Vec<_>>(), [(Deed::Reads, Some("1"))]);
    }
}

/// `on_init` of `GenericSystem` in 2.54.0; 4.46.0 has what the parser makes of `<mimic>`.
#[test]
fn a_parameter_mimic_is_for_humble() {
    let follows = |leader: &str| {
        let param =
            format!("<joint name=\"elbow\" mimic=\"false\"><param name=\"mimic\">{leader}</param>");
        changed(&[
            ("maker/Arm", "mock_components/GenericSystem"),
            ("<joint name=\"elbow\" mimic=\"false\">", &param),
        ])
    };
    assert_eq!(does(HUMBLE, &follows("shoulder")), []);
    assert_eq!(does(HUMBLE, &follows("mount")), refuses("<param name=\"mimic\""));
    let expected = [drops("<param name=\"mimic\"", "joint/elbow/mimic")];
    assert_eq!(does(JAZZY, &follows("shoulder")), expected);
    // Other hardware may read it, and a joint of the robot may have both.
    let other = follows("shoulder").replace("mock_components/GenericSystem", "maker/Arm");
    assert_eq!(does(JAZZY, &other), []);
    let close = "<joint name=\"close\" mimic=\"true\">";
    let param = format!("{close}<param name=\"mimic\">open</param>");
    let text = changed(&[("maker/Arm", "mock_components/GenericSystem"), (close, &param)]);
    assert_eq!(does(JAZZY, &text), []);
}

#[test]
fn damaged_files_are_read_without_a_panic() {
    let system = format!("{SYSTEM}</robot>");
    let text = changed(&[("maker/Arm", "gz_ros2_control/GazeboSimSystem"), ("</robot>", &system)]);
    for start in (0..text.len()).step_by(17) {
        for length in [1, 9, 200, text.len()] {
            let mut damaged = text.clone();
            damaged.replace_range(start..text.len().min(start + length), "");
            for program in [HUMBLE, JAZZY, GAZEBO] {
                let Ok(counted) = Counted::new(damaged.as_bytes(), Kind::Robot) else { continue };
                let effects = program.read(&File::new(counted, &|_| Mesh::Missing));
                assert!(effects.kept().iter().all(|effect| effect.at <= damaged.len()));
            }
        }
    }
}

#[test]
fn humble_keeps_white_space() {
    let plugin = [("maker/Arm", "\n maker/Arm\n")];
    assert_eq!(does(HUMBLE, &changed(&plugin)), refuses("<plugin"));
    assert_eq!(does(JAZZY, &changed(&plugin)), []);
    let kind = [("type=\"system\" rw", "type=\"system \" rw")];
    assert_eq!(
        does(HUMBLE, &changed(&kind)),
        refuses("type=\"system \" rw_rate=\"100\" is_async=\"true\" thread_priority=\"40\"")
    );
    assert_eq!(does(JAZZY, &changed(&kind)), []);
}

const SYSTEM: &str = "<gazebo><plugin filename=\"gz_ros2_control-system\" name=\"gz_ros2_control::GazeboSimROS2ControlPlugin\"><parameters>a.yaml</parameters></plugin></gazebo>";

/// `Configure`, `GZResourceManager` and `initSim` of gz_ros2_control 1.2.7.
#[test]
fn gazebo_asks_for_its_plugins_and_joints() {
    let system = format!("{SYSTEM}</robot>");
    let gazebo = |changes: &[(&str, &str)]| {
        let own = [("maker/Arm", "gz_ros2_control/GazeboSimSystem"), ("</robot>", &*system)];
        changes.iter().fold(changed(&own), |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replace(old, new)
        })
    };
    let is = |changes: &[(&str, &str)], expected: &[(Deed, &str, String)]| {
        assert_eq!(does(GAZEBO, &gazebo(changes)), expected, "{changes:?}");
    };
    is(&[], &[]);
    is(&[("filename=\"gz", "filename=\"/opt/libign"), ("-system\"", "-system.so\"")], &[]);
    is(&[(SYSTEM, "")], &refuses("<plugin"));
    let name = "name=\"gz_ros2_control::GazeboSimROS2ControlPlugin\"";
    is(&[(name, "name=\"ign_ros2_control::IgnitionROS2ControlPlugin\"")], &[]);
    is(&[(name, "name=\"gz_ros2_control\"")], &refuses("name=\"gz_ros2_control\""));
    is(&[("<parameters>a.yaml</parameters>", "<parameters/>")], &refuses("<parameters/"));
    is(
        &[("<parameters>a.yaml</parameters>", "")],
        &refuses(
            "<plugin filename=\"gz_ros2_control-system\" name=\"gz_ros2_control::GazeboSimROS2ControlPlugin\"",
        ),
    );
    // Other hardware is left out, which is usual: the robot may be a mock.
    let mock = gazebo(&[("gz_ros2_control/GazeboSimSystem", "mock_components/GenericSystem")]);
    assert_eq!(does(GAZEBO, &mock), [drops("<plugin", "hardware/arm")]);
    assert_eq!(read(GAZEBO, &mock).worst_unusual(), None);
    is(&[("gz_ros2_control/GazeboSimSystem", "maker/InGazebo")], &[]);
    is(
        &[("<command_interface name=\"velocity\">", "<command_interface name=\"current\">")],
        &[drops("<command_interface name=\"current\"", "command_interface/elbow")],
    );
    is(
        &[(
            "<state_interface name=\"position\"/>",
            "<state_interface name=\"position\"><param name=\"initial_value\">zero</param></state_interface>",
        )],
        &refuses("<param name=\"initial_value\""),
    );
    // Gazebo has no joint of a link without a mass.
    let massless = r#"<link name="right"><inertial><mass value="0"/>"#;
    is(
        &[(r#"<link name="right"><inertial><mass value="1"/>"#, massless)],
        &[drops("<joint name=\"close\" mimic=\"true\"", "joint/close")],
    );
    let empty = format!(
        "<ros2_control name=\"e\" type=\"system\"><hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware></ros2_control>{system}"
    );
    is(&[("</robot>", &empty)], &refuses("<ros2_control name=\"e\" type=\"system\""));
    // The parser is that of Jazzy.
    is(&[("mimic=\"false\"", "mimic=\"true\"")], &refuses("mimic=\"true\""));
}
