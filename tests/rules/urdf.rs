use std::path::Path;

use serde_json::{Value, json};
use urdd_format::urdf::{Axis, Mimic};
use urdd_validate::code::Code::*;

use crate::{Case, changed, in_folder, invalid, near_miss};
use testkit::fixture::{Fixture, URDF, toy_robot, value};
use testkit::robot::{Robot, link};

pub fn cases() -> Vec<Case> {
    let mut cases = against_the_urdf();
    cases.extend(there_without_what_it_is_for());
    cases.extend(trees());
    cases.extend(mimics_and_axes());
    cases.extend(readable());
    cases.extend(legacy());
    cases
}

/// The toy with this fault in both its URDF and its `urdf_module`: it is faithful, and wrong.
fn faulty(
    code: urdd_validate::code::Code,
    name: &'static str,
    change: impl Fn(&mut Robot) + 'static,
) -> Case {
    invalid(code, name, move |urdd| {
        let mut robot = toy_robot();
        change(&mut robot);
        urdd.files.insert(URDF.to_owned(), robot.to_urdf_xml().into_bytes());
        *urdd.doc_mut("urdf_module") = value(&robot.urdf);
    })
}

/// A valid URDD of a robot other than the toy.
fn sound(
    code: urdd_validate::code::Code,
    name: &'static str,
    change: impl Fn(&mut Robot) + 'static,
) -> Case {
    let base = move || {
        let mut robot = toy_robot();
        change(&mut robot);
        Fixture::core(&robot)
    };
    changed(code, name, false, base, |_| {})
}

fn joint_pointer(urdd: &Fixture, name: &str, rest: &str) -> String {
    let joints = urdd.get("urdf_module", "/joints").as_array();
    let index = joints
        .and_then(|joints| joints.iter().position(|joint| joint["name"] == json!(name)))
        .expect("the joint");
    format!("/joints/{index}{rest}")
}

fn link_pointer(urdd: &Fixture, name: &str, rest: &str) -> String {
    let links = urdd.get("urdf_module", "/links").as_array();
    let index = links
        .and_then(|links| links.iter().position(|link| link["name"] == json!(name)))
        .expect("the link");
    format!("/links/{index}{rest}")
}

fn set_joint(urdd: &mut Fixture, name: &str, rest: &str, new: Value) {
    let pointer = joint_pointer(urdd, name, rest);
    urdd.set("urdf_module", &pointer, new);
}

fn set_link(urdd: &mut Fixture, name: &str, rest: &str, new: Value) {
    let pointer = link_pointer(urdd, name, rest);
    urdd.set("urdf_module", &pointer, new);
}

