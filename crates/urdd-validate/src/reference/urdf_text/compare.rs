//! Compares `urdf_module` with the URDF: what a legacy module writes for it, and where a document differs.

use std::collections::{HashMap, HashSet};

use serde_json::{Map, Value, json};

use crate::tolerance::{number_tolerance, numbers_agree};
use urdd_format::urdf::{JointType, UrdfModule};

/// A value that differs from the URDF.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// JSON Pointer in the document.
    pub pointer: String,
    /// JSON Pointer of the value in the URDF's data, which has other indices if elements are missing or moved.
    pub source: String,
    /// The URDF's value.
    pub expected: Value,
    /// The document's value.
    pub actual: Value,
    /// Tolerance, if both are numbers.
    pub tolerance: Option<f64>,
    /// How whole lists differ, if they do.
    pub list: Option<String>,
}

/// Every difference between the URDF's data and a document. Links and joints are compared by name, so that a missing
/// one is a single difference.
pub fn differences(expected: &Value, actual: &Value) -> Vec<Difference> {
    let mut comparison = Comparison(Vec::new());
    if let Some(keys) = expected.as_object() {
        for (key, expected) in keys {
            let actual = actual.get(key).unwrap_or(&Value::Null);
            let pointer = format!("/{key}");
            match (key.as_str(), expected, actual) {
                ("links" | "joints", Value::Array(expected), Value::Array(actual)) => {
                    comparison.by_name(&pointer, expected, actual);
                }
                _ => comparison.value(&pointer, &pointer, expected, actual),
            }
        }
    }
    comparison.0
}

struct Comparison(Vec<Difference>);

impl Difference {
    fn new(pointer: &str, source: &str, expected: &Value, actual: &Value) -> Self {
        Difference {
            pointer: pointer.to_owned(),
            source: source.to_owned(),
            expected: expected.clone(),
            actual: actual.clone(),
            tolerance: None,
            list: None,
        }
    }

    /// Two lists of these lengths.
    fn of_lists(pointer: &str, source: &str, lengths: [usize; 2], how: String) -> Self {
        let [expected, actual] = lengths.map(Value::from);
        Difference { list: Some(how), ..Difference::new(pointer, source, &expected, &actual) }
    }
}

impl Comparison {
    fn report(&mut self, pointer: &str, source: &str, expected: &Value, actual: &Value) {
        self.0.push(Difference::new(pointer, source, expected, actual));
    }

    fn value(&mut self, pointer: &str, source: &str, expected: &Value, actual: &Value) {
        match (expected, actual) {
            (Value::Object(wanted), Value::Object(there)) => {
                // A choice of one key: another key means another kind of value.
                if wanted.keys().any(|key| !there.contains_key(key)) {
                    self.report(pointer, source, expected, actual);
                    return;
                }
                for (key, expected) in wanted {
                    let actual = there.get(key).unwrap_or(&Value::Null);
                    let (pointer, source) = (format!("{pointer}/{key}"), format!("{source}/{key}"));
                    self.value(&pointer, &source, expected, actual);
                }
            }
            (Value::Array(wanted), Value::Array(there)) => {
                if wanted.len() != there.len() {
                    let lengths = [wanted.len(), there.len()];
                    let how = format!("{} there, {} here", lengths[0], lengths[1]);
                    self.0.push(Difference::of_lists(pointer, source, lengths, how));
                    return;
                }
                for (index, (expected, actual)) in wanted.iter().zip(there).enumerate() {
                    let (pointer, source) =
                        (format!("{pointer}/{index}"), format!("{source}/{index}"));
                    self.value(&pointer, &source, expected, actual);
                }
            }
            (Value::Number(wanted), Value::Number(there)) => {
                let (Some(a), Some(b)) = (wanted.as_f64(), there.as_f64()) else { return };
                if !numbers_agree(a, b) {
                    self.0.push(Difference {
                        tolerance: Some(number_tolerance(a, b)),
                        ..Difference::new(pointer, source, expected, actual)
                    });
                }
            }
            (Value::String(wanted), Value::String(there)) => {
                if wanted != there && unix_lines(wanted) != unix_lines(there) {
                    self.report(pointer, source, expected, actual);
                }
            }
            _ if expected == actual => {}
            _ => self.report(pointer, source, expected, actual),
        }
    }

