//! `merge_fixed`: links that are fixed to each other are one body, and frames on it.

use urdd_export::{Choices, Export, ExportError, Format, Setup, Shapes};
use urdd_xml::{Kind, Node, parse};

use crate::kinematic_text::{Text, inertial};
use crate::made::{export, robot, urdf};
use urdd_robot::{Robot, ShapeKind};

const LIMIT: &str = "<limit lower=\"-2\" upper=\"2\" effort=\"5\" velocity=\"1\"/>";

/// A base with a plate fixed to it, on which an arm turns; on the arm a camera, and on that a finger that slides.
fn parts() -> String {
    let mass = |mass: f64, xyz: &str, [x, y, z]: [f64; 3]| {
        format!(
            "<inertial><origin xyz=\"{xyz}\"/><mass value=\"{mass}\"/><inertia ixx=\"{x}\" ixy=\"0\" ixz=\"0\" iyy=\"{y}\" iyz=\"0\" izz=\"{z}\"/></inertial>"
        )
    };
    let shape = |tag: &str, name: &str, xyz: &str, size: &str| {
        format!(
            "<{tag} name=\"{name}\"><origin xyz=\"{xyz}\"/><geometry><box size=\"{size}\"/></geometry></{tag}>"
        )
    };
    let both = |name: &str, xyz: &str, size: &str| {
        shape("visual", name, xyz, size) + &shape("collision", name, xyz, size)
    };
    let link = |name: &str, content: String| format!("<link name=\"{name}\">{content}</link>");
    let joint = |name: &str, kind: &str, parent: &str, child: &str, rest: &str| {
        format!(
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>{rest}</joint>"
        )
    };
    link("base", mass(2.0, "0 0 0.1", [0.02, 0.03, 0.04]) + &both("b", "0 0 0.1", "0.2 0.2 0.2"))
        + &link(
            "plate",
            mass(1.0, "0.1 0 0", [0.01, 0.02, 0.03]) + &both("p", "0.1 0 0", "0.2 0.1 0.04"),
        )
        + &link(
            "arm",
            mass(0.5, "0 0 0.25", [0.01, 0.01, 0.001]) + &both("a", "0 0 0.3", "0.04 0.04 0.4"),
        )
        + &link("camera", String::new())
        + &link("finger", mass(0.25, "0 0 0", [0.001; 3]) + &both("f", "0 0 0.3", "0.02 0.02 0.02"))
        + &joint(
            "bolt",
            "fixed",
            "base",
            "plate",
            "<origin xyz=\"0.3 0 0\" rpy=\"0 0 1.5707963267948966\"/>",
        )
        + &joint(
            "turn",
            "revolute",
            "plate",
            "arm",
            &format!("<origin xyz=\"0 0.2 0\"/><axis xyz=\"0 0 1\"/>{LIMIT}"),
        )
        + &joint("mount", "fixed", "arm", "camera", "<origin xyz=\"0 0 0.5\" rpy=\"0.5 -0.25 0\"/>")
        + &joint(
            "slide",
            "prismatic",
            "camera",
            "finger",
            &format!(
                "<origin xyz=\"0 0.125 0\"/><axis xyz=\"0 1 0\"/>{LIMIT}<mimic joint=\"turn\" multiplier=\"0.5\" offset=\"0.1\"/>"
            ),
        )
}

/// Two bodies about their common centre: the sum of their own moments, the plate's turned a quarter about z, and the
/// reduced mass 2/3 kg at the distance (0.3, 0.1, -0.1) of their centres. xx, xy, xz, yy, yz, zz.
const LUMPED: [f64; 6] =
    [0.04 + 0.04 / 3.0, -0.02, 0.02, 0.04 + 0.2 / 3.0, 0.02 / 3.0, 0.07 + 0.2 / 3.0];
const CENTRE: [f64; 3] = [0.1, 0.1 / 3.0, 0.2 / 3.0];

fn merged(robot: &Robot, format: Format, choices: Choices) -> Export {
    export(robot, format, &Choices { merge_fixed: true, ..choices }).expect("an export")
}

fn plain() -> Choices {
    Choices { shapes: ShapeKind::Boxes.into(), ..Choices::default() }
}

#[track_caller]
fn is_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (one, other) in found.iter().zip(expected) {
        assert!((one - other).abs() < 1e-6, "{found:?} {expected:?}");
    }
}

