//! One table of hostile texts: in every place where a URDF, a URDD or an `export.toml` may hold text, through every
//! format. Whatever a text is, each file has the structure that a harmless text gives it, and where programs expand a file
//! before they read it, they get the text back. `tests/figures/exports/texts.py` asks these programs.
#![cfg(unix)]

use std::collections::BTreeSet;
use std::path::PathBuf;

use serde_json::Value;
use urdd_export::{ActuatorKind, Choices, Export, ExportError, Format, Note, Setup};
use urdd_robot::Robot;
use urdd_xml::Node;

use crate::program::urdd;
use testkit::trials::sample;
use testkit::xml::parsed;

/// Exports a robot with what a person chose, which fits the format.
fn export(robot: &Robot, format: Format, choices: &Choices) -> Result<Export, ExportError> {
    urdd_export::export(robot, &choices.options(format).expect("options of the format"))
}

/// Each text that a URDF may hold is a place, which begins with `Place`.
const URDF: &str = include_str!("texts.urdf");

const SETUP: &str = r#"robot = "PlaceRobot"
[[group]]
name = "PlaceGroup"
base = "PlaceBase"
tip = "PlaceTip"
[[group]]
name = "PlaceHand"
joints = ["PlaceFinger"]
[[group]]
name = "PlaceBoth"
groups = ["PlaceGroup", "PlaceHand"]
[[end_effector]]
name = "PlaceEnd"
group = "PlaceHand"
parent_group = "PlaceGroup"
parent_link = "PlaceTip"
[base]
poses."PlacePose" = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[frames]
tools = ["PlaceTip"]
imus = ["PlaceMiddle"]
[actuators.joint."PlaceJoint"]
kp = 100.0
[curobo]
ee_link = "PlaceTip"
retract = "PlacePose"
locked = { "PlaceFinger" = 0.01 }
"#;

/// What every place and format takes: what differs from it is the text's doing.
const HARMLESS: &str = "Harmless";

/// What a text would have to be to become code, markup or another place of its file.
pub(crate) fn texts() -> Vec<String> {
    let texts = include_str!("texts.json");
    let mut texts: Vec<String> = serde_json::from_str(texts).expect("texts");
    texts.push("x".repeat(2_000));
    texts
}

/// A URDD of [`URDF`], and other texts in its places.
pub(crate) struct Table {
    _folder: tempfile::TempDir,
    pub(crate) path: PathBuf,
    documents: Vec<(PathBuf, Value)>,
}

impl Table {
    pub(crate) fn new() -> Table {
        let folder = testkit::temporary::folder();
        let write = |file: &str, text: &str| {
            std::fs::write(folder.path().join(file), text).expect("a file")
        };
        write("robot.urdf", &URDF.replace("PlaceMesh", "PlaceMesh.stl"));
        write("PlaceMesh.stl", include_str!("texts.stl"));
        for command in [
            &["generate", "robot.urdf", "-o", "robot"][..],
            &["configurations", "set", "robot", "PlacePose", "PlaceJoint=0.1"],
        ] {
            let (status, _, said) = urdd(command, folder.path());
            assert_eq!(status, 0, "{said}");
        }
        let path = folder.path().join("robot");
        let files = testkit::files::below(&path).into_iter();
        let files = files.filter(|(file, _)| file.ends_with(".json"));
        let documents = files
            .map(|(file, bytes)| (path.join(file), serde_json::from_slice(&bytes).expect("JSON")));
        let mut documents: Vec<(PathBuf, Value)> = documents.collect();
        for (_, document) in &mut documents {
            each_text(document, &mut |text| *text = text.replace("PlaceMesh.stl", "PlaceMesh"));
            if let Some(edits) = document.get_mut("edits") {
                *edits = serde_json::json!([{ "link_a": "PlaceBase", "link_b": "PlaceMiddle", "skip": true, "reason": "PlaceReason" }]);
            }
        }
        Table { _folder: folder, path, documents }
    }

    /// A copy of the URDD as it is.
    pub(crate) fn copy(&self) -> tempfile::TempDir {
        let folder = testkit::temporary::folder();
        for (file, bytes) in testkit::files::below(&self.path) {
            let target = folder.path().join(file);
            std::fs::create_dir_all(target.parent().expect("a folder")).expect("a folder");
            std::fs::write(target, bytes).expect("a file");
        }
        folder
    }

