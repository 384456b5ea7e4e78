//! Makes the report as data, from which every rendering is made, of what a run found.

use std::collections::HashMap;

use crate::format::index::Count;
use crate::format::registry::SPEC_VERSION;
pub use crate::format::report::*;
use crate::validate::code::Code;
use crate::validate::engine::{Check, Outcome};
use crate::validate::finding::{Finding as Found, Place as FoundPlace};
use crate::validate::rule::Severity as RuleSeverity;
use crate::validate::{Examined, Report as Run, Subject};

impl From<RuleSeverity> for Severity {
    fn from(severity: RuleSeverity) -> Self {
        match severity {
            RuleSeverity::Error => Severity::Error,
            RuleSeverity::Warning => Severity::Warning,
            RuleSeverity::Info => Severity::Info,
        }
    }
}

impl Report {
    /// The report of a run that fails on findings of `fail_on` and worse.
    pub fn new(run: &Run, fail_on: RuleSeverity) -> Report {
        let urdds: Vec<Urdd> = run
            .subjects
            .iter()
            .map(|subject| urdd(subject, fail_on.into()))
            .collect();
        let total = |severity: Severity| {
            let findings = urdds.iter().flat_map(|urdd| &urdd.findings);
            count(
                findings
                    .filter(|finding| finding.severity == severity)
                    .map(|finding| finding.count.get())
                    .sum(),
            )
        };
        let totals = Totals {
            urdds: count(urdds.len()),
            error: total(Severity::Error),
            warning: total(Severity::Warning),
            info: total(Severity::Info),
        };
        let stale = |ignore: &crate::validate::settings::StaleIgnore| StaleIgnore {
            code: ignore.code.to_string(),
            path: ignore.path.clone(),
        };
        Report {
            tool: Tool {
                name: env!("CARGO_PKG_NAME").to_owned(),
                version: env!("CARGO_PKG_VERSION").to_owned(),
            },
            spec_version: SPEC_VERSION.to_owned(),
            urdds,
            stale_ignores: run.stale_ignores.iter().map(stale).collect(),
            totals,
        }
    }

    /// How many URDDs have a verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.urdds
            .iter()
            .filter(|urdd| urdd.verdict == verdict)
            .count()
    }
}

fn urdd(subject: &Subject, fail_on: Severity) -> Urdd {
    let unreadable = Urdd {
        path: subject.found.name.clone(),
        name: None,
        verdict: Verdict::Unreadable,
        reason: None,
        size: Size {
            links: None,
            joints: None,
            dofs: None,
        },
        modules: Vec::new(),
        checks: Vec::new(),
        findings: Vec::new(),
    };
    let examined = match &subject.result {
        Ok(examined) => examined,
        Err(error) => {
            return Urdd {
                reason: Some(error.to_string()),
                ..unreadable
            };
        }
    };
    let findings = findings(examined);
    let failed = findings.iter().any(|finding| finding.severity <= fail_on);
    let module = |module: &crate::validate::ExaminedModule| Module {
        name: module.name.clone(),
        path: module.path.clone(),
        version: module.version.clone(),
        profile: module.profile.map(|profile| profile.as_str().to_owned()),
    };
    Urdd {
        name: examined.robot_name.clone(),
        verdict: match (examined.incomplete(), failed) {
            (true, _) => Verdict::Incomplete,
            (false, true) => Verdict::Fail,
            (false, false) => Verdict::Pass,
        },
        size: Size {
            links: examined.size.links.map(count),
            joints: examined.size.joints.map(count),
            dofs: examined.size.dofs.map(count),
        },
        modules: examined.modules.iter().map(module).collect(),
        checks: examined.checks.iter().map(check).collect(),
        findings,
        ..unreadable
    }
}

fn check(check: &Check) -> CheckStatus {
    let (status, reason) = match &check.outcome {
        Outcome::Passed => (Status::Passed, None),
        Outcome::Failed => (Status::Failed, None),
        Outcome::Skipped(reason) => (Status::Skipped, Some(reason.to_string())),
        Outcome::Crashed(message) => (Status::Crashed, Some(message.clone())),
    };
    CheckStatus {
        code: check.rule.code.to_string(),
        status,
        reason,
    }
}

fn findings(examined: &Examined) -> Vec<Finding> {
    let folders: HashMap<&str, usize> = examined
        .modules
        .iter()
        .enumerate()
        .map(|(place, module)| (module.path.as_str(), place))
        .collect();
    let mut findings: Vec<(Option<usize>, Code, Finding)> = Vec::new();
    for check in &examined.checks {
        for found in &check.findings {
            let module = found
                .place
                .file
                .as_deref()
                .and_then(|file| module_of(file, &folders));
            let name = module.map(|place| examined.modules[place].name.clone());
            findings.push((module, check.rule.code, finding(name, check, found)));
        }
    }
    findings.sort_by(|(a_module, a_code, a), (b_module, b_code, b)| {
        let a = (
            a_module, a.severity, a_code, &a.file, a.line, a.column, &a.pointer,
        );
        a.cmp(&(
            b_module, b.severity, b_code, &b.file, b.line, b.column, &b.pointer,
        ))
    });
    findings
        .into_iter()
        .map(|(_, _, finding)| finding)
        .collect()
}

/// The module in whose folder a file is, or which the file is the folder of.
fn module_of(file: &str, folders: &HashMap<&str, usize>) -> Option<usize> {
    let parents = file.match_indices('/').map(|(end, _)| &file[..end]);
    parents
        .chain([file])
        .find_map(|folder| folders.get(folder).copied())
}

fn finding(module: Option<String>, check: &Check, found: &Found) -> Finding {
    let file = found.place.file.clone();
    let here = place(&found.place, &found.expected, &found.actual);
    Finding {
        code: check.rule.code.to_string(),
        name: check.rule.name.to_owned(),
        severity: check.severity.into(),
        default_severity: check.rule.severity.into(),
        clause: check.rule.clause.to_owned(),
        module,
        file,
        pointer: here.pointer,
        line: here.line,
        column: here.column,
        message: found.message.clone(),
        expected: here.expected,
        actual: here.actual,
        tolerance: found.tolerance,
        count: count(found.count),
        more: found
            .more
            .iter()
            .map(|other| place(&other.place, &other.expected, &other.actual))
            .collect(),
    }
}

fn place(place: &FoundPlace, expected: &Option<String>, actual: &Option<String>) -> Place {
    Place {
        file: place.file.clone(),
        pointer: place.pointer.clone(),
        line: place.position.map(|position| Count(position.line)),
        column: place.position.map(|position| Count(position.column)),
        expected: expected.clone(),
        actual: actual.clone(),
    }
}

/// A number of things, as far as the report can say it.
fn count(number: usize) -> Count {
    Count(u32::try_from(number).unwrap_or(u32::MAX))
}
