//! The data of a legacy `urdf_module` for a URDF: defaults where the URDF has no value.

use serde_json::{Map, Value, json};

use urdd_format::urdf::{JointType, UrdfModule};

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
