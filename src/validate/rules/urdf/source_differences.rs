//! What URD001 and URD013 share: `urdf_module` against the carried URDF.

use serde_json::Value;

use crate::directory::position::LineIndex;
use crate::document::schema_check::excerpt;
use crate::format::registry::{ModuleDocument, ModuleKind};
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::urdf_text::as_legacy;
use crate::validate::urdf_text::compare::{Difference, differences};

/// Whether kinematics depend on the value at a JSON Pointer of `urdf_module`.
pub(super) fn is_kinematic(pointer: &str) -> bool {
    let mut parts = pointer.split('/').skip(1);
    match (parts.next(), parts.next(), parts.next()) {
        // By the version, a quaternion counts or does not.
        (Some("links" | "joints" | "version"), None, _) => true,
        (Some("links" | "joints"), Some(_), Some("name")) => true,
        (Some("joints"), Some(_), Some(key)) => matches!(
            key,
            "joint_type" | "origin" | "parent" | "child" | "axis" | "limit" | "mimic"
        ),
        _ => false,
    }
}

/// Reports where the module differs from the URDF, at the pointers that are asked for.
pub(super) fn report(context: &Context, findings: &mut Findings, asked: impl Fn(&str) -> bool) {
    let (Some(module), Ok(carried), Some(reading)) = (
        context.module(ModuleKind::Urdf),
        context.urdf(),
        context.urdf_text(),
    ) else {
        return;
    };
    let (Some(robot), Some(document), Some(actual)) = (
        &reading.robot,
        &module.document,
        module.json.document().map(|document| &document.value),
    ) else {
        return;
    };
    let expected = match document {
        ModuleDocument::LegacyUrdf(_) => as_legacy(robot),
        _ => serde_json::to_value(robot).ok(),
    };
    let Some(expected) = expected else { return };
    let lines = LineIndex::new(&carried.text);
    let found = differences(&expected, actual);
    for difference in found.iter().filter(|found| asked(&found.pointer)) {
        let line = reading
            .position(&lines, &difference.source)
            .map_or(String::new(), |place| {
                format!(" ({}, line {})", carried.path, place.line)
            });
        let mut finding = Finding::at(
            module.file("module.json"),
            difference.pointer.clone(),
            message(difference),
        )
        .expected(format!("{}{line}", excerpt(&difference.expected)))
        .actual(excerpt(&difference.actual));
        finding.tolerance = difference.tolerance;
        findings.report(finding);
    }
}

fn message(difference: &Difference) -> String {
    match (difference, &difference.expected, &difference.actual) {
        (
            Difference {
                list: Some(how), ..
            },
            _,
            _,
        ) => {
            format!("the list is not the URDF's ({how}); write the module again from the URDF")
        }
        (_, Value::Null, _) => "the URDF has no value here: write null, not a default".to_owned(),
        (_, _, Value::Null) => "the URDF has a value here: write it, not null".to_owned(),
        _ => "this is not what the URDF says; write the module again from the URDF".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::is_kinematic;

    #[test]
    fn tells_kinematics_from_the_rest() {
        for pointer in [
            "/links",
            "/joints",
            "/links/3/name",
            "/version",
            "/joints/1/mimic/offset",
        ] {
            assert!(is_kinematic(pointer), "{pointer}");
        }
        for pointer in [
            "/name",
            "/links/3/visual/0/name",
            "/joints/1/dynamics",
            "/materials",
            "",
        ] {
            assert!(!is_kinematic(pointer), "{pointer}");
        }
    }
}