    /// Compares lists of named elements: the same names in the same order, and each with its counterpart.
    fn by_name(&mut self, list: &str, expected: &[Value], actual: &[Value]) {
        let name = |value: &Value| -> String {
            let name = value.get("name").and_then(Value::as_str);
            name.unwrap_or_default().to_owned()
        };
        let wanted: Vec<String> = expected.iter().map(name).collect();
        let there: Vec<String> = actual.iter().map(name).collect();
        let others = wanted.iter().zip(&there).filter(|(wanted, there)| wanted != there).count();
        // An element with another name is compared too: the name is a difference.
        if wanted.len() == there.len() && others <= 1 {
            for (index, (expected, actual)) in expected.iter().zip(actual).enumerate() {
                let pointer = format!("{list}/{index}");
                self.value(&pointer, &pointer, expected, actual);
            }
            return;
        }
        let how = how_names_differ(&wanted, &there);
        self.0.push(Difference::of_lists(list, list, [wanted.len(), there.len()], how));
        // Of several of one name, the first.
        let place = there.iter().enumerate().rev().map(|(index, name)| (name.as_str(), index));
        let place: HashMap<&str, usize> = place.collect();
        for (index, (name, expected)) in wanted.iter().zip(expected).enumerate() {
            if let Some(&at) = place.get(name.as_str()) {
                let (pointer, source) = (format!("{list}/{at}"), format!("{list}/{index}"));
                self.value(&pointer, &source, expected, &actual[at]);
            }
        }
    }
}

fn how_names_differ(wanted: &[String], there: &[String]) -> String {
    let only_in = |a: &[String], b: &[String]| {
        let b: HashSet<&String> = b.iter().collect();
        a.iter().filter(|name| !b.contains(name)).cloned().collect::<Vec<String>>()
    };
    let (missing, extra) = (only_in(wanted, there), only_in(there, wanted));
    let mut words = Vec::new();
    if !missing.is_empty() {
        words.push(format!("missing: {}", first_names(&missing)));
    }
    if !extra.is_empty() {
        words.push(format!("not in the URDF: {}", first_names(&extra)));
    }
    if words.is_empty() {
        let first = wanted.iter().zip(there).find(|(a, b)| a != b);
        words.push(match first {
            Some((wanted, there)) => {
                format!("the order differs: `{there}` is where the URDF has `{wanted}`")
            }
            None => format!("{} there, {} here", wanted.len(), there.len()),
        });
    }
    words.join("; ")
}

/// The first few of a list of names.
pub fn first_names<S: AsRef<str>>(names: &[S]) -> String {
    const SHOWN: usize = 5;
    let mut text: Vec<String> =
        names.iter().take(SHOWN).map(|name| format!("`{}`", name.as_ref())).collect();
    if names.len() > SHOWN {
        text.push(format!("and {} more", names.len() - SHOWN));
    }
    text.join(", ")
}

/// A text with line endings as XML readers normalise them: copying files may have changed them.
fn unix_lines(text: &str) -> String {
    text.replace("\r\n", "\n")
}

/// What legacy modules write for a value of the URDF.
enum Form {
    /// The value, or null.
    Same,
    /// The value, or this number.
    Number(f64),
    /// The value, or this vector.
    Vector([f64; 3]),
    /// The value, or an empty text.
    Text,
    /// An object of these keys, even if the URDF has none.
    Object(Keys),
    /// An object of these keys, or null.
    Optional(Keys),
    /// A list of objects of these keys.
    List(Keys),
}

type Keys = &'static [(&'static str, Form)];

use Form::{List, Number, Object, Optional, Same, Text, Vector};

