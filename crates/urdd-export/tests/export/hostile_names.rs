//! Arbitrary names, through every format and back by a strict parser. Each comes back unchanged, or the export is
//! refused and names what the format cannot express.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::made::export;
use urdd_export::{Choices, Export, ExportError, Format, Note};
use urdd_robot::Robot;
use urdd_srdf::merge_srdf;

use testkit::robots::made_of;
use testkit::trials::sample;
use testkit::xml::parsed;

/// Placeholders that a test replaces by its own names.
const STANDINS: [&str; 5] = ["ROBOT_", "LINK_0", "LINK_1", "JOINT_0", "MATERIAL_"];

/// Two boxes that touch, a joint and a material, with names to be replaced.
const URDF: &str = r#"<robot name="ROBOT_">
<material name="MATERIAL_"><color rgba="1 0 0 1"/></material>
<link name="LINK_0"><visual><geometry><box size="0.2 0.2 0.2"/></geometry><material name="MATERIAL_"/></visual></link>
<link name="LINK_1"><visual><geometry><box size="0.1 0.1 0.3"/></geometry><material name="MATERIAL_"/></visual></link>
<joint name="JOINT_0" type="revolute"><parent link="LINK_0"/><child link="LINK_1"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#;

/// A URDD of [`URDF`] with other names in its documents.
struct Neutral {
    _folder: tempfile::TempDir,
    path: PathBuf,
    documents: Vec<(PathBuf, String)>,
}

impl Neutral {
    fn new() -> Self {
        let (folder, path) = made_of(URDF);
        let mut documents = Vec::new();
        collect(&path, &mut documents);
        assert!(documents.len() > 10);
        Neutral { _folder: folder, path, documents }
    }

    fn robot(&self, names: [&str; 5]) -> Robot {
        for (path, text) in &self.documents {
            let mut text = text.clone();
            for (standin, name) in STANDINS.iter().zip(names) {
                // Paths of meshes contain the placeholders too, and are kept.
                let json = serde_json::to_string(name).expect("JSON");
                text = text.replace(&format!("\"{standin}\""), &json);
            }
            std::fs::write(path, text).expect("a document");
        }
        Robot::open(&self.path).expect("a robot")
    }
}

fn collect(folder: &Path, documents: &mut Vec<(PathBuf, String)>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, documents);
        } else if path.extension().is_some_and(|extension| extension == "json") {
            documents.push((path.clone(), std::fs::read_to_string(&path).expect("text")));
        }
    }
}

/// The names in a file, by a reader of the format: of the robot if the format has one, of links, and of joints if it
/// has them.
#[derive(Debug, PartialEq)]
struct Names {
    robot: Option<String>,
    links: BTreeSet<String>,
    joints: Option<BTreeSet<String>>,
}

/// A new format takes one line.
fn read(format: Format, text: &str) -> Names {
    match format {
        Format::Srdf | Format::Moveit => srdf(text),
        Format::Urdf
        | Format::Drake
        | Format::Spherized
        | Format::UrdfPlus
        | Format::ExtendedUrdf => urdf(text),
        Format::Sdf => sdf(text),
        Format::Mjcf => mjcf(text),
        Format::Usd => usd(text),
        Format::Curobo => keys(serde_yaml::from_str(text).expect("YAML"), "collision_spheres"),
        Format::Foam => keys(serde_json::from_str(text).expect("JSON"), "links"),
    }
}

fn of_tag(text: &str, tag: &str, key: &str) -> BTreeSet<String> {
    let document = parsed(text);
    let nodes = document.descendants().filter(|node| node.has_tag_name(tag));
    nodes.filter_map(|node| node.attribute(key).map(str::to_owned)).collect()
}

fn robot(text: &str, key: &str) -> Option<String> {
    parsed(text).root_element().attribute(key).map(str::to_owned)
}

fn srdf(text: &str) -> Names {
    let mut links = of_tag(text, "disable_collisions", "link1");
    links.extend(of_tag(text, "disable_collisions", "link2"));
    Names { robot: robot(text, "name"), links, joints: None }
}

fn urdf(text: &str) -> Names {
    Names {
        robot: robot(text, "name"),
        links: of_tag(text, "link", "name"),
        joints: Some(of_tag(text, "joint", "name")),
    }
}