fn against_the_urdf() -> Vec<Case> {
    vec![
        // The URDF was changed, and the URDD was not generated again.
        invalid(URD001, "origin-changed", |urdd| {
            urdd.urdf_replace("xyz=\"0.05 0 0.2\"", "xyz=\"0.05 0 0.2000001\"");
        }),
        invalid(URD001, "limit-changed", |urdd| {
            urdd.urdf_replace("upper=\"0.2\"", "upper=\"0.21\"");
        }),
        invalid(URD001, "velocity-limit-gone", |urdd| {
            urdd.urdf_replace(" velocity=\"1.5\"", "");
        }),
        // Without the version, the quaternion of an origin has no meaning.
        invalid(URD001, "version-gone", |urdd| {
            urdd.urdf_replace(" version=\"1.2\"", "");
        }),
        invalid(URD001, "quaternion-lost", |urdd| {
            set_joint(urdd, "bolt", "/origin/quat_xyzw", json!(null));
        }),
        invalid(URD001, "jerk-lost", |urdd| {
            set_joint(urdd, "slide", "/limit/jerk", json!(null));
        }),
        invalid(URD001, "type-changed", |urdd| {
            urdd.urdf_replace(
                "name=\"flange\" type=\"fixed\"",
                "name=\"flange\" type=\"floating\"",
            );
        }),
        invalid(URD001, "mimic-changed", |urdd| {
            urdd.urdf_replace("multiplier=\"-1\"", "multiplier=\"-0.999\"");
        }),
        invalid(URD001, "link-added", |urdd| {
            urdd.urdf_replace(
                "</robot>",
                "<link name=\"new\"/><joint name=\"new\" type=\"fixed\"><parent link=\"base\"/>\
                 <child link=\"new\"/></joint></robot>",
            );
        }),
        invalid(URD001, "links-in-another-order", |urdd| {
            urdd.urdf_mut(|xml| {
                let moved = "<link name=\"frame\">\n</link>\n";
                assert!(xml.contains(moved));
                *xml = xml.replace(moved, "").replace("</robot>", &format!("{moved}</robot>"));
            });
        }),
        invalid(URD001, "joint-renamed", |urdd| {
            urdd.urdf_replace("name=\"spin\"", "name=\"Spin\"");
        }),
        // The producer filled in what the URDF leaves out.
        invalid(URD001, "absent-limit-as-zeros", |urdd| {
            let zeros = json!({"lower": 0.0, "upper": 0.0, "effort": 0.0, "velocity": 0.0,
                "acceleration": null, "deceleration": null, "jerk": null});
            set_joint(urdd, "flange", "/limit", zeros);
        }),
        invalid(URD001, "absent-axis-filled-in", |urdd| {
            set_joint(urdd, "bolt", "/axis", json!({"xyz": [1.0, 0.0, 0.0]}));
        }),
        near_miss(URD001, "same-numbers-otherwise-written", |urdd| {
            urdd.urdf_replace("xyz=\"0.05 0 0.2\"", "xyz='\n\t+5.E-2\r\n -0 .20000000000 '");
            urdd.urdf_replace("rpy=\"0.3 -1.2 2\"", "rpy=\"0.30000000001 -1.2 2\"");
        }),
        near_miss(URD001, "namespaces-comments-and-attributes-of-others", |urdd| {
            urdd.urdf_replace("<robot ", "<robot xmlns=\"urn:a\" xmlns:xacro=\"urn:b\" ");
            urdd.urdf_replace(
                "<joint name=\"turn\"",
                "<joint xacro:name=\"no\" speed=\"9\" name=\"turn\"",
            );
            urdd.urdf_replace("<axis", "<!-- <axis xyz=\"0 0 0\"/> --><axis");
        }),
        invalid(URD013, "collision-origin-lost", |urdd| {
            set_link(urdd, "base", "/collision/0/origin", Value::Null);
        }),
        invalid(URD013, "mass-changed", |urdd| {
            set_link(urdd, "turret", "/inertial/mass/value", json!(0.500_001));
        }),
        invalid(URD013, "absent-inertial-as-zeros", |urdd| {
            let zeros = json!({"origin": null, "mass": {"value": 0.0}, "inertia": {
                "ixx": 0.0, "ixy": 0.0, "ixz": 0.0, "iyy": 0.0, "iyz": 0.0, "izz": 0.0}});
            set_link(urdd, "frame", "/inertial", zeros);
        }),
        invalid(URD013, "visual-gone", |urdd| {
            urdd.urdf_replace("<visual name=\"no\">", "<visual/><visual name=\"no\">");
        }),
        invalid(URD014, "colour-changed", |urdd| {
            urdd.urdf_replace("rgba=\"0.8", "rgba=\"0.9");
        }),
        near_miss(URD014, "colour-in-another-notation", |urdd| {
            urdd.urdf_replace("rgba=\"0.8", "rgba=\"8e-1");
        }),
        invalid(URD013, "scale-forgotten", |urdd| {
            set_link(urdd, "tool/ü 1", "/visual/0/geometry/Mesh/scale", Value::Null);
        }),
        invalid(URD013, "unknown-element-changed", |urdd| {
            urdd.urdf_replace("<gazebo/>", "<gazebo />");
        }),
        invalid(URD013, "unknown-element-of-the-robot-lost", |urdd| {
            urdd.set("urdf_module", "/unknown_elements", json!([]));
        }),
        invalid(URD013, "damping-changed", |urdd| {
            urdd.urdf_replace("damping=\"0.1\"", "damping=\"0.2\"");
        }),
        near_miss(URD013, "line-ends-converted", |urdd| {
            urdd.urdf_mut(|xml| *xml = xml.replace('\n', "\r\n"));
        }),
        near_miss(URD013, "mass-in-another-notation", |urdd| {
            urdd.urdf_replace("<mass value=\"0.5\"/>", "<mass value=\" 5.0000000001e-1 \"/>");
        }),
    ]
}

