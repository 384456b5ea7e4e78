//! What exports need and a URDD does not say: guesses, the file, and what is wrong in it.

use crate::made::export;
use crate::mjcf_actuators::name_configuration;
use urdd_export::{ActuatorKind, Choices, Format, Setup};
use urdd_robot::Robot;

use testkit::robots::{made, made_of, our_robots};
use testkit::urdfs::mobile;

/// Lines of a file without comments.
fn said(text: &str) -> Vec<&str> {
    let lines = text.lines().map(str::trim);
    lines.filter(|line| !line.is_empty() && !line.starts_with('#')).collect()
}

fn guessed(name: &str) -> (Robot, String) {
    let robots = our_robots();
    let (_, urdf) = robots.iter().find(|(found, _)| found == name).expect(name);
    let (folder, path) = made(urdf);
    let robot = Robot::open(path).expect("a robot");
    let text = Setup::guess(&robot).expect("guesses").to_toml(&robot).expect("text");
    drop(folder);
    (robot, text)
}

fn names(text: &str) -> Vec<&str> {
    let lines = said(text).into_iter();
    lines.filter_map(|line| line.strip_prefix("name = \"")?.strip_suffix('"')).collect()
}

/// What a person who looks at the robots sees.
#[test]
fn structure_says_what_a_robot_is() {
    let expected: [(&str, &[&str], bool); 6] = [
        ("six_axis_arm", &["arm"], false),
        ("hand", &["hand", "thumb", "index", "middle", "ring", "little"], false),
        (
            "quadruped",
            &["base", "front_left_leg", "front_right_leg", "rear_left_leg", "rear_right_leg"],
            true,
        ),
        ("gripper", &["hand"], false),
        ("welding_arm", &["arm"], false),
        ("single_link", &[], false),
    ];
    for (robot, groups, floats) in expected {
        let (_, text) = guessed(robot);
        assert_eq!(names(&text), groups, "{robot}");
        let floating = format!("floating = {floats}");
        assert!(said(&text).contains(&floating.as_str()), "{text}");
    }
    let (_, text) = guessed("six_axis_arm");
    assert!(said(&text).contains(&"tools = [\"tool0\"]"), "{text}");
    // Each guess has its reason.
    let reasons = text.lines().filter(|line| line.starts_with("# Guess: "));
    assert_eq!(reasons.count(), 4, "{text}");
}

#[test]
fn an_arm_on_wheels_with_a_gripper() {
    let (_folder, path) = made_of(&mobile());
    let robot = Robot::open(path).expect("a robot");
    let guess = Setup::guess(&robot).expect("guesses");
    let text = guess.to_toml(&robot).expect("text");
    let expected = [
        "robot = \"m\"",
        "[base]",
        "floating = true",
        "[[group]]",
        "name = \"wheels\"",
        "joints = [\"w1\", \"w2\"]",
        "[[group]]",
        "name = \"arm\"",
        "base = \"chassis\"",
        "tip = \"mount_link\"",
        "[[group]]",
        "name = \"hand\"",
        "joints = [\"f1\", \"f2\"]",
        "[[end_effector]]",
        "name = \"hand\"",
        "group = \"hand\"",
        "parent_group = \"arm\"",
        "parent_link = \"mount_link\"",
        "[frames]",
        "tools = [\"palm_link\"]",
        "imus = []",
        "[actuators]",
        "bandwidth = 10.0",
        "[limits]",
        "[contact]",
        "[curobo]",
    ];
    assert_eq!(said(&text), expected);
    // What is written is read, and means the same.
    let read = Setup::from_toml(&text, "m.export.toml", &robot).expect("read");
    assert_eq!(said(&read.to_toml(&robot).expect("text")), expected);
}

