//! URDFs as found in the wild, and worse: the result for each, and the messages.

use std::fmt::Write;
use std::fs;

use urdd_generate::note::NoteKind;
use urdd_generate::{Settings, generate};

use crate::generate::{findings_of, read_json};

/// Two links with this text between them.
fn two_links(between: &str) -> Vec<u8> {
    format!("<robot name=\"r\">\n  <link name=\"a\"/>\n  <link name=\"b\"/>\n{between}\n</robot>\n")
        .into_bytes()
}

fn joint(kind: &str, inside: &str) -> Vec<u8> {
    two_links(&format!(
        "  <joint name=\"j\" type=\"{kind}\">\n    <parent link=\"a\"/>\n    <child link=\"b\"/>\n    {inside}\n  </joint>"
    ))
}

fn link(inside: &str) -> Vec<u8> {
    format!("<robot name=\"r\">\n  <link name=\"a\">\n    {inside}\n  </link>\n</robot>\n")
        .into_bytes()
}

fn text(text: &str) -> Vec<u8> {
    text.as_bytes().to_vec()
}

fn utf16(text: &str) -> Vec<u8> {
    let units = text.encode_utf16().flat_map(u16::to_le_bytes);
    [0xff, 0xfe].into_iter().chain(units).collect()
}

const LIMITS: &str = "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";