/// SPEC 6.1.8, *Absent*: elements that are there without what they are for. Each right, and as it is not meant.
fn there_without_what_it_is_for() -> Vec<Case> {
    const FRAME: &str = "<link name=\"frame\">";
    let nothing = || json!({"origin": null, "mass": null, "inertia": null});
    let inertia = |off: Value| {
        json!({"origin": null, "mass": {"value": 1.0}, "inertia": {
            "ixx": 1.0, "ixy": off, "ixz": off, "iyy": 1.0, "iyz": off, "izz": 1.0}})
    };
    let diagonal =
        "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial>";
    let origin = |xyz: Value| json!({"origin": {"xyz": xyz, "rpy": null, "quat_xyzw": null}, "mass": null, "inertia": null});
    let rows = [
        ("inertial-with-nothing-in-it", "<inertial/>", nothing(), Value::Null),
        ("mass-without-value", "<inertial><mass/></inertial>", nothing(), Value::Null),
        ("inertia-of-three-elements", diagonal, inertia(Value::Null), inertia(json!(0.0))),
        (
            "origin-with-nothing-in-it",
            "<inertial><origin/></inertial>",
            origin(Value::Null),
            nothing(),
        ),
        (
            "position-that-is-not-finite",
            "<inertial><origin xyz=\"1 inf 0\"/></inertial>",
            origin(Value::Null),
            origin(json!([1.0, 0.0, 0.0])),
        ),
    ];
    let rows = rows.into_iter().flat_map(|(name, xml, right, other)| {
        [(name, right, false), (format!("{name}-taken-otherwise").leak(), other, true)].map(
            |(name, said, caught)| {
                changed(URD013, name, caught, Fixture::toy, move |urdd| {
                    urdd.urdf_replace(FRAME, &format!("{FRAME}{xml}"));
                    set_link(urdd, "frame", "/inertial", said.clone());
                })
            },
        )
    });
    rows.collect()
}

fn trees() -> Vec<Case> {
    vec![
        faulty(URD002, "two-links-of-one-name", |robot| {
            robot.link_mut("still").name = "lock".to_owned();
            robot.joint_mut("frozen").child.link = "lock".to_owned();
        }),
        invalid(URD002, "in-the-module-alone", |urdd| {
            set_link(urdd, "still", "/name", json!("lock"));
        }),
        invalid(URD002, "of-a-link-with-shapes-and-edits", |urdd| {
            set_link(urdd, "tool/ü 1", "/name", json!("arm"));
        }),
        sound(URD002, "names-that-differ-in-case", |robot| {
            robot.link_mut("still").name = "Lock".to_owned();
            robot.joint_mut("frozen").child.link = "Lock".to_owned();
        }),
        faulty(URD003, "two-joints-of-one-name", |robot| {
            robot.joint_mut("spin").name = "plane".to_owned();
        }),
        sound(URD003, "a-joint-with-the-name-of-a-link", |robot| {
            robot.joint_mut("spin").name = "wheel".to_owned();
        }),
        faulty(URD004, "two-roots", |robot| {
            robot.urdf.links.push(link("alone"));
        }),
        faulty(URD004, "no-links", |robot| {
            robot.urdf.links.clear();
            robot.urdf.joints.clear();
        }),
        invalid(URD004, "joint-left-out-of-the-module", |urdd| {
            let pointer = joint_pointer(urdd, "frozen", "");
            urdd.remove("urdf_module", &pointer);
        }),
        changed(
            URD004,
            "one-link-and-no-joint",
            false,
            || {
                let mut robot = Robot::new("one");
                robot.urdf.links.push(link("only"));
                Fixture::core(&robot)
            },
            |_| {},
        ),
        faulty(URD005, "link-held-by-two-joints", |robot| {
            robot.joint_mut("bolt").child.link = "puck".to_owned();
        }),
        sound(URD005, "two-joints-on-one-parent", |robot| {
            robot.joint_mut("bolt").parent.link = "puck".to_owned();
        }),
        faulty(URD006, "circle-beside-the-root", |robot| {
            robot.joint_mut("turn").parent.link = "arm".to_owned();
        }),
        faulty(URD006, "link-on-itself", |robot| {
            robot.joint_mut("air").parent.link = "drone".to_owned();
        }),
        faulty(URD006, "no-root-at-all", |robot| {
            let mut closing = robot.joint_mut("bolt").clone();
            closing.name = "closing".to_owned();
            closing.parent.link = "1:30".to_owned();
            closing.child.link = "base".to_owned();
            robot.urdf.joints.push(closing);
        }),
        sound(URD006, "deep-and-turned-round", |robot| {
            robot.joint_mut("bolt").parent.link = "eye".to_owned();
            robot.urdf.joints.reverse();
        }),
        faulty(URD007, "unknown-parent", |robot| {
            robot.joint_mut("bolt").parent.link = "Base".to_owned();
        }),
        invalid(URD007, "link-renamed-without-its-joints", |urdd| {
            set_link(urdd, "wheel", "/name", json!("wheel_left"));
        }),
        sound(URD007, "names-with-every-kind-of-character", |robot| {
            let name = " a&b <\"c'> %20\u{a0}日 ";
            robot.link_mut("still").name = name.to_owned();
            robot.joint_mut("frozen").child.link = name.to_owned();
        }),
    ]
}