/// The tool frame of ROS-Industrial is before the hand that is mounted on it; a frame of the hand is before both.
#[test]
fn tool0_is_the_tool_of_an_arm_with_a_hand() {
    let tcp = "<link name=\"hand_tcp\"/><joint name=\"t\" type=\"fixed\"><parent link=\"palm_link\"/>\
        <child link=\"hand_tcp\"/></joint></robot>";
    let mounted = mobile().replace("mount_link", "tool0");
    let flange = mounted.replace("palm_link", "gripper_base").replace(
        "</robot>",
        "<link name=\"flange\"/><joint name=\"t\" type=\"fixed\"><parent link=\"tool0\"/>\
        <child link=\"flange\"/></joint></robot>",
    );
    for (urdf, tool) in [
        (mounted.clone(), "tools = [\"tool0\"]"),
        (flange, "tools = [\"tool0\"]"),
        (mounted.replace("</robot>", tcp), "tools = [\"hand_tcp\"]"),
    ] {
        let (_folder, path) = made_of(&urdf);
        let robot = Robot::open(path).expect("a robot");
        let text = Setup::guess(&robot).expect("guesses").to_toml(&robot).expect("text");
        assert!(said(&text).contains(&tool), "{text}");
    }
}

/// All that a person set is in the text again.
#[test]
fn what_a_person_set_is_written_again() {
    let (_folder, path) = made_of(&mobile());
    let robot = Robot::open(&path).expect("a robot");
    name_configuration(&robot, &path, "up", "j1");
    let robot = Robot::open(&path).expect("a robot");
    let guess = Setup::guess(&robot).expect("guesses").to_toml(&robot).expect("text");
    let mine = guess
        .replace(
            "bandwidth = 10.0\n",
            "bandwidth = 7.5\n[actuators.joint.\"j1\"]\nname = \"a\"\nkind = \"motor\"\nkp = 500.0\narmature = 0.1\nctrlrange = [-1.0, 2.0]\nforcerange = [-3.0, 4.0]\n",
        )
        .replace("# acceleration = 5.0", "acceleration = 3.0")
        .replace("# jerk = 100.0", "jerk = 30.0")
        .replace("# friction = 0.8", "friction = 0.6")
        .replace(
            "floating = true",
            "floating = true\nposes.\"up\" = [0.5, 0.0, 2.0, 0.0, 1.0, 0.0, 0.0]",
        )
        .replace("# ee_link = \"NAME\"", "ee_link = \"j4_link\"")
        .replace("# locked = { finger = 0.04 }", "locked = { \"f1\" = 0.01 }");
    let read = Setup::from_toml(&mine, "x", &robot).expect("read");
    assert_eq!(said(&read.to_toml(&robot).expect("text")), said(&mine));
    assert_eq!(said(&mine).len(), said(&guess).len() + 13);
}

/// The gains of a joint, as the text of a setup has them.
fn gains(text: &str, joint: &str) -> Vec<String> {
    let lines = said(text);
    let at = lines.iter().position(|line| *line == format!("[actuators.joint.\"{joint}\"]"));
    let after = at.map_or(&[][..], |at| &lines[at + 1..]);
    let own = after.iter().take_while(|line| !line.starts_with('['));
    own.map(|line| (*line).to_owned()).collect()
}

#[test]
fn a_pattern_stands_for_joints_and_what_says_more_counts() {
    let (_folder, path) = made_of(&mobile());
    let robot = Robot::open(path).expect("a robot");
    let read = |joints: &str| {
        let text = format!("robot = \"m\"\n[actuators.joint]\n{joints}");
        let setup = Setup::from_toml(&text, "x", &robot).expect("read");
        setup.to_toml(&robot).expect("text")
    };
    let text = read(
        "\"*\" = { kp = 1, kv = 2 }\n\"j*\" = { kp = 3 }\nj2 = { kp = 4, armature = 5 }\n\"*2\" = { kv = 6 }",
    );
    assert_eq!(gains(&text, "j1"), ["kp = 3.0", "kv = 2.0"]);
    assert_eq!(gains(&text, "j2"), ["kp = 4.0", "kv = 6.0", "armature = 5.0"]);
    assert_eq!(gains(&text, "w1"), ["kp = 1.0", "kv = 2.0"]);
    assert_eq!(gains(&text, "w2"), ["kp = 1.0", "kv = 6.0"]);
    // A fixed joint is passed over.
    assert_eq!(gains(&text, "mount"), Vec::<String>::new());
    let text = read("\"j1\" = { kp = 1 }\n\"*j*1*\" = { kp = 2, kv = 3 }");
    assert_eq!(gains(&text, "j1"), ["kp = 1.0", "kv = 3.0"]);
    assert_eq!(gains(&text, "j2"), Vec::<String>::new());
}