/// The name of each, and its bytes.
fn cases() -> Vec<(&'static str, Vec<u8>)> {
    let with_limits = |more: &str| joint("revolute", &format!("{LIMITS}{more}"));
    let shape = |shape: &str| link(&format!("<visual><geometry>{shape}</geometry></visual>"));
    vec![
        // Not a robot.
        ("empty file", Vec::new()),
        ("white space only", text(" \n\n")),
        ("no XML", text("this is not a robot\n")),
        ("binary", (0..=255).cycle().take(4000).collect()),
        ("cut off", text("<robot name=\"r\">\n  <link name=\"a\">\n    <visual>")),
        ("wrong end tag", text("<robot name=\"r\">\n  <link name=\"a\"></lnk>\n</robot>")),
        ("unescaped ampersand", text("<robot name=\"a & b\"><link name=\"a\"/></robot>")),
        ("attribute twice", text("<robot name=\"r\"><link name=\"a\" name=\"b\"/></robot>")),
        ("comment with two dashes", text("<robot name=\"r\"><!-- a -- b --><link name=\"a\"/></robot>")),
        ("two robots", text("<robot name=\"r\"><link name=\"a\"/></robot>\n<robot name=\"s\"/>")),
        ("SDF", text("<sdf version=\"1.6\"><model name=\"m\"/></sdf>")),
        ("MuJoCo", text("<mujoco model=\"m\"/>")),
        ("another root element", text("<html><body/></html>")),
        ("entities", text("<!DOCTYPE robot [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]>\n<robot name=\"&b;\"><link name=\"a\"/></robot>")),
        ("file entity", text("<!DOCTYPE robot [<!ENTITY a SYSTEM \"file:///etc/passwd\">]>\n<robot name=\"&a;\"><link name=\"a\"/></robot>")),
        ("no links", text("<robot name=\"r\">\n</robot>\n")),
        ("a link without name", text("<robot name=\"r\">\n  <link/>\n</robot>\n")),
        ("a joint without type", two_links("  <joint name=\"j\"><parent link=\"a\"/><child link=\"b\"/></joint>")),
        ("a joint without parent", two_links("  <joint name=\"j\" type=\"fixed\"><child link=\"b\"/></joint>")),
        ("a joint without child link", two_links("  <joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child/></joint>")),
        ("an unknown joint type", joint("screw", "")),
        ("an unknown link", two_links("  <joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"c\"/></joint>")),
        ("a link of other case", two_links("  <joint name=\"j\" type=\"fixed\"><parent link=\"A\"/><child link=\"b \"/></joint>")),
        ("two links of one name", text("<robot name=\"r\">\n  <link name=\"a\"/>\n  <link name=\"a\"/>\n</robot>\n")),
        ("two joints of one name", text("<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\n<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint>\n<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"c\"/></joint></robot>")),
        ("two roots", two_links("")),
        ("two parents", text("<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\n<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"c\"/></joint>\n<joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"c\"/></joint></robot>")),
        ("a circle", text("<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\n<joint name=\"j\" type=\"fixed\"><parent link=\"b\"/><child link=\"c\"/></joint>\n<joint name=\"k\" type=\"fixed\"><parent link=\"c\"/><child link=\"b\"/></joint></robot>")),
        ("a link on itself", two_links("  <joint name=\"j\" type=\"fixed\"><parent link=\"b\"/><child link=\"b\"/></joint>")),
        ("an axis of zero", with_limits("<axis xyz=\"0 0 0\"/>")),
        ("a mimic of itself", with_limits("<mimic joint=\"j\"/>")),
        ("many faults", text(&format!("<robot name=\"r\">{}</robot>", "\n  <link/>".repeat(9)))),
        ("deeply nested", text(&format!("<robot name=\"r\">{}{}</robot>", "<a>".repeat(100_000), "</a>".repeat(100_000)))),
        ("only macros", text("<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n  <xacro:include filename=\"$(find r)/arm.xacro\"/>\n</robot>\n")),
        ("two rotations", text("<robot name=\"r\" version=\"1.1\">\n  <link name=\"a\"><visual><origin rpy=\"0 0 0\" quat_xyzw=\"0 0 0 1\"/></visual></link>\n</robot>\n")),
        // Still a robot.
        ("byte order mark", text("\u{feff}<?xml version=\"1.0\"?><robot name=\"r\"><link name=\"a\"/></robot>")),
        ("UTF-16", utf16("<?xml version=\"1.0\" encoding=\"UTF-16\"?><robot name=\"é\"><link name=\"a\"/></robot>")),
        ("Latin-1, declared", b"<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<robot name=\"\xe9\"><link name=\"a\"/></robot>".to_vec()),
        ("Latin-1 in a comment, not declared", b"<robot name=\"r\"><!-- \xe9 --><link name=\"a\"/></robot>".to_vec()),
        ("white space before the declaration", text("\n\n<?xml version=\"1.0\"?>\n<robot>\n  <link name=\"a\"/></robot>")),
        ("a version that is not one of XML", text("<?xml version=\"0.0\" ?>\n<robot name=\"r\"><link name=\"a\"/></robot>")),
        ("a prefix that is not declared", text("<robot name=\"r\">\n  <link name=\"a\"/>\n  <controller:x name=\"c\"><interface:y/></controller:x>\n</robot>")),
        ("a doctype", text("<!DOCTYPE robot>\n<robot name=\"r\"><link name=\"a\"/></robot>")),
        ("a default namespace", text("<robot name=\"r\" xmlns=\"http://example.org\"><link name=\"a\"/></robot>")),
        ("no robot name", text("<?xml version=\"1.0\"?>\n<robot>\n  <link name=\"a\"/>\n</robot>\n")),
        ("macros left over", text("<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n  <xacro:property name=\"p\" value=\"1\"/>\n  <link name=\"a\"><inertial><mass value=\"${p}\"/></inertial></link>\n</robot>\n")),
        ("no limits", joint("revolute", "")),
        ("a type of other case", joint(" Continuous", "")),
        ("a robot of other case", text("<Robot name=\"r\"/>")),
        ("attributes in upper case", joint("revolute", "<origin XYZ=\"0 0 1\" Rpy=\"0 0\"/><LIMIT lower=\"0\"/><limit Lower=\"-1\" upper=\"1\"/>")),
        ("a NUL byte after the end", text("<robot name=\"r\"><link name=\"a\"/></robot>\n\0")),
        ("a material that is nowhere", link("<visual><geometry><sphere radius=\"1\"/></geometry><material name=\"m\"/></visual>")),
        ("two numbers for three", with_limits("<origin xyz=\"0 1\" rpy=\"0 0 0\"/>")),
        ("commas", with_limits("<origin xyz=\"0.5, 1, 2\"/>")),
        ("decimal commas", with_limits("<origin xyz=\"0,5 1,0 2,0\"/>")),
        ("a number with a unit", joint("revolute", "<limit lower=\"-90deg\" upper=\"1\" effort=\"1\" velocity=\"1\"/>")),
        ("an empty number", with_limits("<dynamics damping=\"\" friction=\"0\"/>")),
        ("infinite and no numbers", joint("revolute", "<limit lower=\"-inf\" upper=\"nan\" effort=\"1e999\" velocity=\"1\"/>")),
        ("one factor of a scale", shape("<mesh filename=\"a.stl\" scale=\"0.001\"/>")),
        ("a colour without opacity", link("<visual><geometry><sphere radius=\"1\"/></geometry><material name=\"m\"><color rgba=\"1 0 0\"/></material></visual>")),
        ("a material without name", link("<visual><geometry><sphere radius=\"1\"/></geometry><material><color rgba=\"1 0 0 1\"/></material></visual>")),
        ("a material in two ways", text("<robot name=\"r\">\n  <material name=\"m\"><color rgba=\"1 0 0 1\"/></material>\n  <link name=\"a\"/>\n  <material name=\"m\"><color rgba=\"0 1 0 1\"/></material>\n</robot>\n")),
        ("a mesh without file name", shape("<mesh/>")),
        ("a box without size", shape("<box/>")),
        ("a cylinder without length", shape("<cylinder radius=\"1\"/>")),
        ("a sphere of no number", shape("<sphere radius=\"big\"/>")),
        ("an infinite box", shape("<box size=\"inf 1 1\"/>")),
        ("two shapes", shape("<box size=\"1 1 1\"/><sphere radius=\"1\"/>")),
        ("a broken shape before a good one", shape("<mesh/><sphere radius=\"1\"/>")),
        ("a mesh that is not there", shape("<mesh filename=\"package://no_such_package/a.stl\"/>")),
        ("a mesh on the network", shape("<mesh filename=\"https://example.org/a.stl\"/>")),
        ("a mesh that is a folder", shape("<mesh filename=\"/\"/>")),
        ("a mesh of no name", shape("<mesh filename=\"\"/>")),
        ("a mimic of no joint", with_limits("<mimic joint=\"nobody\" multiplier=\"x\"/>")),
        ("a mimic without joint", with_limits("<mimic multiplier=\"2\"/>")),
        ("a floating mimic", two_links("  <joint name=\"j\" type=\"floating\"><parent link=\"a\"/><child link=\"b\"/><mimic joint=\"j\"/></joint>")),
        ("two axes", with_limits("<axis xyz=\"0 0 1\"/><axis xyz=\"1 0 0\"/>")),
        ("a quaternion before 1.1", with_limits("<origin rpy=\"0 0 1\" quat_xyzw=\"0 0 0 1\"/>")),
        ("a quaternion of no length", text("<robot name=\"r\" version=\"1.1\">\n  <link name=\"a\"><visual><origin quat_xyzw=\"0 0 0 0\"/></visual></link>\n</robot>\n")),
        ("numbers beyond reach", joint("prismatic", "<limit lower=\"-1e308\" upper=\"1e308\" effort=\"1\" velocity=\"1\"/><origin xyz=\"1e308 1e308 1e308\"/>")),
        ("slashes and unicode in names", text("<robot name=\"r/ö\"><link name=\"../ä/&#10;b\"/></robot>")),
    ]
}