/// A root link called `world` is SDF's own: only joints name it.
fn sdf(text: &str) -> Names {
    let mut links = of_tag(text, "link", "name");
    let mut joints = of_tag(text, "joint", "name");
    let document = parsed(text);
    let nodes = document.descendants().filter(|node| node.has_tag_name("joint"));
    for joint in nodes.filter(|joint| joint.attribute("name") != Some("world_fixed")) {
        let ends = joint
            .children()
            .filter(|node| node.has_tag_name("parent") || node.has_tag_name("child"));
        links.extend(ends.filter_map(|node| node.text().map(str::to_owned)));
    }
    joints.remove("world_fixed");
    let model = document.descendants().find(|node| node.has_tag_name("model"));
    Names {
        robot: model.and_then(|model| model.attribute("name").map(str::to_owned)),
        links,
        joints: Some(joints),
    }
}

fn mjcf(text: &str) -> Names {
    let mut links = of_tag(text, "body", "name");
    let excluded = of_tag(text, "exclude", "body1");
    links.extend(excluded);
    Names { robot: robot(text, "model"), links, joints: Some(of_tag(text, "joint", "name")) }
}

/// What prims show.
fn usd(text: &str) -> Names {
    let read = crate::usd::Read::new(text);
    let shown = |prims: Vec<&testkit::usda::Prim>| {
        prims.iter().map(|prim| prim.shown().to_owned()).collect::<BTreeSet<_>>()
    };
    let mut joints = read.joints();
    joints.retain(|joint| joint.properties.contains_key("physics:body0"));
    Names {
        robot: Some(read.root.shown().to_owned()),
        links: shown(read.links()),
        joints: Some(shown(joints)),
    }
}

fn keys(document: serde_json::Value, key: &str) -> Names {
    let links = document[key].as_object().expect("an object").keys();
    Names { robot: None, links: links.cloned().collect(), joints: None }
}

/// Whether a format may refuse a name: because XML cannot represent a character in it, or because of the target
/// program.
fn may_refuse(format: Format, name: &str) -> bool {
    let unheld =
        |c: char| (c < ' ' && !"\t\n\r".contains(c)) || ['\u{fffe}', '\u{ffff}'].contains(&c);
    match format {
        Format::Curobo | Format::Foam | Format::Usd => name.is_empty(),
        Format::Drake if name.contains("::") => true,
        Format::Drake | Format::Mjcf | Format::Sdf if name == "world" => true,
        // Names in text are trimmed by readers of SDF; xacro evaluates some in MoveIt.
        Format::Sdf if name.contains("::") || name.trim() != name => true,
        Format::Moveit if name.contains("${") || name.contains("$(") => true,
        // It also prints white space as a space; and what begins with `-` is an option of a program.
        Format::Moveit if name.contains(['\t', '\n', '\r']) || name.starts_with('-') => true,
        _ => name.is_empty() || name.contains(unheld),
    }
}

fn hostile() -> Vec<String> {
    let mut names: Vec<String> = [
        "-",
        "--",
        "---",
        "-->",
        "--->",
        "--!>",
        "a--",
        "--a",
        "<!--",
        "]]>",
        "<![CDATA[x]]>",
        "<?xml?>",
        "---><!DOCTYPE robot [<!ENTITY e 'y'>]><robot name='other'/><!--",
        "'/><link name='evil'/><x a='",
        "\"/><link name=\"evil\"/><x a=\"",
        "a\nb",
        "a\tb",
        "a\rb",
        "a\r\nb",
        " a",
        "a ",
        "  ",
        "\n",
        "a  b",
        "\"",
        "'",
        "'\"",
        "&",
        "&amp;",
        "&#10;",
        "&lt;",
        "<",
        ">",
        "a<b>\"&'",
        "\u{202e}evil",
        "\u{2066}a\u{2069}",
        "a\u{200b}b",
        "\u{feff}a",
        "a\u{2028}b",
        "a\u{85}b",
        "a\u{7f}b",
        "\u{0}",
        "a\u{0}b",
        "\u{1b}[2J",
        "\u{fffe}",
        "\u{ffff}",
        "\u{1fffe}",
        "\u{10ffff}",
        "🤖",
        "é",
        "e\u{301}",
        "no",
        "yes",
        "on",
        "~",
        "null",
        "true",
        "1:30",
        "0x1",
        "1e3",
        ".nan",
        "- x",
        "# x",
        "x # y",
        "%TAG",
        "@x",
        "`x`",
        "*x",
        "&x y",
        "!x",
        "|",
        ">",
        "? x",
        "x: y",
        "{a}",
        "[a]",
        "<<",
        "=",
        "---\n...",
        "a/b",
        "/",
        "//",
        "..",
        "../../etc/passwd",
        ".",
        "a\\b",
        "C:\\x",
        "a::b",
        "::",
        "world",
        "World",
        "[x]",
        "x = 1",
        "\"\"\"",
        "$(x)",
        "${x}",
        "%s",
        "{{x}}",
        "",
    ]
    .map(str::to_owned)
    .to_vec();
    names.push("x".repeat(100_000));
    names.push("-".repeat(1_000));
    names.push("\n".repeat(300));
    names
}

