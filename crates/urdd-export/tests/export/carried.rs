//! The table of docs/export.md is the program's, and what it says is so: a robot that has everything goes through every
//! format.

use crate::made::export;
use urdd_export::{Choices, Format, carried_table};
use urdd_robot::Robot;

use testkit::page::assert_between;
use testkit::robots::made_of;

const MARKS: [&str; 2] = ["<!-- table: what each format carries -->\n", "<!-- end of table -->"];

#[test]
fn the_page_has_the_table() {
    let how = "cargo test --workspace --test export carried";
    assert_between("docs/export.md", MARKS, &carried_table(), how);
}

const URDF: &str = r#"<robot name="r"><link name="base"><inertial><mass value="2.5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual><geometry><box size="0.2 0.2 0.2"/></geometry><material name="m"><color rgba="0.125 0.25 0.5 1"/></material></visual></link>
<link name="arm"><visual><geometry><box size="0.3 0.1 0.1"/></geometry><material name="t"><texture filename="t.png"/></material></visual></link>
<link name="tip"><visual><geometry><box size="0.3 0.1 0.1"/></geometry></visual></link><link name="plane"/><link name="ball"/><link name="free"/>
<joint name="j" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
<limit lower="-0.75" upper="1" effort="7.25" velocity="3.25" acceleration="9.125" jerk="33"/><dynamics damping="0.375" friction="0.625"/>
<safety_controller soft_lower_limit="-0.7" soft_upper_limit="0.9" k_position="15" k_velocity="10"/></joint>
<joint name="k" type="revolute"><parent link="arm"/><child link="tip"/><origin xyz="0.2 0 0"/><axis xyz="0 0 1"/>
<limit lower="-2" upper="2" effort="1" velocity="1"/><mimic joint="j" multiplier="1.875"/></joint>
<joint name="p" type="planar"><parent link="tip"/><child link="plane"/><axis xyz="0 0 1"/></joint>
<joint name="s" type="spherical"><parent link="plane"/><child link="ball"/></joint>
<joint name="f" type="floating"><parent link="ball"/><child link="free"/></joint>
<gazebo reference="base"><gravity>false</gravity></gazebo><ros2_control name="c" type="system"/><gear_train/></robot>"#;

/// What a format writes of each thing; nothing where it does not carry it.
const PROBES: [(&str, &[&str; 12]); 10] = [
    // SRDF, URDF, Drake, MJCF, cuRobo, Foam, spherized, MoveIt's URDF, SDF, USD, URDF+, Extended URDF.
    (
        "masses and inertias",
        &[
            "",
            "mass value=\"2.5\"",
            "mass value=\"2.5\"",
            "mass=\"2.5\"",
            "",
            "",
            "mass value=\"2.5\"",
            "mass value=\"2.5\"",
            "<mass>2.5</mass>",
            "physics:mass = 2.5",
            "mass value=\"2.5\"",
            "mass value=\"2.5\"",
        ],
    ),
    (
        "colours of visual geometry",
        &[
            "",
            "0.125 0.25 0.5 1",
            "0.125 0.25 0.5 1",
            "0.125 0.25 0.5 1",
            "",
            "",
            "0.125 0.25 0.5 1",
            "0.125 0.25 0.5 1",
            "0.125 0.25 0.5 1",
            // sRGB's curve of each.
            "inputs:diffuseColor = (0.0143",
            "0.125 0.25 0.5 1",
            "0.125 0.25 0.5 1",
        ],
    ),
    (
        "limits of position",
        &[
            "",
            "lower=\"-0.75\"",
            "lower=\"-0.75\"",
            "range=\"-0.75 1\"",
            "",
            "",
            "lower=\"-0.75\"",
            "lower=\"-0.75\"",
            "<lower>-0.75</lower>",
            "lowerLimit = -42.971",
            "lower=\"-0.75\"",
            "lower=\"-0.75\"",
        ],
    ),
    (
        "limits of effort and velocity",
        &[
            "",
            "7.25",
            "7.25",
            "7.25",
            "",
            "",
            "7.25",
            "7.25",
            "7.25",
            "velocityLimit = 186.2",
            "7.25",
            "7.25",
        ],
    ),
    (
        "limits of acceleration and jerk",
        &["", "9.125", "9.125", "", "", "", "9.125", "9.125", "", "", "9.125", "9.125"],
    ),
    (
        "damping and friction of joints",
        &[
            "",
            "0.375",
            "0.375",
            "0.375",
            "",
            "",
            "0.375",
            "0.375",
            "0.375",
            "newton:friction = 0.625",
            "0.375",
            "0.375",
        ],
    ),
    (
        "mimic joints",
        &[
            "",
            "1.875",
            "1.875",
            "1.875",
            "",
            "",
            "1.875",
            "1.875",
            "1.875",
            "mimicCoef1 = 1.875",
            "1.875",
            "1.875",
        ],
    ),
    (
        "`<gazebo>` elements",
        &[
            "",
            "<gazebo",
            "<gazebo",
            "",
            "",
            "",
            "<gazebo",
            "<gazebo",
            "<gravity>false",
            "<gazebo",
            "<gazebo",
            "<gazebo",
        ],
    ),
    (
        "hardware of ros2_control",
        &[
            "",
            "<ros2_control name=\"c",
            "<ros2_control name=\"c",
            "",
            "",
            "",
            "<ros2_control name=\"c",
            "<ros2_control name=\"mock_hardware",
            "",
            "<ros2_control",
            "<ros2_control name=\"c",
            "<ros2_control name=\"c",
        ],
    ),
    (
        "other elements that URDF does not define, such as transmissions",
        &["", "<gear", "<gear", "", "", "", "<gear", "<gear", "", "<gear", "<gear", "<gear"],
    ),
];

