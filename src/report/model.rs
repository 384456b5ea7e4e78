//! The report as data: what `--format json` writes, and what every other rendering is made from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::format::registry::SPEC_VERSION;
use crate::validate::code::Code;
use crate::validate::engine::{Check, Outcome};
use crate::validate::finding::{Finding as Found, Place as FoundPlace};
use crate::validate::rule::Severity as RuleSeverity;
use crate::validate::{Examined, Report as Run, Subject};

/// Version of the report's own format.
pub const REPORT_VERSION: &str = "1.0.0";

/// What a run of `urdd validate` found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// The program.
    pub tool: Tool,
    /// Version of the specification that was checked against.
    pub spec_version: String,
    /// Every URDD, in the order of the paths given, then by name.
    pub urdds: Vec<Urdd>,
    /// Ignores of the settings that matched nothing.
    pub stale_ignores: Vec<StaleIgnore>,
    /// Sums over all URDDs.
    pub totals: Totals,
}

/// The program that wrote a report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tool {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
}

/// One URDD.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Urdd {
    /// Its folder's path from the path that was given, with forward slashes; its own name where
    /// that path was the URDD itself.
    pub path: String,
    /// Name of the robot; null where no module says it.
    pub name: Option<String>,
    /// What came of it.
    pub verdict: Verdict,
    /// Why it is unreadable; else null.
    pub reason: Option<String>,
    /// How large the robot is.
    pub size: Size,
    /// Its modules.
    pub modules: Vec<Module>,
    /// Every rule, in order of code.
    pub checks: Vec<CheckStatus>,
    /// What was found: by module, then by severity and code.
    pub findings: Vec<Finding>,
}

/// How large a robot is; null where no module says it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Size {
    /// Number of links.
    pub links: Option<usize>,
    /// Number of joints.
    pub joints: Option<usize>,
    /// Number of degrees of freedom.
    pub dofs: Option<usize>,
}

/// What came of examining a URDD.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Nothing found at or above the severity at which a run fails.
    Pass,
    /// Something found.
    Fail,
    /// The folder could not be read.
    Unreadable,
    /// A rule crashed: a fault of this program. The URDD is not fully examined.
    Incomplete,
}

/// A module of a URDD.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Module {
    /// Its name.
    pub name: String,
    /// Its folder, relative to the URDD's root.
    pub path: String,
    /// Its version; null where it has none.
    pub version: Option<String>,
    /// `1.0` or `legacy`; null for extensions and unknown modules.
    pub profile: Option<String>,
}

/// What became of a rule.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckStatus {
    /// Its code.
    pub code: String,
    /// What became of it.
    pub status: Status,
    /// Why it was skipped, or how it crashed; else null.
    pub reason: Option<String>,
}

/// What became of a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// It found nothing.
    Passed,
    /// It found something.
    Failed,
    /// It did not run.
    Skipped,
    /// It ran into a fault of its own.
    Crashed,
}

/// How bad a finding is.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// A MUST that is not kept.
    Error,
    /// A SHOULD that is not kept, or an odd robot.
    Warning,
    /// Worth knowing.
    Info,
}

/// Something that was found, or several of the same.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Finding {
    /// Code of the rule.
    pub code: String,
    /// Name of the rule.
    pub name: String,
    /// How bad it is, settings applied.
    pub severity: Severity,
    /// The severity that the rule has without settings.
    pub default_severity: Severity,
    /// Clause of the specification.
    pub clause: String,
    /// The module; null where it is about none.
    pub module: Option<String>,
    /// The file, relative to the URDD's root, with forward slashes.
    pub file: Option<String>,
    /// JSON Pointer into the document.
    pub pointer: Option<String>,
    /// Line in the file, from 1.
    pub line: Option<u32>,
    /// Column in the line, in characters, from 1.
    pub column: Option<u32>,
    /// What is wrong, and what to do.
    pub message: String,
    /// What should be there.
    pub expected: Option<String>,
    /// What is there.
    pub actual: Option<String>,
    /// Where numbers were compared: the tolerance, in their unit.
    pub tolerance: Option<f64>,
    /// How many findings this one stands for.
    pub count: usize,
    /// The next few of these.
    pub more: Vec<Place>,
}

/// Another place of a finding.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The file.
    pub file: Option<String>,
    /// JSON Pointer into the document.
    pub pointer: Option<String>,
    /// Line in the file, from 1.
    pub line: Option<u32>,
    /// Column in the line, in characters, from 1.
    pub column: Option<u32>,
    /// What should be there.
    pub expected: Option<String>,
    /// What is there.
    pub actual: Option<String>,
}

/// An ignore of the settings that matched nothing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StaleIgnore {
    /// Code of the rule.
    pub code: String,
    /// The pattern.
    pub path: String,
}

/// Sums over all URDDs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Totals {
    /// Number of URDDs.
    pub urdds: usize,
    /// Number of errors.
    pub error: usize,
    /// Number of warnings.
    pub warning: usize,
    /// Number of informations.
    pub info: usize,
}

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
        let mut totals = Totals {
            urdds: urdds.len(),
            ..Totals::default()
        };
        for finding in urdds.iter().flat_map(|urdd| &urdd.findings) {
            match finding.severity {
                Severity::Error => totals.error += finding.count,
                Severity::Warning => totals.warning += finding.count,
                Severity::Info => totals.info += finding.count,
            }
        }
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
        size: Size::default(),
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
            links: examined.size.links,
            joints: examined.size.joints,
            dofs: examined.size.dofs,
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
        Outcome::Skipped(reason) => (Status::Skipped, Some(reason.clone())),
        Outcome::Crashed(message) => (Status::Crashed, Some(message.clone())),
    };
    CheckStatus {
        code: check.rule.code.to_string(),
        status,
        reason,
    }
}

fn findings(examined: &Examined) -> Vec<Finding> {
    let place_of = |module: &Option<String>| {
        module.as_ref().map(|name| {
            examined
                .modules
                .iter()
                .position(|module| module.name == *name)
        })
    };
    let mut findings: Vec<(Code, Finding)> = Vec::new();
    for check in &examined.checks {
        for found in &check.findings {
            findings.push((check.rule.code, finding(examined, check, found)));
        }
    }
    findings.sort_by(|(a_code, a), (b_code, b)| {
        (
            place_of(&a.module),
            a.severity,
            a_code,
            &a.file,
            a.line,
            a.column,
            &a.pointer,
        )
            .cmp(&(
                place_of(&b.module),
                b.severity,
                b_code,
                &b.file,
                b.line,
                b.column,
                &b.pointer,
            ))
    });
    findings.into_iter().map(|(_, finding)| finding).collect()
}

fn finding(examined: &Examined, check: &Check, found: &Found) -> Finding {
    let file = found.place.file.clone();
    let module = file.as_deref().and_then(|file| {
        let inside = |folder: &str| {
            file.strip_prefix(folder)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        examined
            .modules
            .iter()
            .find(|module| inside(&module.path))
            .map(|module| module.name.clone())
    });
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
        count: found.count,
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
        line: place.position.map(|position| position.line),
        column: place.position.map(|position| position.column),
        expected: expected.clone(),
        actual: actual.clone(),
    }
}
