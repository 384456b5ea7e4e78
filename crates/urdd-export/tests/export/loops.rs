//! Kinematic loops and couplings: what a format holds is read back by our own readers.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, Point3, Translation3, Vector3};
use tempfile::TempDir;
use urdd_export::{Choices, Export, Format};
use urdd_format::loops::{LoopKind, LoopsModule};
use urdd_generate::{Selection, Settings, generate};
use urdd_kinematics::loops::Gap;
use urdd_kinematics::pose::to_isometry;
use urdd_kinematics::rotation::{from_rpy, to_rpy};
use urdd_robot::Robot;

use crate::made::export;

/// A tool on a hinge, and a part that moves freely.
const URDF: &str = r#"<robot name="r"><link name="base"/><link name="tool"/><link name="part"/><link name="wheel"/><link name="gear"/>
<joint name="turn" type="continuous"><parent link="base"/><child link="tool"/><origin xyz="0.1 0 0.2" rpy="0.3 0 0.1"/><axis xyz="0 0.6 0.8"/></joint>
<joint name="free" type="floating"><parent link="base"/><child link="part"/><origin xyz="0.3 0.2 0.1" rpy="0.1 -0.2 0.3"/></joint>
<joint name="spin" type="continuous"><parent link="base"/><child link="wheel"/><axis xyz="0 0 1"/></joint>
<joint name="mesh" type="continuous"><parent link="tool"/><child link="gear"/><origin xyz="0 0.1 0"/><axis xyz="0 1 0"/></joint>
</robot>"#;

fn pose(xyz: [f64; 3], rpy: [f64; 3]) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(xyz), from_rpy(rpy))
}

fn frame_in_tool() -> Isometry3<f64> {
    pose([0.05, 0.02, 0.01], [0.2, 0.1, -0.4])
}

/// What a loop of a kind leaves open.
fn left_open(kind: LoopKind) -> Isometry3<f64> {
    match kind {
        LoopKind::Fixed => Isometry3::identity(),
        LoopKind::Revolute => pose([0.0; 3], [0.0, 0.0, 0.7]),
        LoopKind::Prismatic => pose([0.0, 0.0, 0.3], [0.0; 3]),
        LoopKind::Cylindrical => pose([0.0, 0.0, 0.3], [0.0, 0.0, 0.7]),
        LoopKind::Universal => pose([0.0; 3], [FRAC_PI_2, 0.0, 0.5]),
        LoopKind::Spherical => pose([0.0; 3], [0.4, 0.5, 0.6]),
        LoopKind::Planar => pose([0.2, -0.1, 0.0], [0.0, 0.0, 0.7]),
    }
}

/// A loop between tool and part that is closed where all joints are at 0, but for `off`.
fn loop_of(kind: LoopKind, off: Isometry3<f64>) -> String {
    let tool = pose([0.1, 0.0, 0.2], [0.3, 0.0, 0.1]);
    let part = pose([0.3, 0.2, 0.1], [0.1, -0.2, 0.3]);
    let in_part = part.inverse() * tool * frame_in_tool() * left_open(kind) * off;
    let table = |frame: Isometry3<f64>| {
        let rpy = to_rpy(frame.rotation.to_rotation_matrix().matrix());
        format!("{{ xyz = {:?}, rpy = {rpy:?} }}", frame.translation.vector.as_slice())
    };
    format!(
        "[[loop]]\nname = \"close\"\nkind = \"{}\"\nlink_a = \"tool\"\nframe_a = {}\nlink_b = \"part\"\nframe_b = {}\n",
        kind.as_str(),
        table(frame_in_tool()),
        table(in_part)
    )
}

fn settings() -> Settings {
    let selection = Selection::parse(["core"]).expect("a selection");
    Settings { selection, ..Settings::default() }
}

pub(super) fn made_of(urdf: &str, toml: &str) -> (TempDir, Robot) {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("r.urdf"), urdf).expect("a URDF");
    std::fs::write(folder.path().join("r.loops.toml"), toml).expect("loops");
    // Shapes are needed for exports of most formats.
    let path = folder.path().join("r");
    generate(&folder.path().join("r.urdf"), &path, &Settings::default(), &()).expect("a URDD");
    let robot = Robot::open(&path).expect("a robot");
    (folder, robot)
}