    /// The places: those of the URDF and of the setup, and each other text of a document.
    pub(crate) fn places(&self) -> BTreeSet<String> {
        let words = [URDF, SETUP].map(|text| text.split(|c: char| !c.is_ascii_alphanumeric()));
        let words = words.into_iter().flatten().filter(|word| word.starts_with("Place"));
        let mut places: BTreeSet<String> = words.map(str::to_owned).collect();
        for (_, document) in &self.documents {
            each_text(&mut document.clone(), &mut |text| {
                if !text.contains("Place") {
                    places.insert(text.clone());
                }
            });
        }
        places
    }

    /// The robot and what belongs to it, with a text in a place; an error where the text cannot be there.
    pub(crate) fn with(&self, place: &str, text: &str) -> Result<(Robot, Setup), String> {
        for (path, document) in &self.documents {
            let mut document = document.clone();
            each_text(&mut document, &mut |found| *found = replaced(found, place, text));
            std::fs::write(path, document.to_string()).map_err(|error| error.to_string())?;
        }
        let robot = Robot::open(&self.path).map_err(|error| error.to_string())?;
        let escaped: String = text.chars().map(|c| format!("\\U{:08X}", u32::from(c))).collect();
        let setup = SETUP.replace(&format!("\"{place}\""), &format!("\"{escaped}\""));
        let setup = Setup::from_toml(&setup, "x", &robot).map_err(|error| error.to_string())?;
        Ok((robot, setup))
    }
}

fn each_text(value: &mut Value, change: &mut dyn FnMut(&mut String)) {
    match value {
        Value::String(text) => change(text),
        Value::Array(values) => values.iter_mut().for_each(|value| each_text(value, change)),
        Value::Object(entries) => {
            *entries = std::mem::take(entries)
                .into_iter()
                .map(|(mut key, mut value)| {
                    if key.starts_with("Place") {
                        change(&mut key);
                    }
                    each_text(&mut value, change);
                    (key, value)
                })
                .collect();
        }
        _ => {}
    }
}

/// A text of a document with another text in a place, which is all of it, or in XML.
fn replaced(found: &str, place: &str, text: &str) -> String {
    if found == place || (place == "PlaceWhole" && found == "<whole>PlaceWhole</whole>") {
        return text.to_owned();
    }
    if !found.starts_with('<') || !found.contains(place) {
        return found.to_owned();
    }
    let in_xml = match place {
        "PlaceData" => text.replace("]]>", "]]]]><![CDATA[>"),
        "PlaceComment" => text.replace("--", "- "),
        "PlaceMarkup" => text.to_owned(),
        _ => urdd_xml::escape(text)
            .replace('\t', "&#9;")
            .replace('\n', "&#10;")
            .replace('\r', "&#13;"),
    };
    found.replace(place, &in_xml)
}

fn options(format: Format, setup: Setup) -> Choices {
    let is_mjcf = format == Format::Mjcf;
    Choices {
        setup: Some(setup),
        spheres: Some(1),
        samples: 100,
        // With all that an option adds.
        robot_file: (format == Format::Curobo).then(|| "robot.urdf".to_owned()),
        package: (format == Format::Drake).then(|| "r_description".to_owned()),
        output: Some("robot.file".into()),
        mesh_folder: (format != Format::Moveit).then(|| "meshes".to_owned()),
        actuators: (is_mjcf || format == Format::Usd).then_some(ActuatorKind::Position),
        sensors: is_mjcf,
        scene: is_mjcf,
        ..Choices::default()
    }
}

/// The files of an export, by path. Where a format has a file of its own, that comes first.
fn files(format: Format, made: &Export) -> Vec<(String, String)> {
    let own = made.path.clone().unwrap_or_else(|| match format {
        Format::Srdf => "robot.srdf".to_owned(),
        Format::Urdf
        | Format::Drake
        | Format::Spherized
        | Format::UrdfPlus
        | Format::ExtendedUrdf => "robot.urdf".to_owned(),
        Format::Mjcf => "robot.xml".to_owned(),
        Format::Sdf => "robot.sdf".to_owned(),
        Format::Curobo => "robot.yml".to_owned(),
        Format::Foam => "robot.json".to_owned(),
        Format::Usd => "robot.usda".to_owned(),
        Format::Moveit => panic!("MoveIt's is a folder"),
    });
    let report = ("report.json".to_owned(), made.report.clone());
    let mut files = vec![(own, made.text.clone()), report];
    for (path, bytes) in &made.files {
        match path.rsplit('.').next() {
            Some("stl" | "obj" | "png" | "jpg") => {}
            _ => files.push((path.clone(), String::from_utf8(bytes.clone()).expect("text"))),
        }
    }
    files
}