/// Each is a robot that validates, with notes, or is rejected with a message. People review the messages here.
#[test]
fn each_has_its_message() {
    let mut told = String::new();
    for (name, bytes) in cases() {
        let folder = testkit::temporary::folder();
        let source = folder.path().join("robot.urdf");
        fs::write(&source, bytes).unwrap();
        let target = folder.path().join("out");
        let outcome = generate(&source, &target, &Settings::default(), &());
        let mut lines = String::new();
        match outcome {
            Ok(made) => {
                let odd: Vec<_> = findings_of(&target)
                    .into_iter()
                    .filter(|(code, severity, _)| severity == "error" || !code.starts_with("SRC"))
                    // A note reports it, and it is only a recommendation.
                    .filter(|(code, _, _)| code != "KIN005")
                    .collect();
                assert_eq!(odd, [], "{name}: findings on what was made");
                let of_collisions = [NoteKind::GeometryTaken, NoteKind::SkippedContact];
                let notes = made.notes.iter().filter(|note| !of_collisions.contains(&note.kind));
                let notes: Vec<_> = notes.collect();
                for note in &notes {
                    writeln!(lines, "  note: {note}").unwrap();
                }
                if notes.is_empty() {
                    lines.push_str("  made\n");
                }
                let metadata = read_json(&target.join("urdd.json"));
                let carried = metadata["source"]["Urdf"]["path"].as_str().unwrap();
                let is_verbatim =
                    fs::read(target.join(carried)).unwrap() == fs::read(&source).unwrap();
                let found = target.join(format!("{carried}.as-found"));
                assert_eq!(is_verbatim, !found.exists(), "{name}: what was found is carried too");
                if !is_verbatim {
                    lines.push_str("  (a repaired URDF is carried)\n");
                    assert_eq!(fs::read(found).unwrap(), fs::read(&source).unwrap(), "{name}");
                }
            }
            Err(error) => {
                assert!(!target.exists(), "{name}: refused, and something was written");
                for line in error.to_string().lines() {
                    writeln!(lines, "  refused: {line}").unwrap();
                }
            }
        }
        let left = fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(left, 1 + usize::from(target.exists()), "{name}: left-overs");
        let here = folder.path().canonicalize().unwrap().display().to_string();
        write!(told, "{name}\n{}", lines.replace(&here, "DIR")).unwrap();
    }
    insta::assert_snapshot!(told);
}