pub(super) fn exported(robot: &Robot, format: Format, choices: Choices) -> Export {
    let file = if format == Format::Sdf { "r.sdf" } else { "r.urdf" };
    let output = Some(file.into());
    export(robot, format, &Choices { output, ..choices }).expect("an export")
}

/// The robot of an export.
pub(super) fn again(made: &Export, file: &str) -> (TempDir, Robot) {
    let folder = TempDir::new().expect("a folder");
    for (path, bytes) in &made.files {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        std::fs::write(path, bytes).expect("written");
    }
    let source = folder.path().join(file);
    std::fs::write(&source, &made.text).expect("written");
    let path = folder.path().join("again");
    let generated = generate(&source, &path, &settings(), &());
    generated.unwrap_or_else(|error| panic!("{error}: {}", made.text));
    let robot = Robot::open(&path).expect("a robot");
    (folder, robot)
}

pub(super) fn module(robot: &Robot) -> LoopsModule {
    robot.loops().expect("readable").cloned().unwrap_or_else(|| panic!("no loops"))
}

pub(super) fn notes(made: &Export) -> String {
    made.notes.iter().map(|note| format!("{note}\n")).collect()
}

/// The two frames of a loop, as points and axes of the robot at zero.
fn frames(robot: &Robot, number: usize) -> (LoopKind, [String; 2], [Isometry3<f64>; 2]) {
    let module = module(robot);
    let names = robot.link_names().expect("names");
    let zero = vec![0.0; robot.dof_names().expect("DOFs").len()];
    let poses = robot.link_poses(&zero).expect("poses");
    let of = &module.loops[number];
    let ends = [(of.link_a_idx, &of.frame_a), (of.link_b_idx, &of.frame_b)];
    let placed = ends.map(|(link, frame)| poses[link.get()] * to_isometry(frame).expect("a pose"));
    (of.kind, ends.map(|(link, _)| names[link.get()].clone()), placed)
}

/// Two frames are the same for a loop of a kind: it would hold one in the other, in every direction that it has.
fn assert_same(kind: LoopKind, one: &Isometry3<f64>, other: &Isometry3<f64>) {
    let kind = match kind {
        // Each end of a universal joint has a centre and an axis.
        LoopKind::Universal => LoopKind::Revolute,
        kind => kind,
    };
    let gap = Gap::of(kind, &one.inv_mul(other));
    assert!(gap.position < 1e-12 && gap.rotation < 1e-12, "{kind:?}: {gap:?} {one} {other}");
}

#[test]
fn urdf_plus_holds_every_kind() {
    for kind in LoopKind::ALL {
        let (_folder, robot) = made_of(URDF, &loop_of(*kind, Isometry3::identity()));
        let made = exported(&robot, Format::UrdfPlus, Choices::default());
        assert!(!notes(&made).contains("left out"), "{}", notes(&made));
        let (_again, same) = again(&made, "r.urdf");
        let (before, after) = (module(&robot), module(&same));
        assert_eq!(after.independent_dof_idxs, before.independent_dof_idxs, "{kind:?}");
        assert_eq!(after.loops[0].name, "close");
        let (was, is) = (frames(&robot, 0), frames(&same, 0));
        assert_eq!((is.0, &is.1), (was.0, &was.1));
        for (one, other) in was.2.iter().zip(&is.2) {
            assert_same(LoopKind::Fixed, one, other);
        }
    }
}

