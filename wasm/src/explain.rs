//! Explanations of rules.

use serde_json::json;
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
    let rule = rules::all().into_iter().find(|rule| rule.code.to_string() == code);
    answer::result(match rule {
        None => Err(format!("there is no rule `{}`", code.escape_debug())),
        Some(rule) => Ok(json!({
            "code": rule.code.to_string(),
            "name": rule.name,
            "severity": rule.severity.as_str(),
            "clause": rule.clause,
            "explanation": rule.explanation(),
        })),
    })
}
