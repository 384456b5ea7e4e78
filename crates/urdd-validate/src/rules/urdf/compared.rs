use serde_json::Value;

use crate::reference::urdf_text::compare::{Difference, differences};
use crate::reference::urdf_text::{Reading, as_legacy};
use crate::rules::prelude::*;
use urdd_directory::position::{self, LineIndex};
use urdd_document::carried_urdf::NoUrdf;
use urdd_document::schema_check::excerpt;

declare_rule! {
    /// The links or joints of `urdf_module` are not those of the carried URDF.
    ///
    /// The kinematics of all other modules are derived from this one, and a consumer that trusts it
    /// never opens the URDF. Links and joints must be those of the file, in its order; and type,
    /// origin, parent, child, axis, limits and mimic of each joint too. What the URDF leaves out
    /// must be null, never a default: a missing limit is not a limit of 0. Numbers may differ by
    /// rounding in the tenth digit. (The rest of the module: URD013, and
    /// materials: URD014.)
    ///
    /// Modules of legacy versions are held to the conventions of their time: there, what is absent
    /// is written as zeros.
    ///
    /// Write `urdf_module`, and what is derived from it, again from the URDF that is carried; or
    /// carry the URDF from which the module was written.
    URD001 "joints-not-the-urdfs", Error, clause "6.1.2", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf), CarriedUrdf, Passed(URD011), Passed(URD002), Passed(URD003), ROBOT_SOUND,
        Passed(URD005), Passed(URD007), Passed(URD008), Passed(URD009), Passed(URD010), Passed(URD012),
    ],
    check |context, findings| report(context, findings, Part::Joints),

    /// What `urdf_module` says of a link, or of the robot, is not what the carried URDF says.
    ///
    /// Shapes and where they are, masses, inertias, joint dynamics and the elements that URDF does not
    /// define must be those of the file. A collision shape that lost its origin is in the wrong place,
    /// and the robot collides there. What the URDF leaves out must be null, never a default. Numbers
    /// may differ by rounding in the tenth digit. (Joints, and which links there are: URD001.
    /// Materials: URD014.)
    ///
    /// Modules of legacy versions are held to the conventions of their time: there, what is absent
    /// is written as zeros, and elements that URDF does not define are lost.
    ///
    /// Write `urdf_module`, and what is derived from it, again from the URDF that is carried; or
    /// carry the URDF from which the module was written.
    URD013 "links-not-the-urdfs", Error, clause "6.1.2", since "0.1.0",
    phase References, consequence WrongPlace, needs [
        Module(Kind::Urdf), CarriedUrdf, Passed(URD011), Passed(URD002), Passed(URD003),
    ],
    check |context, findings| report(context, findings, Part::Rest),

    /// A material in `urdf_module` is not the one in the carried URDF.
    ///
    /// The robot is shown in another colour, or in none. Nothing else depends on it: where shapes and
    /// masses differ, URD013 says so. What the URDF leaves out must be null. (Legacy modules write an
    /// absent name as an empty string.)
    ///
    /// Write `urdf_module` again from the URDF that is carried, or carry the URDF from which the module
    /// was written.
    URD014 "materials-not-the-urdfs", Error, clause "6.1.2", since "0.2.0",
    phase References, consequence Appearance, needs [
        Module(Kind::Urdf), CarriedUrdf, Passed(URD011), Passed(URD002), Passed(URD003),
    ],
    check |context, findings| report(context, findings, Part::Materials),

    /// The carried URDF cannot be read as a URDF.
    ///
    /// The file must be well-formed XML in UTF-8 with a `<robot>` that has a name; every link a
    /// name; every joint a name, a type that URDF defines, a parent and a child; every mimic a
    /// joint; every shape its sizes or its file name. Numbers must be numbers: three to a vector, four to
    /// a colour. Where that fails, readers differ: some refuse, some drop a word of `0 x 0 1`, some take
    /// zeros. SPEC 6.1.8 lists every element and attribute.
    ///
    /// Correct the URDF at the places that are given, and write the URDD again. A `$(arg …)` or `${…}`
    /// means that xacro was not run.
    URD011 "unreadable-urdf", Error, clause "6.1.2", since "0.1.0",
    phase Syntax, needs [UrdfFile], of Robot, check unreadable_urdf,
}

/// Reports where a part of the module differs from the URDF.
fn report(context: &Context, findings: &mut Findings, part: Part) -> Option<()> {
    let module = context.module(Kind::Urdf)?;
    let carried = context.urdf().ok()?;
    let reading = context.urdf_text()?;
    let robot = reading.robot.as_ref()?;
    let actual = &module.json.document()?.value;
    module.document.as_ref()?;
    let expected = match module.is_legacy() {
        true => as_legacy(robot)?,
        false => serde_json::to_value(robot).ok()?,
    };
    let lines = LineIndex::new(&carried.text);
    let mut last = None;
    for mut found in differences(&expected, actual) {
        if Part::of(&found.pointer) != part {
            continue;
        }
        let mut words = message(&found);
        if let (Some(pointer), Some(source)) =
            (element_part(&found.pointer), element_part(&found.source))
        {
            let (pointer, source) = (pointer.to_owned(), source.to_owned());
            if last.as_ref() == Some(&pointer) {
                continue;
            }
            found.expected = expected.pointer(&source).cloned().unwrap_or_default();
            found.actual = actual.pointer(&pointer).cloned().unwrap_or_default();
            if is_nothing(&found.actual) && !is_nothing(&found.expected) {
                words = lost(reading, &source);
                found.tolerance = None;
            }
            last = Some(pointer.clone());
            (found.pointer, found.source) = (pointer, source);
        }
        let line = reading
            .position(&lines, &found.source)
            .map_or(String::new(), |place| format!(" ({}, line {})", carried.path, place.line));
        let mut finding = finding_in(module, found.pointer, words)
            .values(format!("{}{line}", excerpt(&found.expected)), excerpt(&found.actual));
        finding.tolerance = found.tolerance;
        findings.report(finding);
    }
    Some(())
}