#[test]
fn urdf_plus_says_what_moves_freely_and_linear_couplings() {
    let coupling = |name: &str, constant: f64, terms: &str| {
        format!("[[coupling]]\nname = \"{name}\"\nconstant = {constant:?}\nterms = {{ {terms} }}\n")
    };
    let held = coupling("gears", 0.0, "turn = [1.0], spin = [-4.0]");
    let toml = |more: &str| format!("independent = [\"turn\", \"mesh\"]\n{held}{more}");
    let (_folder, robot) = made_of(URDF, &toml(""));
    let made = exported(&robot, Format::UrdfPlus, Choices::default());
    let words = "<joint name=\"spin\" type=\"continuous\" independent=\"false\">";
    assert!(made.text.contains(words), "{}", made.text);
    let (_again, same) = again(&made, "r.urdf");
    let (before, after) = (module(&robot), module(&same));
    assert_eq!(after.independent_dof_idxs, before.independent_dof_idxs);
    let [was, is] = [&before, &after].map(|module| &module.couplings[0]);
    let of = |coupling: &urdd_format::loops::Coupling| {
        let terms = &coupling.terms;
        (terms[0].dof_idx, terms[1].dof_idx, terms[0].coefficients[0] / terms[1].coefficients[0])
    };
    assert_eq!((of(is), &is.name), (of(was), &was.name));
    // What is not of two sides by a ratio is said to be left out.
    for (terms, constant) in [
        ("turn = [1.0], spin = [-4.0]", 0.5),
        ("turn = [1.0, 1.0], spin = [-4.0]", 0.0),
        // One is on the way to the other, by another factor.
        ("turn = [1.0], mesh = [-4.0]", 0.0),
    ] {
        let (_folder, robot) = made_of(URDF, &coupling("odd", constant, terms));
        let made = exported(&robot, Format::UrdfPlus, Choices::default());
        assert!(notes(&made).contains("coupling `odd` is left out"), "{terms}: {}", notes(&made));
        assert!(!made.text.contains("<coupling"), "{}", made.text);
    }
    // Along one chain by one factor, it is.
    let (_folder, robot) = made_of(URDF, &coupling("chain", 0.0, "turn = [2.0], mesh = [2.0]"));
    let made = exported(&robot, Format::UrdfPlus, Choices::default());
    let (_again, same) = again(&made, "r.urdf");
    let module = module(&same);
    let terms = &module.couplings[0].terms;
    assert_eq!(terms.len(), 2);
    assert_eq!(terms[0].coefficients, terms[1].coefficients);
}

#[test]
fn extended_urdf_holds_welds_balls_and_hinges_as_two_balls() {
    for kind in LoopKind::ALL {
        let (_folder, robot) = made_of(URDF, &loop_of(*kind, Isometry3::identity()));
        let made = exported(&robot, Format::ExtendedUrdf, Choices::default());
        let read_as = match kind {
            LoopKind::Fixed => &[LoopKind::Fixed][..],
            LoopKind::Spherical => &[LoopKind::Spherical],
            LoopKind::Revolute => &[LoopKind::Spherical; 2],
            _ => {
                assert!(notes(&made).contains("loop `close` is left out"), "{}", notes(&made));
                assert!(!made.text.contains("close_A"), "{}", made.text);
                continue;
            }
        };
        let (_again, same) = again(&made, "r.urdf");
        let after = module(&same);
        let kinds: Vec<LoopKind> = after.loops.iter().map(|of| of.kind).collect();
        assert_eq!(kinds, read_as, "{kind:?}");
        let (_, _, was) = frames(&robot, 0);
        for (number, kind) in kinds.into_iter().enumerate() {
            let (_, names, is) = frames(&same, number);
            assert!(names[0].starts_with("close_A") && names[1].starts_with("close_B"));
            for (one, other) in was.iter().zip(&is) {
                let along = Translation3::new(0.0, 0.0, 0.1 * number as f64);
                assert_same(kind, &(one * along), other);
            }
        }
    }
}