fn numbers(node: Node, key: &str) -> Vec<f64> {
    let text = node.attribute(key).or(node.text()).unwrap_or_default();
    text.split_whitespace().map(|part| part.parse().expect("a number")).collect()
}

fn named<'a>(of: Node<'a, 'a>, tag: &str, name: &str) -> Node<'a, 'a> {
    let mut found = of.descendants().filter(|node| node.has_tag_name(tag));
    found.find(|node| node.attribute("name") == Some(name)).expect(name)
}

fn child<'a>(of: Node<'a, 'a>, path: &str) -> Node<'a, 'a> {
    let find = |at: Node<'a, 'a>, tag| at.children().find(|node| node.has_tag_name(tag));
    path.split('/').try_fold(of, find).expect(path)
}

#[test]
fn a_urdf_has_one_body_for_what_is_fixed_and_its_frames_as_empty_links() {
    let source = urdf(&parts());
    let (_folder, robot) = robot(&source);
    let made = merged(&robot, Format::Urdf, plain());
    let text = Text::new(&made.text);
    let (mass, centre, moments) = inertial(text.named("link", "base"));
    is_near(&[mass], &[3.0]);
    is_near(&centre, &CENTRE);
    is_near(&moments, &LUMPED);
    for frame in ["plate", "camera"] {
        assert_eq!(text.named("link", frame).children().filter(Node::is_element).count(), 0);
    }
    assert_eq!(text.of_joint("turn", "parent"), "base");
    assert_eq!(text.of_joint("slide", "parent"), "arm");
    let names = |tag: &'static str| {
        let shapes = text.named("link", "base").children().filter(move |it| it.has_tag_name(tag));
        shapes.map(|it| it.attribute("name").unwrap_or_default()).collect::<Vec<_>>()
    };
    assert_eq!(names("collision"), ["b", "p"]);
    // All links are where they were, and weigh as before, in any configuration.
    let before = Text::new(&source);
    for turn in [-1.5, 0.0, 0.7, 2.0] {
        let value = |joint: &str| if joint == "turn" { turn } else { 0.0 };
        let (old, new) = (before.poses(&value), text.poses(&value));
        assert_eq!(old.keys().collect::<Vec<_>>(), new.keys().collect::<Vec<_>>());
        for (link, pose) in &old {
            let (there, here) = (pose.to_homogeneous(), new[link].to_homogeneous());
            assert!((there - here).amax() < 1e-12, "{link}");
        }
        let (old, new) = (before.weight("arm", &value), text.weight("arm", &value));
        assert!((old.0 - new.0).abs() < 1e-12 && (old.1 - new.1).amax() < 1e-12);
        assert!((old.2 - new.2).amax() < 1e-12);
    }
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert!(notes.iter().any(|note| note.contains("`plate`, `camera`")), "{notes:?}");
}

#[test]
fn mjcf_has_sites_where_links_were() {
    let (_folder, robot) = robot(&urdf(&parts()));
    let setup = "robot = \"r\"\n[frames]\ntools = [\"camera\"]\nimus = [\"plate\"]\n[actuators.joint.turn]\narmature = 0.5";
    let setup = Some(Setup::from_toml(setup, "x", &robot).expect("a setup"));
    let made = merged(&robot, Format::Mjcf, Choices { sensors: true, setup, ..plain() });
    let document = parse(&made.text, Kind::Other).expect("XML");
    let root = document.root_element();
    let bodies = root.descendants().filter(|node| node.has_tag_name("body"));
    let bodies: Vec<_> = bodies.filter_map(|body| body.attribute("name")).collect();
    assert_eq!(bodies, ["base", "arm", "finger"]);
    let base = named(root, "body", "base");
    let inertial = child(base, "inertial");
    is_near(&numbers(inertial, "mass"), &[3.0]);
    is_near(&numbers(inertial, "pos"), &CENTRE);
    let [xx, xy, xz, yy, yz, zz] = LUMPED;
    is_near(&numbers(inertial, "fullinertia"), &[xx, yy, zz, xy, xz, yz]);
    let site = named(base, "site", "plate");
    assert_eq!(site.parent(), Some(base));
    is_near(&numbers(site, "pos"), &[0.3, 0.0, 0.0]);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    is_near(&numbers(site, "quat"), &[half, 0.0, 0.0, half]);
    assert_eq!(named(named(root, "body", "arm"), "site", "camera").attribute("group"), Some("4"));
    assert_eq!(root.descendants().filter(|node| node.has_tag_name("site")).count(), 2);
    assert_eq!(named(root, "gyro", "plate/gyro").attribute("site"), Some("plate"));
    assert_eq!(named(root, "joint", "turn").attribute("armature"), Some("0.5"));
    is_near(&numbers(named(root, "body", "arm"), "pos"), &[0.1, 0.0, 0.0]);
    // The plate's box: its centre was at (0.1, 0, 0) of the plate.
    is_near(&numbers(named(base, "geom", "base/1"), "pos"), &[0.3, 0.1, 0.0]);
}

