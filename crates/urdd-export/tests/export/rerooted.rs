//! `root`: another link is the root, and nothing else about the robot changes.

use nalgebra::Isometry3;
use urdd_export::{Choices, ExportError, Format, Setup};
use urdd_robot::RobotError;

use crate::kinematic_text::Text;
use crate::made::{export, robot, urdf};

/// From `a`: a hinge beside the origin of `b`, a slide to `c`, a bolt to `d`, a wheel on its axis to `e`; and branches.
fn parts() -> String {
    let mass = |mass: f64| {
        format!(
            "<inertial><origin xyz=\"0.1 0.2 0.3\" rpy=\"0.3 0 1\"/><mass value=\"{mass}\"/><inertia ixx=\"0.02\" ixy=\"0.001\" ixz=\"0\" iyy=\"0.03\" iyz=\"0.002\" izz=\"0.04\"/></inertial>"
        )
    };
    let links = ["a", "b", "c", "d", "e", "x", "y"].iter().zip(1..).map(|(name, number)| {
        format!(
            "<link name=\"{name}\">{}<collision><origin xyz=\"0 0.1 0\" rpy=\"0 0 0.5\"/><geometry><box size=\"0.1 0.2 0.3\"/></geometry></collision></link>",
            mass(f64::from(number))
        )
    });
    let joint = |name: &str, kind: &str, [parent, child]: [&str; 2], origin: &str, rest: &str| {
        format!(
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/><origin {origin}/>{rest}</joint>"
        )
    };
    let limit = "<limit lower=\"-0.5\" upper=\"1.5\" effort=\"5\" velocity=\"1\"/>";
    links.collect::<String>()
        + &joint(
            "hinge",
            "revolute",
            ["a", "b"],
            "xyz=\"0.1 0.2 0.3\" rpy=\"0.3 -0.2 0.5\"",
            &format!("<axis xyz=\"0 0.6 0.8\"/>{limit}"),
        )
        + &joint(
            "slide",
            "prismatic",
            ["b", "c"],
            "xyz=\"0 0.4 0\" rpy=\"0 1 0\"",
            &format!(
                "<axis xyz=\"1 0 2\"/>{limit}<mimic joint=\"hinge\" multiplier=\"-0.5\" offset=\"0.25\"/>"
            ),
        )
        + &joint("bolt", "fixed", ["c", "d"], "xyz=\"0.2 0 0\" rpy=\"1 0 0\"", "")
        + &joint(
            "wheel",
            "continuous",
            ["d", "e"],
            "xyz=\"0 0 0.5\" rpy=\"0 0 0.7\"",
            "<axis xyz=\"0 0 1\"/>",
        )
        + &joint(
            "side",
            "revolute",
            ["a", "x"],
            "xyz=\"0 0 1\"",
            &format!("<axis xyz=\"1 0 0\"/>{limit}"),
        )
        + &joint(
            "end",
            "revolute",
            ["b", "y"],
            "xyz=\"0 1 0\" rpy=\"0 0 1\"",
            &format!("<axis xyz=\"0 1 0\"/>{limit}"),
        )
}

fn rooted(root: &str) -> Choices {
    Choices { root: Some(root.to_owned()), ..Choices::default() }
}

/// The values of joints, without pattern.
fn value(joint: &str, seed: u32) -> f64 {
    let own = joint.bytes().fold(seed + 1, |sum, byte| sum * 31 % 1009 + u32::from(byte));
    f64::from(own % 1000) / 400.0 - 1.0
}

#[test]
fn links_are_where_they_were_relative_to_each_other_whichever_is_the_root() {
    let source = urdf(&parts());
    let (_folder, robot) = robot(&source);
    let before = Text::new(&source);
    // Hinges beside the origin of their parent move its frame; slides, bolts and the wheel do not.
    let roots = [("b", "a"), ("c", "a"), ("d", "a"), ("e", "a"), ("x", "a"), ("y", "ab")];
    for (root, moved) in roots {
        let made = export(&robot, Format::Urdf, &rooted(root)).expect("an export");
        let after = Text::new(&made.text);
        let frames =
            after.all("link").filter_map(|link| link.attribute("name")?.strip_suffix("_frame"));
        let frames: Vec<&str> = frames.collect();
        assert_eq!(frames.concat(), moved, "{root}");
        for seed in 0..4 {
            let value = |joint: &str| value(joint, seed);
            let (old, new) = (before.poses(&value), after.poses(&value));
            assert!(
                (new[root].to_homogeneous() - Isometry3::<f64>::identity().to_homogeneous()).amax()
                    == 0.0
            );
            let frame = |link: &str| {
                let moved = new.get(&format!("{link}_frame"));
                moved.copied().unwrap_or(new[link])
            };
            for (link, pose) in &old {
                let there = (old[root].inverse() * pose).to_homogeneous();
                let here = (frame(root).inverse() * frame(link)).to_homogeneous();
                assert!((there - here).amax() < 1e-12, "{root} {link}");
            }
            let there = before.weight("c", &value);
            let here = after.weight(if frames.contains(&"c") { "c_frame" } else { "c" }, &value);
            assert!((there.0 - here.0).abs() < 1e-9 && (there.1 - here.1).amax() < 1e-9, "{root}");
            assert!((there.2 - here.2).amax() < 1e-9, "{root}");
        }
        let notes = made.notes.iter().map(ToString::to_string);
        assert_eq!(notes.filter(|note| note.contains("_frame`")).count(), frames.len());
    }
}