#[test]
fn extended_urdf_names_motors_and_balls() {
    let urdf = URDF.replace("type=\"floating\"", "type=\"spherical\"");
    let toml = format!(
        "independent = [\"turn\", \"mesh\", \"spin\"]\n{}",
        loop_of(LoopKind::Spherical, Isometry3::identity())
    );
    let (_folder, robot) = made_of(&urdf, &toml);
    let made = exported(&robot, Format::ExtendedUrdf, Choices::default());
    assert!(!made.text.contains("spherical") && !made.text.contains("independent"));
    let yaml = made.files.iter().find(|(path, _)| path == "r.yaml").expect("a YAML");
    let yaml = String::from_utf8_lossy(&yaml.1);
    assert!(yaml.contains("joint_name: [\"free\"]\njoint_type: [\"SPHERICAL\"]\n"), "{yaml}");
    let free = module(&robot).independent_dof_idxs;
    let dofs = robot.dof_names().expect("names");
    let mut motors: Vec<&str> =
        free.iter().filter_map(|dof| dofs[dof.get()].split('/').next()).collect();
    motors.dedup();
    assert!((1..4).contains(&motors.len()), "{motors:?}");
    let listed: Vec<String> = motors.iter().map(|name| format!("{name:?}")).collect();
    let listed = format!("name_mot: [{}]\n", listed.join(", "));
    assert!(yaml.contains(&listed), "{listed} {yaml}");
    let (_again, same) = again(&made, "r.urdf");
    assert_eq!(same.dof_names().expect("names"), robot.dof_names().expect("names"));
    assert_eq!(module(&same).independent_dof_idxs, module(&robot).independent_dof_idxs);
}

#[test]
fn sdf_holds_what_is_closed_at_zero() {
    for kind in LoopKind::ALL {
        let (_folder, robot) = made_of(URDF, &loop_of(*kind, Isometry3::identity()));
        let made = exported(&robot, Format::Sdf, Choices::default());
        if [LoopKind::Cylindrical, LoopKind::Planar].contains(kind) {
            assert!(notes(&made).contains("loop `close` is left out"), "{}", notes(&made));
            continue;
        }
        assert!(notes(&made).contains("Drake refuses the file"), "{}", notes(&made));
        let (_again, same) = again(&made, "r.sdf");
        let (was, is) = (frames(&robot, 0), frames(&same, 0));
        assert_eq!((is.0, &is.1), (was.0, &was.1), "{}", made.text);
        for (one, other) in was.2.iter().zip(&is.2) {
            assert_same(*kind, one, other);
        }
    }
}

#[test]
fn a_loop_of_an_sdf_that_is_open_at_zero_is_left_out() {
    for (kind, off, text) in [
        (LoopKind::Spherical, pose([0.0, 0.0, 0.002], [0.0; 3]), "up to 0.002 m and 0 rad apart"),
        (LoopKind::Revolute, pose([0.0; 3], [0.01, 0.0, 0.0]), "up to 0 m and 0.01 rad apart"),
    ] {
        let (_folder, robot) = made_of(URDF, &loop_of(kind, off));
        let made = exported(&robot, Format::Sdf, Choices::default());
        assert!(notes(&made).contains(text), "{}", notes(&made));
        assert!(!made.text.contains("name=\"close\""));
    }
    // What moves freely in it does not open it.
    let (_folder, robot) =
        made_of(URDF, &loop_of(LoopKind::Prismatic, pose([0.0, 0.0, 0.002], [0.0; 3])));
    let made = exported(&robot, Format::Sdf, Choices::default());
    assert!(made.text.contains("<joint name=\"close\" type=\"prismatic\">"));
}

/// The child of a joint is never the root, which floats here.
#[test]
fn the_root_is_the_parent_of_a_loop() {
    let toml = "[[loop]]\nname = \"close\"\nkind = \"Universal\"\nlink_a = \"tool\"\nframe_a = { xyz = [0.0, 0.0, 0.0] }\n\
        link_b = \"base\"\nframe_b = { xyz = [0.1, 0.0, 0.2], rpy = [1.8707963267948966, 0.0, 0.1] }\n";
    let (_folder, robot) = made_of(URDF, toml);
    let made = exported(&robot, Format::Sdf, Choices { floating_base: true, ..Choices::default() });
    assert!(made.text.contains("<child>tool</child>"), "{}", made.text);
    let (_again, same) = again(&made, "r.sdf");
    let (was, is) = (frames(&robot, 0), frames(&same, 0));
    assert_eq!(is.1, ["base", "tool"]);
    assert_same(is.0, &was.2[0], &is.2[1]);
    assert_same(is.0, &was.2[1], &is.2[0]);
}