fn mimic(joint: &str) -> Option<Mimic> {
    Some(Mimic { joint: joint.to_owned(), multiplier: None, offset: None })
}

fn axis(xyz: [f64; 3]) -> Option<Axis> {
    Some(Axis { xyz: Some(xyz) })
}

fn mimics_and_axes() -> Vec<Case> {
    vec![
        faulty(URD008, "driver-missing", |robot| {
            robot.joint_mut("frozen").mimic = mimic("Bolt");
        }),
        sound(URD008, "on-a-fixed-joint-without-meaning", |robot| {
            robot.joint_mut("flange").mimic = mimic("nowhere");
        }),
        faulty(URD009, "two-that-follow-each-other", |robot| {
            robot.joint_mut("left").mimic = mimic("right");
        }),
        faulty(URD009, "one-that-follows-itself", |robot| {
            robot.joint_mut("right").mimic = mimic("right");
        }),
        sound(URD009, "a-fixed-joint-of-itself", |robot| {
            robot.joint_mut("flange").mimic = mimic("flange");
            robot.joint_mut("bolt").mimic = mimic("frozen");
        }),
        faulty(URD010, "revolute-about-nothing", |robot| {
            robot.joint_mut("turn").axis = axis([0.0, -0.0, 0.0]);
        }),
        // The square of the first is not a normal number, that of the second is.
        faulty(URD010, "squared-length-subnormal", |robot| {
            robot.joint_mut("turn").axis = axis([0.0, 0.0, 1.4e-154]);
        }),
        sound(URD010, "squared-length-barely-normal", |robot| {
            robot.joint_mut("turn").axis = axis([0.0, 0.0, 1.5e-154]);
        }),
        faulty(URD010, "planar-without-a-plane", |robot| {
            robot.joint_mut("plane").axis = axis([0.0; 3]);
        }),
        sound(URD010, "axes-that-are-not-used", |robot| {
            for joint in ["flange", "air", "socket/ü"] {
                robot.joint_mut(joint).axis = axis([0.0; 3]);
            }
            robot.joint_mut("turn").axis = axis([0.0, 1e-9, 0.0]);
        }),
        faulty(URD012, "planar-mimic", |robot| {
            robot.joint_mut("plane").mimic = mimic("turn");
        }),
        faulty(URD012, "mimic-of-a-floating-joint", |robot| {
            robot.joint_mut("frozen").mimic = mimic("air");
        }),
        sound(URD012, "mimic-of-a-continuous-joint", |robot| {
            robot.joint_mut("frozen").mimic = mimic("spin");
        }),
    ]
}