#[test]
fn what_is_wrong_in_the_file_is_said_with_its_place() {
    let (_folder, path) = made_of(&mobile());
    let robot = Robot::open(&path).expect("a robot");
    name_configuration(&robot, &path, "up", "j1");
    let robot = Robot::open(&path).expect("a robot");
    let group = |inner: &str| format!("robot = \"m\"\n[[group]]\nname = \"g\"\n{inner}\n");
    let cases = [
        ("robot = \"n\"", ":1:9: this file is for robot `n`, not for `m`"),
        ("robot = \"m\"\n[[group", ":2:"),
        ("robot = \"m\"\ngrup = 1", ":2:1: unknown field `grup`"),
        ("[base]\nfloating = true", "missing field `robot`"),
        (
            &group("base = \"chasis\"\ntip = \"j4_link\""),
            ":4:8: there is no link `chasis`; did you mean `chassis`?",
        ),
        (
            &group("base = \"j4_link\"\ntip = \"chassis\""),
            ":2:1: the link `j4_link` is not an ancestor of `chassis`",
        ),
        (&group("base = \"j4_link\"\ntip = \"palm_link\""), "no joint between them moves"),
        (&group("joints = [\"f3\"]"), ":4:11: there is no joint `f3`"),
        (&group("joints = [\"mount\"]"), ":4:11: the joint `mount` is fixed"),
        (&group("joints = []"), ":2:1: the group `g` needs `base` and `tip`"),
        (&group("joints = [\"f1\"]\ntip = \"chassis\""), "only one of these"),
        (&group("groups = [\"g\"]"), ":2:1: the group `g` contains itself"),
        (&group("groups = [\"h\"]"), ":4:11: there is no group `h`"),
        (
            &group("groups = [\"h\"]\n[[group]]\nname = \"h\"\ngroups = [\"g\"]"),
            ":2:1: the group `g` contains itself",
        ),
        (
            &group("joints = [\"f1\"]\n[[group]]\nname = \"g\"\njoints = [\"f2\"]"),
            ":6:8: another group is called `g`",
        ),
        (
            &group(
                "joints = [\"f1\"]\n[[end_effector]]\nname = \"e\"\ngroup = \"x\"\nparent_link = \"chassis\"",
            ),
            ":7:9: there is no group `x`",
        ),
        (
            "robot = \"m\"\n[actuators]\nbandwidth = 0.0",
            ":3:13: `bandwidth` must be from 0.01 to 1,000 Hz, not 0",
        ),
        (
            "robot = \"m\"\n[actuators]\nbandwidth = nan",
            "`bandwidth` must be from 0.01 to 1,000 Hz",
        ),
        (
            "robot = \"m\"\n[actuators]\nbandwidth = 1e300",
            "`bandwidth` must be from 0.01 to 1,000 Hz",
        ),
        ("robot = \"m\"\n[actuators.joint.j1]\nkp = -1.0", "`kp` is a number that is not below 0"),
        ("robot = \"m\"\n[actuators.joint.j1]\nki = 1.0", ":3:1: unknown field `ki`"),
        (
            "robot = \"m\"\n[actuators]\nkp = 1.0",
            ":3:1: unknown field `kp`, expected `bandwidth` or `joint`; gains are those of a joint: `[actuators.joint.NAME]`, or of all that a pattern stands for",
        ),
        (
            "robot = \"m\"\n[actuators.joint.\"x*\"]\nkp = 1.0",
            ":2:18: no joint that something drives is called as `x*`",
        ),
        (
            "robot = \"m\"\n[actuators.joint]\n\"j*\" = { kp = 1.0 }\n\"*1\" = { kp = 2.0 }",
            "say `kp` of one joint, and neither is longer",
        ),
        ("robot = \"m\"\n[base]\nposes.up = [0, 0, 1]", ":3:12: a pose is 7 numbers"),
        ("robot = \"m\"\n[base]\nposes.up = [0, 0, 1, 0, 0, 0, 0]", "a pose is 7 numbers"),
        ("robot = \"m\"\n[base]\nposes.up = [nan, 0, 1, 1, 0, 0, 0]", "a pose is 7 numbers"),
        (
            "robot = \"m\"\n[base]\nposes.x = [0, 0, 1, 1, 0, 0, 0]",
            ":3:7: there is no named configuration `x`",
        ),
        (
            "robot = \"m\"\n[actuators.joint.j1]\nctrlrange = [1.0, 1.0]",
            ":2:1: `ctrlrange` is two numbers, the first below the second",
        ),
        (
            "robot = \"m\"\n[actuators.joint.j1]\nforcerange = [0, inf]",
            "`forcerange` is two numbers",
        ),
        ("robot = \"m\"\n[actuators.joint.j1]\nkind = \"servo\"", "unknown variant `servo`"),
        ("robot = \"m\"\n[actuators.joint.j1]\nname = \"\"", "must not be empty"),
        (
            "robot = \"m\"\n[actuators.joint.j1]\nname = \"a\"\n[actuators.joint.j2]\nname = \"a\"",
            ":4:1: another actuator has the same `name`",
        ),
        (
            "robot = \"m\"\n[curobo]\nretract = \"home\"",
            ":3:11: there is no named configuration `home`",
        ),
        ("robot = \"m\"\n[curobo]\nlocked = { f1 = inf }", "`locked` is a position, rad or m"),
        ("robot = \"m\"\n[frames]\ntools = [\"\\u001b[2J\"]", ":3:10: "),
    ];
    for (text, expected) in cases {
        let error = Setup::from_toml(text, "m.export.toml", &robot).expect_err(text);
        let said = error.to_string();
        assert!(said.contains(expected), "{text}\n{said}");
        assert!(said.starts_with("m.export.toml:") && !said.contains('\u{1b}'), "{said}");
    }
    assert!(Setup::from_toml("robot = \"m\"", "x", &robot).is_ok());
}