/// With another root, the frames of links are elsewhere, and loops where they were.
#[test]
fn loops_stay_where_they_are_in_another_tree() {
    let urdf = URDF.replace("</robot>", r#"<link name="tip"/>
        <joint name="on" type="fixed"><parent link="tool"/><child link="tip"/><origin xyz="0 0 0.4" rpy="1 0 0"/></joint></robot>"#);
    let tip = pose([0.1, 0.0, 0.2], [0.3, 0.0, 0.1]) * pose([0.0, 0.0, 0.4], [0.0; 3]);
    let two = format!("xyz = {:?}", tip.translation.vector.as_slice());
    let toml = loop_of(LoopKind::Fixed, Isometry3::identity())
        + &"[[loop]]\nname = \"two\"\nkind = \"Spherical\"\nlink_a = \"tip\"\nframe_a = { xyz = [0.0, 0.0, 0.0] }\n\
        link_b = \"base\"\nframe_b = { TWO }\n[[loop]]\nname = \"one\"\nkind = \"Fixed\"\n\
        link_a = \"tool\"\nframe_a = { xyz = [0.0, 0.0, 0.4], rpy = [1.0, 0.0, 0.0] }\nlink_b = \"tip\"\nframe_b = { xyz = [0.0, 0.0, 0.0] }\n".replace("TWO", &two);
    let (_folder, robot) = made_of(&urdf, &toml);
    let choices = || Choices { root: Some("tool".into()), merge_fixed: true, ..Choices::default() };
    for (format, file) in [(Format::UrdfPlus, "r.urdf"), (Format::Mjcf, "r.xml")] {
        let made = exported(&robot, format, choices());
        let said = notes(&made);
        assert!(said.contains("loop `one` is left out: its two links are one body"), "{said}");
        let (_again, same) = again(&made, file);
        for number in [0, 1] {
            let ((_, _, was), (_, names, is)) = (frames(&robot, number), frames(&same, number));
            assert!(!names.contains(&"tip".to_owned()), "{names:?}");
            let (was, is) = (was[0].inv_mul(&was[1]), is[0].inv_mul(&is[1]));
            assert_same(LoopKind::Fixed, &was, &is);
        }
    }
}

/// A URDF+ source's own elements are about frames that are elsewhere then.
#[test]
fn elements_of_urdf_plus_are_not_copied_where_they_are_wrong() {
    let plus = r#"<loop name="l" type="spherical"><predecessor link="tool"/><successor link="part">
        <origin xyz="-0.24 -0.16 0.14"/></successor></loop></robot>"#;
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("p.urdf"), URDF.replace("</robot>", plus)).expect("a URDF");
    let path = folder.path().join("p");
    generate(&folder.path().join("p.urdf"), &path, &Settings::default(), &()).expect("a URDD");
    let robot = Robot::open(&path).expect("a robot");
    let count = |format: Format, choices: Choices| {
        exported(&robot, format, choices).text.matches("<loop ").count()
    };
    assert_eq!(count(Format::Urdf, Choices::default()), 1);
    assert_eq!(count(Format::UrdfPlus, Choices::default()), 1);
    assert_eq!(count(Format::ExtendedUrdf, Choices::default()), 0);
    let turned = || Choices { root: Some("tool".into()), ..Choices::default() };
    assert_eq!(count(Format::Urdf, turned()), 0);
    assert_eq!(count(Format::UrdfPlus, turned()), 1);
}