fn readable() -> Vec<Case> {
    vec![
        invalid(URD011, "not-closed", |urdd| urdd.urdf_replace("</robot>", "")),
        invalid(URD011, "another-root", |urdd| {
            urdd.urdf_mut(|xml| *xml = "<sdf version=\"1.7\"/>".to_owned());
        }),
        invalid(URD011, "entities-of-its-own", |urdd| {
            urdd.urdf_replace("<!--", "<!DOCTYPE robot [<!ENTITY a \"0\">]><!--");
        }),
        invalid(URD011, "word-among-numbers", |urdd| {
            urdd.urdf_replace("xyz=\"0.05 0 0.2\"", "xyz=\"0.05 x 0 0.2\"");
        }),
        invalid(URD011, "two-rotations", |urdd| {
            urdd.urdf_replace("quat_xyzw=", "rpy=\"0 0 0\" quat_xyzw=");
        }),
        invalid(URD011, "quaternion-of-three", |urdd| {
            urdd.urdf_replace("quat_xyzw=\"0 ", "quat_xyzw=\"");
        }),
        invalid(URD011, "commas", |urdd| {
            urdd.urdf_replace("xyz=\"0.05 0 0.2\"", "xyz=\"0.05, 0, 0.2\"");
        }),
        invalid(URD011, "xacro-not-run", |urdd| {
            urdd.urdf_replace("damping=\"0.1\"", "damping=\"${damping}\"");
        }),
        invalid(URD011, "unknown-joint-type", |urdd| {
            urdd.urdf_replace("type=\"spherical\"", "type=\"ball\"");
        }),
        invalid(URD011, "joint-without-a-child", |urdd| {
            urdd.urdf_replace("<child link=\"still\"/>", "");
        }),
        invalid(URD011, "mesh-without-a-file", |urdd| {
            urdd.urdf_replace("<mesh filename=", "<mesh file=");
        }),
        invalid(URD011, "joint-type-in-capitals", |urdd| {
            urdd.urdf_replace("type=\"spherical\"", "type=\"Spherical\"");
        }),
        invalid(URD011, "no-break-space-between-numbers", |urdd| {
            urdd.urdf_replace("xyz=\"0.05 0 0.2\"", "xyz=\"0.05\u{a0}0 0.2\"");
        }),
        invalid(URD011, "empty-number", |urdd| {
            urdd.urdf_replace("damping=\"0.1\"", "damping=\"\"");
        }),
        invalid(URD011, "prefix-not-declared", |urdd| {
            urdd.urdf_replace("<gazebo/>", "<sensor:camera/>");
        }),
        invalid(URD011, "xml-version-0.0", |urdd| {
            urdd.urdf_replace("<?xml version=\"1.0\"", "<?xml version=\"0.0\"");
        }),
        invalid(URD011, "another-encoding-declared", |urdd| {
            urdd.urdf_replace("encoding=\"utf-8\"", "encoding=\"ISO-8859-1\"");
        }),
        invalid(URD011, "reference-to-half-a-character", |urdd| {
            urdd.urdf_replace("<robot ", "<robot q=\"&#xD800;\" ");
        }),
        invalid(URD011, "prefix-of-no-namespace", |urdd| {
            urdd.urdf_replace("<robot ", "<robot xmlns:q=\"\" ");
        }),
        invalid(URD011, "name-that-begins-with-a-colon", |urdd| {
            urdd.urdf_replace("<robot ", "<robot :c=\"1\" ");
        }),
        invalid(URD011, "parameter-entity-reference", |urdd| {
            urdd.urdf_replace("<!--", "<!DOCTYPE robot [%a;]><!--");
        }),
        near_miss(URD011, "entity-in-a-comment", |urdd| {
            urdd.urdf_replace("<!--", "<!DOCTYPE robot [<!-- <!ENTITY a \"0\"> -->]><!-- &#0; ");
        }),
        near_miss(URD011, "utf-8-declared-otherwise", |urdd| {
            urdd.urdf_replace("encoding=\"utf-8\"", "encoding='UTF8'");
        }),
        // 13,000 levels once aborted the whole run.
        invalid(URD011, "elements-too-deep", |urdd| {
            let deep = format!("{}{}", "<a>".repeat(20_000), "</a>".repeat(20_000));
            urdd.urdf_replace("<gazebo/>", &deep);
        }),
        // A version is two decimal numbers.
        changed(
            URD011,
            "two-rotations-in-a-version-with-a-sign",
            false,
            || {
                let mut robot = toy_robot();
                robot.urdf.version = Some("+1.1".to_owned());
                let origin = &mut robot.joint_mut("bolt").origin;
                origin.as_mut().expect("it has").rpy = Some([0.1, 0.2, 0.3]);
                Fixture::core(&robot)
            },
            |_| {},
        ),
        near_miss(URD001, "version-of-many-digits", |urdd| {
            let version = "1.1000000000000000000001";
            urdd.urdf_replace(" version=\"1.2\"", &format!(" version=\"{version}\""));
            urdd.set("urdf_module", "/version", json!(version));
        }),
        invalid(URD011, "latin-1", |urdd| {
            let bytes = urdd.files.get_mut(URDF).expect("the URDF");
            bytes.extend(b"<!-- \xfc -->");
        }),
        near_miss(URD011, "byte-order-mark-and-document-type", |urdd| {
            urdd.urdf_replace("<!--", "<!DOCTYPE robot><!--");
            urdd.urdf_mut(|xml| xml.insert(0, '\u{feff}'));
        }),
        changed(
            URD011,
            "two-rotations-before-1.1",
            false,
            || {
                let mut robot = toy_robot();
                robot.urdf.version = None;
                let origin = &mut robot.joint_mut("bolt").origin;
                origin.as_mut().expect("it has").rpy = Some([0.1, 0.2, 0.3]);
                Fixture::core(&robot)
            },
            |_| {},
        ),
        near_miss(URD011, "elements-that-say-nothing", |urdd| {
            urdd.urdf_replace("<link name=\"frame\">\n", "<link name=\"frame\"><!-- <link/> -->\n");
            urdd.urdf_replace("<color ", "<texture/><color ");
        }),
    ]
}

