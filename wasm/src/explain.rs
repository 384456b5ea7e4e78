//! Explanations of rules.

use serde_json::{Value, json};
use urdd_findings::description::Description;
use urdd_validate::rules;

use crate::{answer, memory};

/// Explains a rule: `code`, `name`, `severity`, `clause` and `explanation`, as `urdd explain` does.
///
/// # Safety
/// The code is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_explain(code: *const u8, length: usize) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let code = String::from_utf8_lossy(unsafe { memory::bytes(code, length) });
    let unknown = || format!("there is no rule `{}`", code.escape_debug());
    answer::result(explained(&code).ok_or_else(unknown))
}

/// What a rule means; none without such a rule.
pub fn explained(code: &str) -> Option<Value> {
    let rule = all().find(|rule| rule.code.as_str() == code)?;
    Some(json!({
        "code": rule.code.to_string(),
        "name": rule.name,
        "severity": rule.severity.as_str(),
        "clause": rule.clause,
        "explanation": rule.explanation(),
    }))
}

#[cfg(not(feature = "lint"))]
fn all() -> impl Iterator<Item = &'static Description> {
    rules::all().into_iter().map(|rule| &rule.description)
}

/// The rules of the validator, and those of lint.
#[cfg(feature = "lint")]
fn all() -> impl Iterator<Item = &'static Description> {
    let of_urdfs = urdd_lint::rules::all().into_iter().map(|rule| &rule.description);
    rules::all().into_iter().map(|rule| &rule.description).chain(of_urdfs)
}