/// A coupling of two joints is a mimic.
#[test]
fn couplings_are_mimics_where_a_format_has_no_others() {
    let toml = "independent = [\"spin\"]\n[[coupling]]\nname = \"ab\"\nconstant = 0.5\nterms = { turn = [2.0], spin = [-1.0] }\n\
        [[coupling]]\nname = \"bc\"\nconstant = 0.0\nterms = { turn = [1.0], mesh = [4.0] }\n";
    let copy = r#"<link name="copy"/><joint name="copies" type="continuous"><parent link="base"/><child link="copy"/>
        <axis xyz="0 0 1"/><mimic joint="mesh" multiplier="3" offset="1"/></joint></robot>"#;
    let (_folder, robot) = made_of(&URDF.replace("</robot>", copy), toml);
    // turn = (spin - 0.5) / 2, mesh = - turn / 4 = - spin / 8 + 0.0625
    let drake = exported(&robot, Format::Drake, Choices::default()).text;
    for words in [
        "<mimic joint=\"spin\" multiplier=\"0.5\" offset=\"-0.25\"/>",
        "<mimic joint=\"spin\" multiplier=\"-0.125\" offset=\"0.0625\"/>",
        "<mimic joint=\"spin\" multiplier=\"-0.375\" offset=\"1.1875\"/>",
    ] {
        assert!(drake.contains(words), "{words}: {drake}");
    }
    let sdf = exported(&robot, Format::Sdf, Choices::default()).text;
    assert!(
        sdf.contains("<sdf version=\"1.11\"") && sdf.contains("<mimic joint=\"spin\">"),
        "{sdf}"
    );
    assert!(sdf.contains("<multiplier>-0.125</multiplier>"), "{sdf}");
    // Of three joints, none is.
    let toml = "[[coupling]]\nname = \"three\"\nconstant = 0.0\nterms = { turn = [2.0], spin = [-1.0], mesh = [1.0] }\n";
    let (_folder, robot) = made_of(URDF, toml);
    for format in [Format::Drake, Format::Sdf] {
        let made = exported(&robot, format, Choices::default());
        assert!(notes(&made).contains("coupling `three` is left out"), "{}", notes(&made));
    }
}

/// Values in an XML or a USD, each after a word.
fn values(text: &str, word: &str) -> Vec<[f64; 3]> {
    let numbers = |rest: &str| {
        let end = rest.find(['"', ')', '<']).expect("an end");
        let words = rest[..end].split([' ', ',']).filter(|word| !word.is_empty());
        words.map(|word| word.parse().expect("a number")).collect::<Vec<f64>>()
    };
    text.split(word).skip(1).map(|rest| numbers(rest).try_into().expect("three")).collect()
}

/// A ball is one ball constraint, a hinge two and a weld three: their points meet where the loop is closed, and no others do.
#[test]
fn drake_holds_balls_hinges_and_welds_by_points() {
    let ends = [pose([0.1, 0.0, 0.2], [0.3, 0.0, 0.1]), pose([0.3, 0.2, 0.1], [0.1, -0.2, 0.3])];
    for kind in LoopKind::ALL {
        let (_folder, robot) = made_of(URDF, &loop_of(*kind, Isometry3::identity()));
        let made = exported(&robot, Format::Drake, Choices::default());
        let points = ["p_AP value=\"", "p_BQ value=\""]
            .map(|word| values(&made.text, &format!("drake:ball_constraint_{word}")));
        let number = match kind {
            LoopKind::Spherical => 1,
            LoopKind::Revolute => 2,
            LoopKind::Fixed => 3,
            _ => 0,
        };
        assert_eq!((points[0].len(), points[1].len()), (number, number), "{kind:?}");
        let is_said = notes(&made).contains("loop `close` is left out");
        assert_eq!(is_said, number == 0, "{}", notes(&made));
        let placed = |end: usize| -> Vec<Point3<f64>> {
            points[end].iter().map(|point| ends[end] * Point3::from(*point)).collect()
        };
        let (in_a, in_b) = (placed(0), placed(1));
        for (a, b) in in_a.iter().zip(&in_b) {
            assert!((a - b).norm() < 1e-12, "{kind:?}: {a} {b}");
        }
        // The points of a hinge are on its axis, and those of a weld not on a line.
        let axis = ends[0] * frame_in_tool() * Vector3::z();
        match in_a[..] {
            [one, other] => assert!((other - one).cross(&axis).norm() < 1e-12),
            [one, other, third] => assert!((other - one).cross(&(third - one)).norm() > 1e-3),
            _ => {}
        }
    }
}