/// A legacy URDD of a URDF and its `urdf_module`.
fn legacy_urdd(root: &Path, inertial_of_a: &Value, axis: &Value) {
    let urdf = "<robot name='old'><link name='a'/><link name='b'><inertial><mass value='1'/><inertia ixx='1' \
        ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial><visual><geometry><sphere radius='0.1'/></geometry>\
        <material/></visual></link><joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint><gazebo/></robot>";
    let origin = json!({"xyz": [0.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]});
    let document = json!({
        "name": "old",
        "links": [
            {"name": "a", "inertial": inertial_of_a, "visual": [], "collision": []},
            {"name": "b", "inertial": inertial(1.0), "visual": [{"name": null, "origin": origin,
                "geometry": {"Sphere": {"radius": 0.1}}, "material": {"name": "", "color": null, "texture": null}}],
                "collision": []},
        ],
        "joints": [{"name": "j", "joint_type": "Fixed", "origin": origin, "parent": {"link": "a"}, "child": {"link": "b"},
            "axis": {"xyz": axis}, "limit": {"lower": 0.0, "upper": 0.0, "effort": 0.0, "velocity": 0.0},
            "dynamics": null, "mimic": null, "safety_controller": null}],
        "materials": [],
    });
    let folder = root.join("urdf_module");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::write(root.join("robot.urdf"), urdf).expect("the URDF");
    std::fs::write(folder.join("VERSION"), "0.0.3").expect("VERSION");
    std::fs::write(folder.join("module.json"), document.to_string()).expect("the document");
    let yaml = urdd_directory::canonical::yaml_string(&document);
    std::fs::write(folder.join("module.yaml"), yaml).expect("its mirror");
}

fn inertial(size: f64) -> Value {
    json!({"origin": {"xyz": [0.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]}, "mass": {"value": size},
        "inertia": {"ixx": size, "ixy": 0.0, "ixz": 0.0, "iyy": size, "iyz": 0.0, "izz": size}})
}

fn legacy() -> Vec<Case> {
    vec![
        in_folder(URD001, "legacy-conventions", false, |root| {
            legacy_urdd(root, &inertial(0.0), &json!([0.0, 0.0, 0.0]));
        }),
        in_folder(URD001, "legacy-conventions-of-later", false, |root| {
            legacy_urdd(root, &inertial(0.0), &json!([1.0, 0.0, 0.0]));
        }),
        in_folder(URD013, "legacy-inertial-made-up", true, |root| {
            legacy_urdd(root, &inertial(2.0), &json!([1.0, 0.0, 0.0]));
        }),
    ]
}
