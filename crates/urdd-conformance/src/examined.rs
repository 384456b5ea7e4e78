//! Validates what a producer wrote.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::path::Path;

use urdd_directory::cancellation::Cancellation;
use urdd_format::report::{Finding, Urdd, Verdict};
use urdd_format::root_metadata::ConformanceClass;
use urdd_validate::settings::Settings;
use urdd_validate::validate;

/// The validator's result, or the reason why there is none.
pub fn examine(
    out: &Path,
    class: ConformanceClass,
    cancellation: &Cancellation,
) -> Result<Urdd, Option<String>> {
    if !out.is_dir() {
        return Err(Some("the command created no folder at {out}".to_owned()));
    }
    let settings =
        Settings { class: Some(class), cancellation: cancellation.clone(), ..Settings::default() };
    let run = validate(&[out.to_owned()], &settings).map_err(|error| {
        let text = error.to_string();
        Some(text.replace(&out.display().to_string(), "{out}"))
    })?;
    let mut urdds = run.report.urdds;
    match (urdds.pop(), urdds.is_empty()) {
        (Some(urdd), true) if urdd.verdict == Verdict::Unreadable => Err(urdd.reason),
        (Some(urdd), true) if out.file_name() == Some(OsStr::new(&urdd.path)) => Ok(urdd),
        _ => Err(Some(
            "{out} itself must be the URDD: one URDD, without a folder around it".to_owned(),
        )),
    }
}

/// The codes of findings, sorted.
pub fn codes<'a>(findings: impl Iterator<Item = &'a Finding>) -> Vec<String> {
    let codes: BTreeSet<&str> = findings.map(|finding| finding.code.as_str()).collect();
    codes.into_iter().map(str::to_owned).collect()
}