#[test]
fn what_the_table_says_is_so() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(&path).expect("a robot");
    let options = Choices { samples: 100, ..Choices::default() };
    let table = carried_table();
    for (place, format) in Format::ALL.iter().enumerate() {
        let made = export(&robot, *format, &options).expect("an export");
        let mut text = made.text.clone();
        for (path, bytes) in &made.files {
            if path.ends_with(".urdf") || path.ends_with(".yaml") {
                text += &String::from_utf8_lossy(bytes);
            }
        }
        let text: String = text
            .lines()
            .filter(|line| !line.starts_with("<!--") && !line.starts_with('#'))
            .collect();
        let report: serde_json::Value = serde_json::from_str(&made.report).expect("JSON");
        for (name, probes) in PROBES {
            let row =
                table.lines().find(|line| line.starts_with(&format!("| {name} |"))).expect(name);
            let cell = row.split('|').nth(place + 2).expect("a cell").trim();
            let list = match cell {
                "yes" => "carried",
                "**lost**" => "lost",
                "–" => "",
                _ => "otherwise",
            };
            for key in ["carried", "otherwise", "lost"] {
                let mut entries = report[key].as_array().expect("a list").iter();
                assert_eq!(
                    entries.any(|entry| entry["what"] == name),
                    key == list,
                    "{format:?} {name}"
                );
            }
            match probes[place] {
                "" => assert!(
                    ["**lost**", "–"].contains(&cell) || *format == Format::Curobo,
                    "{format:?} {name}"
                ),
                probe => {
                    assert!(text.contains(probe), "{format:?} {name}");
                    assert!(!["**lost**", "–"].contains(&cell), "{format:?} {name}");
                }
            }
        }
        // People are told what is lost.
        let lost = report["lost"].as_array().expect("a list");
        let said =
            made.notes.iter().any(|note| note.to_string().contains("left out, since the format"));
        assert_eq!(said, !lost.is_empty(), "{format:?}");
    }
}

/// MoveIt's package has other hardware, and all else that URDF does not define.
#[test]
fn moveit_replaces_hardware_alone() {
    let without = URDF.replace("<ros2_control name=\"c\" type=\"system\"/>", "");
    assert_ne!(without, URDF);
    for (urdf, replaced) in [(URDF, 1), (without.as_str(), 0)] {
        let (_folder, path) = made_of(urdf);
        let robot = Robot::open(&path).expect("a robot");
        let made = export(&robot, Format::Moveit, &Choices::default()).expect("an export");
        let report: serde_json::Value = serde_json::from_str(&made.report).expect("JSON");
        let count = |key: &str, name: &str| {
            let mut entries = report[key].as_array().expect("a list").iter();
            let entry = entries.find(|entry| entry["what"] == name);
            entry.map_or(0, |entry| entry["count"].as_u64().expect("a number"))
        };
        assert_eq!(count("otherwise", "hardware of ros2_control"), replaced, "{report}");
        let others = "other elements that URDF does not define, such as transmissions";
        assert_eq!(count("carried", others), 1, "{report}");
    }
}

/// Fewer triangles for simulators, with the deviation said; no option, no change.
#[test]
fn visuals_can_have_fewer_triangles() {
    let robots = testkit::robots::our_robots();
    let (_, urdf) = robots.iter().find(|(name, _)| name == "welding_arm").expect("a robot");
    let (_folder, path) = testkit::robots::made(urdf);
    let robot = Robot::open(path).expect("a robot");
    let of = |detail| {
        let options = Choices { visuals: detail, ..Choices::default() };
        export(&robot, Format::Urdf, &options).expect("an export")
    };
    let full = of(urdd_export::Detail::Full);
    let few = of(urdd_export::Detail::Ratio(0.5));
    let bytes = |made: &urdd_export::Export| -> usize {
        let visuals = made.files.iter().filter(|(path, _)| path.ends_with(".obj"));
        visuals.map(|(_, bytes)| bytes.len()).sum()
    };
    assert!(bytes(&few) < bytes(&full) * 2 / 3, "{} {}", bytes(&few), bytes(&full));
    let said = few
        .notes
        .iter()
        .map(ToString::to_string)
        .find(|note| note.starts_with("visual geometry has"));
    assert!(said.expect("a note").contains("deviates from the original by at most"));
    let colours = |made: &urdd_export::Export| made.text.matches("<color").count();
    assert_eq!(colours(&few), colours(&full));
}