#[test]
fn every_name_comes_out_of_every_format_as_it_went_in() {
    let neutral = Neutral::new();
    // Spheres are the same whatever the names are: as few as can be.
    let options = Choices { spheres: Some(1), samples: 100, ..Choices::default() };
    let (mut held, mut refused) = (0, 0);
    for name in sample(hostile(), 3) {
        let (other, joint) = (format!("{name}2"), format!("{name}j"));
        let robot = neutral.robot([&name, &name, &other, &joint, &name]);
        for &format in Format::ALL {
            let made = match export(&robot, format, &options) {
                Ok(made) => made,
                Err(ExportError::Name { name: said, .. }) => {
                    assert!(
                        [&name, &other, &joint].contains(&&said),
                        "{format:?} {name:?} {said:?}"
                    );
                    assert!(may_refuse(format, &said), "{format:?} refuses {said:?}");
                    refused += 1;
                    continue;
                }
                Err(error) => panic!("{format:?} {name:?}: {error}"),
            };
            held += 1;
            let names = read(format, &made.text);
            let expected = BTreeSet::from([name.clone(), other.clone()]);
            // In an MJCF, a root with this name is MuJoCo's own body.
            assert_eq!(names.links, expected, "{format:?}");
            if let Some(found) = names.robot {
                assert_eq!(found, name, "{format:?}");
            }
            if let Some(joints) = names.joints {
                assert_eq!(joints, BTreeSet::from([joint.clone()]), "{format:?}");
            }
            files_are_safe(&made, &name);
            if format == Format::Srdf {
                updated(&made.text, &name, &expected);
            }
        }
    }
    assert!(held > 160 && refused > 6, "{held} {refused}");
}

/// Mesh files have names that every file system allows, whatever the links are called.
fn files_are_safe(made: &Export, name: &str) {
    for (path, _) in &made.files {
        let folders = ["meshes/", "config/", "launch/", ""].map(|folder| path.strip_prefix(folder));
        let file = folders.into_iter().flatten().next().expect("in a folder");
        let is_beside = path.starts_with("meshes/") || path == "robot.yaml";
        assert!(is_beside || made.path.is_some(), "{path}");
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
        assert!(file.chars().all(is_plain) && !file.starts_with('.'), "{name:?}: {path}");
        assert!(file.len() < 200, "{path}");
    }
}

/// A user's own SRDF, with this name in its comments too, and with its pairs updated.
fn updated(new: &str, name: &str, expected: &BTreeSet<String>) {
    let mut old = String::from("<?xml version=\"1.0\"?>\n<!-- mine - - -->\n");
    let attribute = new.lines().find(|line| line.starts_with("<robot")).expect("a robot");
    let attribute = attribute.trim_end_matches(['/', '>']);
    old += &format!(
        "{attribute}>\n  <group name=\"g\"/>\n  <disable_collisions link1=\"x\" link2=\"y\" reason=\"Never\"/>\n</robot>\n"
    );
    let merged = merge_srdf(&old, new).expect("merged");
    let names = srdf(&merged.text);
    assert_eq!((&names.links, names.robot.as_deref()), (expected, Some(name)));
    assert!(
        merged.text.contains("<!-- mine - - -->\n") && merged.text.contains("<group name=\"g\"/>")
    );
    assert_eq!(merge_srdf(&merged.text, new).unwrap().text, merged.text);
}

