use serde_json::Value;

use crate::directory::position::LineIndex;
use crate::format::registry::{ModuleDocument, ModuleKind};
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;
use crate::validate::schema_check::excerpt;
use crate::validate::urdf_text::as_legacy;
use crate::validate::urdf_text::compare::{Difference, differences};

declare_rule! {
    /// A value of `urdf_module` is not what the carried URDF says.
    ///
    /// All other modules are derived from this one, and a consumer that trusts it never opens the
    /// URDF. Links, joints and materials must be those of the file, in its order; every number,
    /// name and file name too; and what the URDF leaves out must be null, never a default: a
    /// missing limit is not a limit of 0. Elements that URDF does not define are kept as their own
    /// text. Numbers may differ by rounding in the tenth digit.
    ///
    /// Modules of legacy versions are held to the conventions of their time: there, what is absent
    /// is written as zeros, and elements that URDF does not define are lost.
    ///
    /// Write `urdf_module`, and what is derived from it, again from the URDF that is carried; or
    /// carry the URDF from which the module was written.
    URD001 "not-what-the-urdf-says", Error, clause "6.1.2", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf), CarriedUrdf, Passed(URD011), Passed(URD002), Passed(URD003),
        Passed(URD004), Passed(URD005), Passed(URD006), Passed(URD007), Passed(URD008),
        Passed(URD009), Passed(URD010), Passed(URD012),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
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
    for difference in differences(&expected, actual) {
        let line = reading
            .position(&lines, &difference.source)
            .map_or(String::new(), |place| {
                format!(" ({}, line {})", carried.path, place.line)
            });
        let mut finding = Finding::at(
            module.file("module.json"),
            difference.pointer.clone(),
            message(&difference),
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