#[test]
fn sdf_has_frames_and_drake_has_its_own() {
    let (_folder, robot) = robot(&urdf(&parts()));
    let made = merged(&robot, Format::Sdf, plain());
    let document = parse(&made.text, Kind::Other).expect("XML");
    let model = child(document.root_element(), "model");
    let all = |tag: &str| {
        let all = model.children().filter(|node| node.has_tag_name(tag));
        all.filter_map(|node| node.attribute("name")).collect::<Vec<_>>()
    };
    assert_eq!(all("link"), ["base", "arm", "finger"]);
    assert_eq!(all("joint"), ["world_fixed", "turn", "slide"]);
    assert_eq!(all("frame"), ["plate", "camera"]);
    let plate = named(model, "frame", "plate");
    assert_eq!(plate.attribute("attached_to"), Some("base"));
    let pose = child(plate, "pose");
    is_near(&numbers(pose, ""), &[0.3, 0.0, 0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2]);
    let own = child(named(model, "link", "base"), "inertial");
    is_near(&numbers(child(own, "mass"), ""), &[3.0]);
    is_near(&numbers(child(own, "inertia/ixx"), ""), &LUMPED[..1]);
    assert_eq!(child(named(model, "joint", "slide"), "parent").text(), Some("arm"));

    let made = merged(&robot, Format::Drake, plain());
    let text = Text::new(&made.text);
    let all = |tag: &'static str| {
        text.all(tag).filter_map(|node| node.attribute("name")).collect::<Vec<_>>()
    };
    assert_eq!(all("link"), ["base", "arm", "finger"]);
    assert_eq!(all("joint"), ["turn", "slide"]);
    assert_eq!(all("frame"), ["plate", "camera"]);
    let plate = text.named("frame", "plate");
    assert_eq!(plate.attribute("link"), Some("base"));
    is_near(&numbers(plate, "xyz"), &[0.3, 0.0, 0.0]);
    is_near(&numbers(plate, "rpy"), &[0.0, 0.0, std::f64::consts::FRAC_PI_2]);
    is_near(&inertial(text.named("link", "base")).2, &LUMPED);
}

#[test]
fn usd_has_empty_xforms_below_the_body() {
    let (_folder, robot) = robot(&urdf(&parts()));
    let made = merged(&robot, Format::Usd, plain());
    let read = crate::usd::Read::new(&made.text);
    let bodies: Vec<&str> = read.links().iter().map(|prim| prim.name()).collect();
    assert_eq!(bodies, ["base", "arm", "finger"]);
    let base = read.links()[0];
    let plate = base.children.iter().find(|prim| prim.name() == "plate").expect("a frame");
    assert!(!plate.applies("PhysicsRigidBodyAPI") && !plate.applies("PhysicsMassAPI"));
    is_near(&plate.numbers("xformOp:translate"), &[0.3, 0.0, 0.0]);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    is_near(&plate.numbers("xformOp:orient"), &[half, 0.0, 0.0, half]);
    is_near(&base.numbers("physics:mass"), &[3.0]);
    is_near(&base.numbers("physics:centerOfMass"), &CENTRE);
    let joints: Vec<&str> = read.joints().iter().map(|prim| prim.name()).collect();
    assert_eq!(joints, ["world_fixed", "turn", "slide"]);
}