/// The file of a path, or, where a robot's name is in the path, the one of its kind with another name.
fn counterpart<'f>(files: &'f [(String, String)], path: &str) -> (&'f str, &'f str) {
    let ending = |path: &str| path.rsplit('.').next().map(str::to_owned);
    let same = files.iter().find(|(of, _)| of == path);
    let (path, text) = same
        .or_else(|| files.iter().find(|(of, _)| ending(of) == ending(path)))
        .unwrap_or_else(|| panic!("no file for {path}"));
    (path, text)
}

/// The structure of a file, by a reader of its kind: what is the same whatever the texts are.
fn structure(path: &str, text: &str) -> Vec<String> {
    match path.rsplit('.').next().expect("an ending") {
        "urdf" | "srdf" | "sdf" | "xml" => {
            let document = parsed(text);
            assert!(
                document
                    .root_element()
                    .parent()
                    .expect("a root")
                    .children()
                    .all(|node| !node.is_pi()),
                "{text}"
            );
            let elements = document.descendants().filter(Node::is_element);
            elements
                .map(|node| {
                    let keys: Vec<&str> = node.attributes().map(|of| of.name()).collect();
                    format!("{} {} {keys:?}", node.ancestors().count(), node.tag_name().name())
                })
                .collect()
        }
        "usda" => testkit::usda::parsed(text).structure(),
        "yaml" | "yml" | "rviz" => vec![shape(&serde_yaml::from_str(text).expect("YAML"))],
        "json" => {
            let read: Value = serde_json::from_str(text).expect("JSON");
            // A list of notes has one for each thing that was left out.
            vec![if path == "report.json" { String::new() } else { shape(&read) }]
        }
        // The values of the launch file are literals, each on a line of its own.
        "py" => text
            .lines()
            .map(|line| match line.split_once(" = ") {
                Some((name, value))
                    if serde_json::from_str::<Value>(&value.replace("\\U", "\\\\U")).is_ok() =>
                {
                    name.to_owned()
                }
                _ => line.to_owned(),
            })
            .collect(),
        "txt" => text.lines().map(str::to_owned).collect(),
        other => panic!("{path}: say how a `.{other}` is read, in this table and in texts.py"),
    }
}

/// The shape of a document: types, and how many entries there are.
fn shape(value: &Value) -> String {
    let mut inner: Vec<String> = match value {
        Value::Array(values) => values.iter().map(shape).collect(),
        Value::Object(entries) => entries.values().map(shape).collect(),
        Value::String(_) => return "text".to_owned(),
        _ => return "value".to_owned(),
    };
    inner.sort();
    format!("{}{inner:?}", if value.is_array() { "list" } else { "map" })
}

/// Whether all of a structure is in another one, in any order: a transmission of ours may stand for one that was left out.
fn is_part(of: &[String], all: &[String]) -> bool {
    let count = |lines: &[String], line: &String| lines.iter().filter(|of| *of == line).count();
    of.iter().all(|line| count(of, line) <= count(all, line))
}

/// What xacro 2 makes of a text; `None` if it would evaluate something that is not ours, or refuse it.
fn expanded(text: &str) -> Option<String> {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('$') {
        out += &rest[..at];
        let from = &rest[at..];
        let after = from.trim_start_matches('$');
        let count = from.len() - after.len();
        if count > 1 && after.starts_with(['{', '(']) {
            out += &from[1..count + 1];
            rest = &after[1..];
        } else if let Some(after) = from.strip_prefix("${'$'}") {
            out.push('$');
            rest = after;
        } else if count == 1 && !after.starts_with(['{', '(']) {
            out.push('$');
            rest = after;
        } else {
            return None;
        }
    }
    Some(out + rest)
}