#[test]
fn joints_keep_their_limits_and_what_follows_them() {
    let (_folder, robot) = robot(&urdf(&parts()));
    let made = export(&robot, Format::Urdf, &rooted("e")).expect("an export");
    let text = Text::new(&made.text);
    let ends = |joint: &str| [text.of_joint(joint, "parent"), text.of_joint(joint, "child")];
    assert_eq!(ends("wheel"), ["e", "d"]);
    assert_eq!(ends("bolt"), ["d", "c"]);
    assert_eq!(ends("slide"), ["c", "b"]);
    assert_eq!(ends("hinge"), ["b", "a"]);
    assert_eq!(ends("side"), ["a", "x"]);
    let of = |joint: &str, tag: &str, key: &str| {
        let node = text.named("joint", joint).children().find(|it| it.has_tag_name(tag));
        node.and_then(|node| node.attribute(key)).map(str::to_owned)
    };
    for joint in ["hinge", "slide", "side"] {
        assert_eq!(of(joint, "limit", "lower").as_deref(), Some("-0.5"), "{joint}");
        assert_eq!(of(joint, "limit", "upper").as_deref(), Some("1.5"), "{joint}");
    }
    assert_eq!(of("slide", "mimic", "multiplier").as_deref(), Some("-0.5"));
    // The wheel's axis is that of before, turned round.
    assert_eq!(of("wheel", "axis", "xyz").as_deref(), Some("0 0 -1"));
}

#[test]
fn every_format_has_the_new_root() {
    let (_folder, robot) = robot(&urdf(&parts()));
    let made = |format| export(&robot, format, &rooted("d")).expect("an export").text;
    let mjcf = made(Format::Mjcf);
    let first = mjcf.split("<body name=\"").nth(1).expect("a body");
    assert!(first.starts_with("d\""), "{first}");
    assert!(mjcf.contains("<site name=\"a_frame\""), "{mjcf}");
    assert!(made(Format::Sdf).contains("<child>d</child>"));
    assert!(made(Format::Sdf).contains("<frame name=\"a_frame\" attached_to=\"a\">"));
    assert!(made(Format::Drake).contains("<frame name=\"a_frame\" link=\"a\""));
    assert!(
        made(Format::Moveit).contains("<link name=\"a_frame\"/>")
            || !made(Format::Moveit).is_empty()
    );
    assert!(made(Format::Usd).contains("def Xform \"a_frame\""));
    // Pairs do not depend on the root.
    let pairs = |choices: &Choices| {
        let text = export(&robot, Format::Srdf, choices).expect("an export").text;
        text.lines().filter(|line| line.contains("<disable")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(pairs(&rooted("e")), pairs(&Choices::default()));
}

#[test]
fn what_cannot_be_turned_round_is_refused() {
    let text = |kind: &str| {
        urdf(&format!(
            "<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\
<joint name=\"j\" type=\"{kind}\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/></joint>\
<joint name=\"k\" type=\"fixed\"><parent link=\"a\"/><child link=\"c\"/></joint>"
        ))
    };
    for kind in ["floating", "planar", "spherical"] {
        let (_folder, robot) = robot(&text(kind));
        let refused = export(&robot, Format::Urdf, &rooted("b"));
        let message = refused.expect_err("a refusal");
        assert!(matches!(&message, ExportError::Root { joint, .. } if joint == "j"), "{message}");
        // A link that is not beyond it can be the root.
        export(&robot, Format::Urdf, &rooted("c")).expect("an export");
    }
    let (_folder, robot) = robot(&text("continuous"));
    let unknown = export(&robot, Format::Urdf, &rooted("bb")).expect_err("no such link");
    assert!(
        matches!(unknown, ExportError::Robot(RobotError::Unknown { what: "link", .. })),
        "{unknown}"
    );
    // MuJoCo's own body is the root or nothing.
    let world = text("continuous").replace("\"a\"", "\"world\"");
    let (_folder, robot) = crate::made::robot(&world);
    let refused = export(&robot, Format::Mjcf, &rooted("b")).expect_err("a refusal");
    assert!(matches!(refused, ExportError::Name { .. }), "{refused}");
}

/// Names of what is invented are new, and tools are where they were.
#[test]
fn tools_are_at_the_frames_of_the_source() {
    let taken = "<link name=\"a_frame\"/><joint name=\"t\" type=\"fixed\"><parent link=\"c\"/><child link=\"a_frame\"/></joint>";
    let (_folder, robot) = robot(&urdf(&(parts() + taken)));
    let setup = "robot = \"r\"\n[frames]\ntools = [\"a\"]\nimus = []\n[[group]]\nname = \"g\"\nbase = \"a\"\ntip = \"d\"";
    let setup = Some(Setup::from_toml(setup, "x", &robot).expect("a setup"));
    let choices = Choices { setup, ..rooted("d") };
    let mjcf = export(&robot, Format::Mjcf, &choices).expect("an export").text;
    assert!(mjcf.contains("<site name=\"a_frame_2\""), "{mjcf}");
    assert!(!mjcf.contains("<site name=\"a\""), "{mjcf}");
    // A chain that now runs the other way is a group of its joints.
    let moveit = export(&robot, Format::Moveit, &choices).expect("an export");
    let notes: Vec<String> = moveit.notes.iter().map(ToString::to_string).collect();
    assert!(notes.iter().any(|note| note.starts_with("group `g`")), "{notes:?}");
}