#[test]
fn names_that_collide_stay_apart() {
    let neutral = Neutral::new();
    for [a, b] in
        [["Arm", "arm"], ["a/b", "a_b"], ["a b", "a_b"], ["a", "a/0"], ["a/0", "a/0/0"], ["é", "ü"]]
    {
        let robot = neutral.robot(["r", a, b, "j", "m"]);
        for &format in Format::ALL {
            let made = export(&robot, format, &Choices::default()).expect("an export");
            let expected = BTreeSet::from([a.to_owned(), b.to_owned()]);
            assert_eq!(read(format, &made.text).links, expected, "{format:?}");
            let folded: BTreeSet<String> =
                made.files.iter().map(|(path, _)| path.to_lowercase()).collect();
            assert_eq!(folded.len(), made.files.len());
        }
        let text = export(&robot, Format::Mjcf, &Choices::default()).expect("an export").text;
        assert_eq!(of_tag(&text, "geom", "name").len(), 2);
    }
    // Two elements with one name are one too many.
    let robot = neutral.robot(["r", "a", "a", "j", "m"]);
    for &format in Format::ALL {
        assert!(export(&robot, format, &Choices::default()).is_err(), "{format:?}");
    }
}

#[test]
fn a_part_of_a_joint_gives_way_to_a_name() {
    let urdf = |other: &str| {
        format!(
            "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>\
             <joint name='j' type='floating'><parent link='a'/><child link='b'/></joint>\
             <joint name='{other}' type='continuous'><parent link='b'/><child link='c'/></joint></robot>"
        )
    };
    let (_folder, path) = made_of(&urdf("j/trans_x"));
    let robot = Robot::open(path).expect("a robot");
    for format in [Format::Mjcf, Format::Drake, Format::Sdf] {
        let made = export(&robot, format, &Choices::default()).expect("an export");
        let joints = of_tag(&made.text, "joint", "name");
        assert!(joints.contains("j/trans_x") && joints.contains("j/trans_x_2"), "{joints:?}");
    }
    // Drake's own name of a frame.
    let (_folder, path) = made_of(
        "<robot name='r'><link name='a'/><link name='j_parent'/>\
         <joint name='j' type='continuous'><parent link='a'/><child link='j_parent'/></joint></robot>",
    );
    let robot = Robot::open(path).expect("a robot");
    let error = export(&robot, Format::Drake, &Choices::default()).expect_err("a name");
    assert!(matches!(&error, ExportError::Name { name, .. } if name == "j_parent"), "{error}");
    let (_folder, path) = made_of(&urdf("k"));
    let robot = Robot::open(path).expect("a robot");
    for format in [Format::Mjcf, Format::Drake, Format::Sdf] {
        assert!(export(&robot, format, &Choices::default()).is_ok());
    }
}

/// Elements that URDF does not define, and that would be a second robot, or not well-formed XML, if copied.
#[test]
fn unknown_elements_add_nothing_that_urdf_defines() {
    let neutral = Neutral::new();
    let robot = || neutral.robot(["r", "a", "b", "j", "m"]);
    drop(robot());
    let module = neutral.path.join("urdf_module/module.json");
    let mut document: serde_json::Value =
        serde_json::from_slice(&std::fs::read(&module).expect("a module")).expect("JSON");
    let kept = ["<gazebo><x/></gazebo>", "<!-- c --><gazebo/>", "<?xml version=\"1.0\"?><gazebo/>"];
    let lost = [
        "<link name='evil'/>",
        "<joint name='evil'/>",
        "<gazebo/><link name='evil'/>",
        "<!DOCTYPE gazebo><gazebo/>",
        "<gazebo>]]></gazebo>",
        "</robot><robot>",
        "gazebo",
        "<p:gazebo/>",
        "",
    ];
    let all: Vec<&str> = kept.into_iter().chain(lost).collect();
    document["unknown_elements"] = serde_json::json!(all);
    std::fs::write(&module, document.to_string()).expect("written");
    let robot = Robot::open(&neutral.path).expect("a robot");
    for format in [Format::Urdf, Format::Drake] {
        let made = export(&robot, format, &Choices::default()).expect("an export");
        let names = read(format, &made.text);
        assert_eq!(names.links, BTreeSet::from(["a".to_owned(), "b".to_owned()]));
        assert_eq!(names.joints, Some(BTreeSet::from(["j".to_owned()])));
        let document = parsed(&made.text);
        let gazebo = document.descendants().filter(|node| node.has_tag_name("gazebo"));
        assert_eq!(gazebo.count(), kept.len());
        assert!(made.notes.contains(&Note::Elements(lost.len())), "{:?}", made.notes);
    }
}