#[test]
fn drake_finds_no_world_in_a_model() {
    let urdf = URDF.replace("\"base\"", "\"world\"");
    let toml = "[[loop]]\nname = \"close\"\nkind = \"Spherical\"\nlink_a = \"tool\"\nframe_a = { xyz = [0.0, 0.0, 0.0] }\n\
        link_b = \"world\"\nframe_b = { xyz = [0.1, 0.0, 0.2] }\n";
    let (_folder, robot) = made_of(&urdf, toml);
    let made = exported(&robot, Format::Drake, Choices::default());
    assert!(notes(&made).contains("find no `world`"), "{}", notes(&made));
    assert!(!made.text.contains("ball_constraint"));
    // An SDF has it, as a parent alone.
    let made = exported(&robot, Format::Sdf, Choices::default());
    assert!(made.text.contains("<joint name=\"close\" type=\"ball\">"), "{}", made.text);
    assert!(!made.text.contains("<child>world</child>"));
}

#[test]
fn usd_has_joints_that_are_not_of_the_articulation() {
    let types = [
        (LoopKind::Fixed, "PhysicsFixedJoint", ""),
        (LoopKind::Revolute, "PhysicsRevoluteJoint", "physics:axis = \"Z\""),
        (LoopKind::Prismatic, "PhysicsPrismaticJoint", "physics:axis = \"Z\""),
        (LoopKind::Spherical, "PhysicsSphericalJoint", ""),
        (LoopKind::Cylindrical, "PhysicsJoint", "transZ rotZ"),
        (LoopKind::Planar, "PhysicsJoint", "transX transY rotZ"),
    ];
    for (kind, word, more) in types {
        let (_folder, robot) = made_of(URDF, &loop_of(kind, Isometry3::identity()));
        let made = exported(&robot, Format::Usd, Choices::default());
        let (_, prim) = made.text.split_once(&format!("def {word} \"close\"")).expect("a prim");
        let prim = &prim[..prim.find("\n        }").expect("its end")];
        assert!(prim.contains("bool physics:excludeFromArticulation = 1"), "{prim}");
        let of = &module(&robot).loops[0];
        for (place, frame) in [&of.frame_a, &of.frame_b].into_iter().enumerate() {
            let [found] = values(prim, &format!("physics:localPos{place} = ("))[..] else {
                panic!("{prim}")
            };
            let apart = Vector3::from(found) - Vector3::from(frame.position);
            assert!(apart.norm() < 1e-7, "{found:?} {:?}", frame.position);
        }
        if word != "PhysicsJoint" {
            assert!(prim.contains(more), "{prim}");
            continue;
        }
        for axis in ["transX", "transY", "transZ", "rotX", "rotY", "rotZ"] {
            let low = format!("limit:{axis}:physics:low = ");
            let is_free = prim.contains(&format!("{low}-inf"));
            assert_eq!(is_free, more.contains(axis), "{axis}: {prim}");
            assert!(is_free || prim.contains(&format!("{low}1")), "{axis}: {prim}");
        }
    }
    let (_folder, robot) = made_of(URDF, &loop_of(LoopKind::Universal, Isometry3::identity()));
    let made = exported(&robot, Format::Usd, Choices::default());
    assert!(notes(&made).contains("loop `close` is left out"), "{}", notes(&made));
}

/// Bodies of a USD are where the loops are closed, which zero is not.
#[test]
fn bodies_of_a_usd_are_in_the_closed_configuration() {
    let off = pose([0.0, 0.0, 0.05], [0.0; 3]);
    let (_folder, robot) = made_of(URDF, &loop_of(LoopKind::Spherical, off));
    let made = exported(&robot, Format::Usd, Choices::default());
    assert!(notes(&made).contains("reference configuration, in which loops are closed"));
    let reference = &module(&robot).reference_configuration;
    let poses = robot.link_poses(reference).expect("poses");
    let names = robot.link_names().expect("names");
    let part = names.iter().position(|name| name == "part").expect("a link");
    let zero = robot.link_poses(&vec![0.0; reference.len()]).expect("poses");
    assert!((poses[part].translation.vector - zero[part].translation.vector).norm() > 0.01);
    let (_, prim) = made.text.split_once("\"part\"").expect("a prim");
    let found = values(prim, "xformOp:translate = (")[0];
    let apart = Vector3::from(found) - poses[part].translation.vector;
    assert!(apart.xy().norm() < 1e-6, "{found:?} {}", poses[part]);
}