/// Names of any kind are written so that TOML's reader has them back.
#[test]
fn hostile_names_are_read_as_they_were_written() {
    for name in [
        "\"\"\"",
        "a\nb",
        "\\",
        "\u{1b}[2J",
        "\u{202e}x",
        "'",
        "é 🤖",
        "[x]",
        "x = 1",
        "\u{10ffff}",
    ] {
        let urdf = mobile().replace("palm_link", "STAND").replace("\"m\"", "\"ROBOT\"");
        let (_folder, path) = made_of(&urdf);
        let robot = Robot::open(&path).expect("a robot");
        let text = Setup::guess(&robot).expect("guesses").to_toml(&robot).expect("text");
        assert!(text.contains("tools = [\"STAND\"]"));
        let json = serde_json::to_string(name).expect("JSON");
        let module = path.join("urdf_module/module.json");
        for file in [module, path.join("kinematics_module/module.json")] {
            if let Ok(document) = std::fs::read_to_string(&file) {
                std::fs::write(&file, document.replace("\"STAND\"", &json)).expect("written");
            }
        }
        let robot = Robot::open(&path).expect("a robot");
        let Ok(setup) = Setup::guess(&robot) else {
            continue;
        };
        let text = setup.to_toml(&robot).expect("text");
        let read = Setup::from_toml(&text, "x", &robot)
            .unwrap_or_else(|error| panic!("{name:?}: {error}\n{text}"));
        assert_eq!(
            read.to_toml(&robot)
                .expect("text")
                .lines()
                .filter(|l| !l.starts_with("# Guess"))
                .collect::<Vec<_>>(),
            text.lines().filter(|l| !l.starts_with("# Guess")).collect::<Vec<_>>()
        );
        assert!(text.contains("tools = ["), "{text}");
    }
}

/// Gains stay the person's in the library too, and the bandwidth that is asked for stands over the file's.
#[test]
fn options_stand_over_the_file() {
    let (_folder, path) = made_of(&mobile());
    let robot = Robot::open(path).expect("a robot");
    let text = "robot = \"m\"\n[actuators]\nbandwidth = 5.0";
    let setup = Setup::from_toml(text, "x", &robot).expect("read");
    let text = |bandwidth: Option<f64>| {
        let options = Choices {
            setup: Some(setup.clone()),
            actuators: Some(ActuatorKind::Position),
            bandwidth,
            ..Choices::default()
        };
        export(&robot, Format::Mjcf, &options).expect("an export").text
    };
    assert!(text(None).contains("a bandwidth of 5 Hz"));
    assert!(text(Some(20.0)).contains("a bandwidth of 20 Hz"));
}