#[test]
fn groups_of_moveit_begin_at_the_body() {
    let (_folder, robot) = robot(&urdf(&parts()));
    let setup = "robot = \"r\"\n[[group]]\nname = \"arm\"\nbase = \"plate\"\ntip = \"camera\"\n[[end_effector]]\nname = \"e\"\ngroup = \"f\"\nparent_link = \"camera\"\n[[group]]\nname = \"f\"\njoints = [\"turn\"]";
    let setup = Some(Setup::from_toml(setup, "x", &robot).expect("a setup"));
    let made = merged(&robot, Format::Moveit, Choices { setup, ..plain() });
    let (_, srdf) = made.files.iter().find(|(path, _)| path.ends_with(".srdf")).map_or_else(
        || (String::new(), made.text.clone()),
        |(path, bytes)| (path.clone(), String::from_utf8(bytes.clone()).expect("a text")),
    );
    let document = parse(&srdf, Kind::Other).expect("XML");
    let root = document.root_element();
    let chain = child(named(root, "group", "arm"), "chain");
    assert_eq!(
        (chain.attribute("base_link"), chain.attribute("tip_link")),
        (Some("base"), Some("camera"))
    );
    assert_eq!(named(root, "end_effector", "e").attribute("parent_link"), Some("camera"));
}

/// A post with a bearing fixed to it, in which a bar turns all the way round: it is always in the bearing, and meets the
/// post where it points down.
const BAR: &str = r#"<link name="post"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
<link name="bearing"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
<link name="bar"><collision><origin xyz="0 0 0.5"/><geometry><box size="0.05 0.05 1"/></geometry></collision></link>
<joint name="bolt" type="fixed"><parent link="post"/><child link="bearing"/><origin xyz="0 0 0.3"/></joint>
<joint name="turn" type="continuous"><parent link="bearing"/><child link="bar"/><axis xyz="0 1 0"/></joint>"#;

#[test]
fn pairs_of_joined_links_are_those_of_their_parts() {
    let (_folder, robot) = robot(&urdf(BAR));
    let made =
        |format, keep_pairs| merged(&robot, format, Choices { keep_pairs, ..Choices::default() });
    // By links: what always touches would collide for ever, so the pair is disabled, and it is said what is lost.
    let srdf = made(Format::Srdf, false);
    assert!(srdf.text.contains("link1=\"post\" link2=\"bar\""), "{}", srdf.text);
    let notes: Vec<String> = srdf.notes.iter().map(ToString::to_string).collect();
    let lost = notes.iter().find(|note| note.contains("collisions are lost in")).expect("a note");
    // The bar turns 0.2 m above the post's edges, which are 0.1 m to its sides, and is 0.05 m thick.
    let count = lost.split("lost in ").nth(1).and_then(|rest| rest.split(' ').next());
    let share = count.expect("a count").parse::<f64>().expect("a number") / 1000.0;
    let half = (0.1f64 / 0.2).atan() + (0.025 / 0.1f64.hypot(0.2)).asin();
    let expected = half / std::f64::consts::PI;
    assert!((share - expected).abs() < 0.04, "{share} {expected}");
    assert!(!made(Format::Srdf, true).text.contains("<disable_collisions"));
    // By pieces: what the bearing touches is left out, and what the post may touch is checked.
    let mjcf = made(Format::Mjcf, false).text;
    assert!(mjcf.contains("<exclude body1=\"post\" body2=\"bar\"/>"), "{mjcf}");
    assert!(mjcf.contains("<pair geom1=\"post/0\" geom2=\"bar/0\"/>"), "{mjcf}");
    assert!(!mjcf.contains("geom1=\"post/1\""), "{mjcf}");
    let usd = made(Format::Usd, true).text;
    assert!(usd.contains("rel physics:filteredPairs = </r/bar/collisions/piece_0>"), "{usd}");
}

fn fixed(child: &str, mass: &str, parent: &str) -> String {
    format!(
        "<link name=\"{child}\"><inertial><origin xyz=\"1 0 0\"/><mass value=\"{mass}\"/><inertia ixx=\"0.5\" ixy=\"0\" ixz=\"0\" iyy=\"0.5\" iyz=\"0\" izz=\"0.5\"/></inertial></link>\
<joint name=\"{child}_fixed\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"{child}\"/></joint>"
    )
}