/// The elements of a robot with all of their texts, as `read` gives them; without meshes, which have places of their own, and
/// without hardware, since MoveIt has ours.
fn meant(robot: &str, read: fn(&str) -> Option<String>) -> Vec<String> {
    let document = urdd_xml::parse(robot, urdd_xml::Kind::Other).expect("XML");
    let elements = document.descendants().filter(Node::is_element);
    let is_hardware = |node: &Node| node.ancestors().any(|one| one.has_tag_name("ros2_control"));
    let elements = elements.filter(|node| !node.has_tag_name("mesh") && !is_hardware(node));
    let text = |text: &str| read(text).unwrap_or_else(|| panic!("evaluated: {text:?}"));
    elements
        .map(|node| {
            let namespaces = node.namespaces().filter(|of| of.name() != Some("xml"));
            let attributes =
                node.attributes().map(|of| format!("{}={}", of.name(), text(of.value())));
            let children = node.children().filter(Node::is_text).filter_map(|node| node.text());
            format!(
                "{} {:?} {:?} {:?}",
                node.tag_name().name(),
                namespaces.map(|of| text(of.uri())).collect::<BTreeSet<_>>(),
                attributes.collect::<BTreeSet<_>>(),
                children.map(text).collect::<String>().trim()
            )
        })
        .collect()
}

fn is_left_out(made: &Export) -> bool {
    made.notes.iter().any(|note| matches!(note, Note::Elements(_)))
}

#[test]
fn every_text_in_every_place_stays_a_text_in_every_format() {
    let table = Table::new();
    let made = |place: &str, text: &str, format: Format| {
        let (robot, setup) = table.with(place, text).ok()?;
        Some(export(&robot, format, &options(format, setup)))
    };
    let harmless =
        |format: Format| made("no place", HARMLESS, format).expect("a robot").expect("an export");
    let harmless: Vec<Export> = Format::ALL.iter().map(|format| harmless(*format)).collect();
    let places = table.places();
    assert!(places.len() > 60, "{places:?}");
    // Texts of ours, such as a hash, meet fewer. Primes, so that each place meets each text sooner or later.
    let cases = |is_named: bool, step: u32| {
        let places = places.iter().filter(move |place| place.starts_with("Place") == is_named);
        sample(places.flat_map(|place| texts().into_iter().map(move |text| (place, text))), step)
    };
    let mut held = BTreeSet::new();
    for (place, text) in cases(true, 53).chain(cases(false, 3989)) {
        // Markup may be any; a version or a shape's name that XML cannot hold is left out; and a module with another
        // text where it has no names may not be there for the export.
        let is_free = ["PlaceMarkup", "PlaceWhole"].contains(&place.as_str())
            || (["PlaceVersion", "PlaceVisual", "PlaceCollision"].contains(&place.as_str())
                && text.contains(['\u{1b}', '\u{fffe}']))
            || !place.starts_with("Place");
        let Ok((robot, setup)) = table.with(place, &text) else { continue };
        let mut plain = None;
        for (&format, harmless) in Format::ALL.iter().zip(&harmless) {
            let at = format!("{format:?}, {place}: {text:?}");
            let made = match export(&robot, format, &options(format, setup.clone())) {
                Ok(made) => made,
                Err(ExportError::Name { name, .. }) => {
                    assert!(name.contains(&*text), "{at}: refuses {name:?}");
                    continue;
                }
                // Not a name: the module is no longer one, which its reader says.
                Err(_) => continue,
            };
            held.insert((place.clone(), format.name()));
            let all = files(format, &made);
            assert_eq!(made.files.len(), harmless.files.len(), "{at}");
            let is_left_out = is_left_out(&made);
            // A `<ros2_control>` that is no XML is none, for which no note says that ours replaces it.
            let is_ours = is_left_out
                && ["PlaceControl", "PlaceHardware", "PlaceParameter", "PlaceValue"]
                    .contains(&place.as_str());
            for (expected_path, expected) in &files(format, harmless) {
                let (path, text) = counterpart(&all, expected_path);
                let file = path.strip_prefix("meshes/").unwrap_or(path);
                assert!(file.split('/').all(|part| !part.starts_with(['.', '-'])), "{at}: {path}");
                let [found, expected] = [structure(path, text), structure(expected_path, expected)];
                let is_same = match is_left_out {
                    true => is_part(&found, &expected),
                    false => found == expected,
                };
                assert!(is_same || is_free || is_ours, "{at}: {path}\n{text}");
                if matches!(format, Format::Moveit | Format::Curobo) && path != "report.json" {
                    let begins = ["{{", "{%", "{#"].iter().find(|begin| text.contains(**begin));
                    assert_eq!(begins, None, "{at}: {path}\n{text}");
                    let acts = text
                        .chars()
                        .find(|c| super::super::printing::acts(*c) && !"\t\n".contains(*c));
                    assert_eq!(acts, None, "{at}: {path}\n{text}");
                }
            }
            match format {
                Format::Urdf => plain = Some(made),
                Format::Moveit if !is_left_out => {
                    let urdf =
                        all.iter().find(|(path, _)| path.ends_with(".urdf")).expect("a URDF");
                    let plain = plain.as_ref().expect("a URDF");
                    assert_eq!(
                        meant(&urdf.1, expanded),
                        meant(&plain.text, |text| Some(text.to_owned())),
                        "{at}"
                    );
                }
                Format::Moveit => {
                    let urdf =
                        all.iter().find(|(path, _)| path.ends_with(".urdf")).expect("a URDF");
                    meant(&urdf.1, expanded);
                }
                _ => {}
            }
        }
    }
    // Nothing above is true because nothing was written.
    let named = places.iter().filter(|place| place.starts_with("Place")).count();
    for format in Format::ALL {
        let count = held
            .iter()
            .filter(|(place, of)| place.starts_with("Place") && *of == format.name())
            .count();
        assert!(count * 3 > named * 2, "{format:?} was written for {count} of {named} places");
    }
}

