//! Compares `urdf_module` with the carried URDF, for URD001, URD013 and URD014.

use serde_json::Value;

use super::parts::{Part, element_part};
use crate::rules::prelude::*;
use crate::urdf_text::compare::{Difference, differences};
use crate::urdf_text::{Reading, as_legacy};
use urdd_directory::position::LineIndex;
use urdd_document::schema_check::excerpt;

/// Reports where a part of the module differs from the URDF.
pub(super) fn report(context: &Context, findings: &mut Findings, part: Part) -> Option<()> {
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