#[test]
fn masses_of_nothing_and_less() {
    // A negative mass counts as 0 kg, and its moments stay, as in MuJoCo; so the centre is that of the others.
    let parts = "<link name=\"base\"/>".to_owned()
        + &fixed("a", "2", "base")
        + &fixed("b", "-1", "a")
        + &fixed("c", "0", "base");
    let (_folder, robot) = robot(&urdf(&parts));
    let made = merged(&robot, Format::Urdf, plain());
    let (mass, centre, moments) = inertial(Text::new(&made.text).named("link", "base"));
    is_near(&[mass], &[2.0]);
    is_near(&centre, &[1.0, 0.0, 0.0]);
    is_near(&moments, &[1.5, 0.0, 0.0, 1.5, 0.0, 1.5]);
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert!(
        notes.iter().any(|note| note.starts_with("link `b`: its mass is negative")),
        "{notes:?}"
    );
    // The whole robot is one body.
    let mjcf = merged(&robot, Format::Mjcf, Choices { floating_base: true, ..plain() }).text;
    assert_eq!(mjcf.matches("<body ").count(), 1, "{mjcf}");
    assert_eq!(mjcf.matches("<site ").count(), 3, "{mjcf}");
}

#[test]
fn nothing_is_joined_with_the_world() {
    let parts =
        "<link name=\"world\"/>".to_owned() + &fixed("a", "2", "world") + &fixed("b", "1", "a");
    let (_folder, robot) = robot(&urdf(&parts));
    for format in [Format::Drake, Format::Urdf] {
        let text = merged(&robot, format, plain()).text;
        is_near(&[inertial(Text::new(&text).named("link", "a")).0], &[3.0]);
    }
    let mjcf = merged(&robot, Format::Mjcf, plain()).text;
    assert_eq!(mjcf.matches("<body ").count(), 1, "{mjcf}");
    assert!(mjcf.contains("mass=\"3\""), "{mjcf}");
}

#[test]
fn too_much_is_refused() {
    let far = fixed("a", "1e308", "base") + &fixed("b", "1e308", "base");
    let (_folder, robot) = robot(&urdf(&("<link name=\"base\"/>".to_owned() + &far)));
    let choices = Choices { merge_fixed: true, ..plain() };
    let refused = export(&robot, Format::Urdf, &choices);
    assert!(matches!(refused, Err(ExportError::Infinite { .. })), "{refused:?}");
}

#[test]
fn sensors_of_gazebo_are_on_the_body_and_at_the_frame() {
    let gazebo = "<gazebo reference=\"plate\"><mu1>0.75</mu1><sensor name=\"s\" type=\"imu\"><pose>0 0 1 0 0 0</pose></sensor></gazebo>";
    let (_folder, robot) = robot(&urdf(&(parts() + gazebo)));
    let made = merged(&robot, Format::Sdf, plain());
    let document = parse(&made.text, Kind::Other).expect("XML");
    let sensor = named(document.root_element(), "sensor", "s");
    assert_eq!(sensor.parent().and_then(|link| link.attribute("name")), Some("base"));
    let pose = child(sensor, "pose");
    assert_eq!((pose.attribute("relative_to"), pose.text()), (Some("plate"), Some("0 0 1 0 0 0")));
    // Friction is of the plate's own shape.
    let base = named(document.root_element(), "link", "base");
    let shapes: Vec<_> = base.children().filter(|it| it.has_tag_name("collision")).collect();
    let mu = |at: usize| {
        shapes[at].descendants().find(|it| it.has_tag_name("mu")).and_then(|it| it.text())
    };
    assert_eq!((mu(0), mu(1)), (None, Some("0.75")));
}

#[test]
fn primitives_of_the_source_are_where_their_link_was() {
    let (_folder, robot) = robot(&urdf(&parts()));
    let source = || Choices { shapes: Shapes::Source, ..Choices::default() };
    let made = merged(&robot, Format::Mjcf, source());
    let document = parse(&made.text, Kind::Other).expect("XML");
    let geom = named(document.root_element(), "geom", "base/1");
    assert_eq!(geom.attribute("type"), Some("box"));
    is_near(&numbers(geom, "size"), &[0.1, 0.05, 0.02]);
    is_near(&numbers(geom, "pos"), &[0.3, 0.1, 0.0]);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    is_near(&numbers(geom, "quat"), &[half, 0.0, 0.0, half]);
    let made = merged(&robot, Format::Urdf, source());
    let text = Text::new(&made.text);
    for tag in ["visual", "collision"] {
        let all = text.named("link", "base").children().filter(|it| it.has_tag_name(tag));
        let second = all.skip(1).map(|it| child(it, "origin")).next().expect("the plate's");
        is_near(&numbers(second, "xyz"), &[0.3, 0.1, 0.0]);
    }
}