/// The pointers of a schema's texts, with `*` for the places of a list.
fn places_of(schema: &Value, at: &str, root: &Value, found: &mut BTreeSet<String>) {
    let name = schema["$ref"].as_str().and_then(|to| to.rsplit('/').next());
    if let Some(name) = name {
        return places_of(&root["$defs"][name], at, root, found);
    }
    let is_text = schema["type"] == "string" || schema["type"][0] == "string";
    if is_text && schema["enum"].is_null() {
        found.insert(at.to_owned());
    }
    for each in ["anyOf", "oneOf"].iter().filter_map(|key| schema[key].as_array()).flatten() {
        places_of(each, at, root, found);
    }
    if schema["items"].is_object() {
        places_of(&schema["items"], &format!("{at}/*"), root, found);
    }
    for (key, value) in schema["properties"].as_object().into_iter().flatten() {
        places_of(value, &format!("{at}/{key}"), root, found);
    }
}

/// The texts of a document at a pointer with `*`.
fn texts_at<'v>(value: &'v Value, pointer: &str) -> Vec<&'v str> {
    let Some(rest) = pointer.strip_prefix('/') else { return value.as_str().into_iter().collect() };
    let key = rest.split('/').next().unwrap_or_default();
    let rest = &rest[key.len()..];
    match value.as_array() {
        Some(values) if key == "*" => {
            values.iter().flat_map(|value| texts_at(value, rest)).collect()
        }
        _ => value.get(key).map(|value| texts_at(value, rest)).unwrap_or_default(),
    }
}

/// A new place of a URDF, of an edit or a configuration, or of an `export.toml` is in the table.
#[test]
fn the_table_has_every_place() {
    let table = Table::new();
    let mut count = 0;
    for module in ["urdf_module", "link_shapes_skips_module", "named_configurations_module"] {
        let document = table
            .documents
            .iter()
            .find(|(path, _)| path.parent().is_some_and(|of| of.ends_with(module)));
        let (_, document) = document.expect(module);
        let file = format!("{}/schema/{module}/1.0.0.json", env!("CARGO_MANIFEST_DIR"));
        let schema: Value =
            serde_json::from_slice(&std::fs::read(&file).expect(&file)).expect("JSON");
        let mut places = BTreeSet::new();
        places_of(&schema, "", &schema, &mut places);
        for place in places.iter().filter(|place| **place != "/$schema") {
            let texts = texts_at(document, place);
            assert!(
                texts.iter().any(|text| text.contains("Place")),
                "{module}{place} is in no place of texts.urdf: {texts:?}"
            );
            count += 1;
        }
    }
    assert!(count > 18, "{count}");
    // `export.toml`, by the fields that are names.
    let source = include_str!("../../../crates/urdd-directory/src/export_toml.rs");
    let fields =
        source.lines().filter_map(|line| line.trim().strip_prefix("pub ")?.split_once(": "));
    let names: Vec<&str> =
        fields.filter(|(_, of)| of.contains("Name")).map(|(name, _)| name).collect();
    assert!(names.len() > 12, "{names:?}");
    for name in names {
        let is_there =
            [format!("{name} = "), format!("{name}.\"Place")].iter().any(|key| SETUP.contains(key));
        assert!(is_there, "`{name}` of an export.toml is in no place of the table");
    }
}