/// Whether a value is null, zero or empty, or consists only of such values.
pub fn is_nothing(value: &Value) -> bool {
    match value {
        Value::Null => true,
        Value::Bool(_) => false,
        Value::Number(number) => number.as_f64() == Some(0.0),
        Value::String(text) => text.is_empty(),
        Value::Array(values) => values.iter().all(is_nothing),
        Value::Object(values) => values.values().all(is_nothing),
    }
}

/// The message for a lost origin or material of a shape.
fn lost(reading: &Reading, source: &str) -> String {
    let (element, name) = source.rsplit_once('/').unwrap_or((source, ""));
    let geometry = reading.offset(&format!("{element}/geometry"));
    let after = match (geometry, reading.offset(source)) {
        (Some(geometry), Some(offset)) if offset > geometry => {
            ", and so is everything after `<geometry>` in its element"
        }
        _ => "",
    };
    let means = match name {
        "origin" => "the shape is in the wrong place",
        _ => "the shape has another colour",
    };
    format!(
        "the URDF's `<{name}>` is lost here{after}: {means}; write the module again from the URDF"
    )
}

fn message(difference: &Difference) -> String {
    match (difference, &difference.expected, &difference.actual) {
        (Difference { list: Some(how), .. }, _, _) => {
            format!("the list is not the URDF's ({how}); write the module again from the URDF")
        }
        (_, Value::Null, _) => "the URDF has no value here: write null, not a default".to_owned(),
        (_, _, Value::Null) => "the URDF has a value here: write it, not null".to_owned(),
        _ => "this is not what the URDF says; write the module again from the URDF".to_owned(),
    }
}

/// The parts of a robot; one rule compares each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The set of links and joints, and everything that affects kinematics: URD001.
    Joints,
    /// Materials: URD014.
    Materials,
    /// Everything else: URD013.
    Rest,
}

impl Part {
    /// The part to which the value at a JSON Pointer of `urdf_module` belongs.
    pub fn of(pointer: &str) -> Part {
        let parts: Vec<&str> = pointer.split('/').skip(1).collect();
        match parts.as_slice() {
            // Whether a quaternion counts depends on the version.
            ["links" | "joints" | "version"] | ["links" | "joints", _, "name", ..] => Part::Joints,
            [
                "joints",
                _,
                "joint_type" | "origin" | "parent" | "child" | "axis" | "limit" | "mimic",
                ..,
            ] => Part::Joints,
            ["materials", ..] | ["links", _, "visual", _, "material", ..] => Part::Materials,
            _ => Part::Rest,
        }
    }
}

/// The origin or material of a visual or collision element that contains a JSON Pointer's value. Differences within it
/// are one finding.
pub fn element_part(pointer: &str) -> Option<&str> {
    let mut ends = pointer.match_indices('/').map(|(at, _)| at).skip(1);
    // /links/3/visual/0/origin/xyz/2
    let mut parts = pointer.split('/').skip(1);
    let is_shape = parts.next() == Some("links")
        && matches!(parts.nth(1), Some("visual" | "collision"))
        && matches!(parts.nth(1), Some("origin" | "material"));
    let end = ends.nth(4).unwrap_or(pointer.len());
    is_shape.then(|| &pointer[..end])
}

fn unreadable_urdf(described: &Described, findings: &mut Findings) -> Option<()> {
    let carried = match described.urdf {
        Ok(carried) => carried,
        Err(NoUrdf::Unreadable { path, error }) => {
            findings.report(Finding::in_file(path, format!("the URDF is too large: {error}")));
            return Some(());
        }
        Err(_) => return None,
    };
    let reading = described.urdf_text()?;
    if let Some(offset) = carried.not_utf8_at {
        let message = match &carried.foreign {
            Some(foreign) => foreign.to_string(),
            None => "the URDF is not in UTF-8; save it as UTF-8, and say so in its XML declaration"
                .to_owned(),
        };
        Finding::in_file(&carried.path, message)
            .position(Some(position::position(&carried.text, offset)))
            .report(findings);
        return Some(());
    }
    let lines = LineIndex::new(&carried.text);
    for problem in &reading.problems {
        let mut finding = Finding::in_file(&carried.path, problem.fault.to_string())
            .position(Some(lines.position(problem.offset)));
        if let Some(actual) = &problem.actual {
            finding = finding.actual(excerpt(&actual.as_str().into()));
        }
        findings.report(finding);
    }
    Some(())
}