const ROBOT: Keys = &[
    ("name", Same),
    ("links", List(LINK)),
    ("joints", List(JOINT)),
    ("materials", List(MATERIAL)),
];
const LINK: Keys = &[
    ("name", Same),
    ("inertial", Object(INERTIAL)),
    ("visual", List(VISUAL)),
    ("collision", List(COLLISION)),
];
const INERTIAL: Keys = &[
    ("origin", Object(ORIGIN)),
    ("mass", Object(&[("value", Number(0.0))])),
    ("inertia", Object(INERTIA)),
];
const INERTIA: Keys = &[
    ("ixx", Number(0.0)),
    ("ixy", Number(0.0)),
    ("ixz", Number(0.0)),
    ("iyy", Number(0.0)),
    ("iyz", Number(0.0)),
    ("izz", Number(0.0)),
];
const ORIGIN: Keys = &[("xyz", Vector([0.0; 3])), ("rpy", Vector([0.0; 3]))];
const VISUAL: Keys = &[
    ("name", Same),
    ("origin", Object(ORIGIN)),
    ("geometry", Same),
    ("material", Optional(MATERIAL)),
];
const COLLISION: Keys = &[("name", Same), ("origin", Object(ORIGIN)), ("geometry", Same)];
const MATERIAL: Keys = &[("name", Text), ("color", Same), ("texture", Same)];
const JOINT: Keys = &[
    ("name", Same),
    ("joint_type", Same),
    ("origin", Object(ORIGIN)),
    ("parent", Same),
    ("child", Same),
    ("axis", Object(&[("xyz", Vector([1.0, 0.0, 0.0]))])),
    ("limit", Object(LIMIT)),
    ("dynamics", Optional(DYNAMICS)),
    ("mimic", Same),
    ("safety_controller", Optional(SAFETY_CONTROLLER)),
];
const LIMIT: Keys = &[
    ("lower", Number(0.0)),
    ("upper", Number(0.0)),
    ("effort", Number(0.0)),
    ("velocity", Number(0.0)),
];
const DYNAMICS: Keys = &[("damping", Number(0.0)), ("friction", Number(0.0))];
const SAFETY_CONTROLLER: Keys = &[
    ("soft_lower_limit", Number(0.0)),
    ("soft_upper_limit", Number(0.0)),
    ("k_position", Number(0.0)),
    ("k_velocity", Number(0.0)),
];

/// The document that the converter of legacy URDDs would have written, apart from what it wrote inconsistently. `None`
/// if it could not write it (an element without a shape).
pub fn as_legacy(robot: &UrdfModule) -> Option<Value> {
    for link in &robot.links {
        let visual = link.visual.iter().map(|visual| &visual.geometry);
        let collision = link.collision.iter().map(|collision| &collision.geometry);
        if visual.chain(collision).any(Option::is_none) {
            return None;
        }
    }
    let mut document = object(&serde_json::to_value(robot).ok()?, ROBOT);
    let joints = document.get_mut("joints")?.as_array_mut()?;
    for (joint, value) in robot.joints.iter().zip(joints) {
        // An axis that is neither present nor used was written as 1 0 0 by some versions, and as zeros by others.
        if joint.axis.is_none() && joint.joint_type == JointType::Fixed {
            value.as_object_mut()?.shift_remove("axis");
        }
    }
    Some(document)
}

fn object(value: &Value, keys: Keys) -> Value {
    let member = |(key, form): &(&str, Form)| (String::from(*key), write(&value[*key], form));
    Value::Object(keys.iter().map(member).collect::<Map<_, _>>())
}

fn write(value: &Value, form: &Form) -> Value {
    match (form, value) {
        (Object(keys), _) => object(value, keys),
        (List(keys), Value::Array(list)) => list.iter().map(|one| object(one, keys)).collect(),
        (Number(number), Value::Null) => json!(number),
        (Vector(vector), Value::Null) => json!(vector),
        (Text, Value::Null) => json!(""),
        (Optional(keys), Value::Object(_)) => object(value, keys),
        _ => value.clone(),
    }
}
