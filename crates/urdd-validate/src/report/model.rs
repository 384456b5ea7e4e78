//! Makes the report as data, from which every rendering is made, of what a run found.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::code::Code;
use crate::engine::{Check, Outcome};
use crate::finding::{Finding as Found, Occurrence};
use crate::skip::SkipReason;
use crate::{Examined, Run, Subject};
use urdd_format::index::Count;
use urdd_format::registry::SPEC_VERSION;
pub use urdd_format::report::*;

impl Run {
    /// The report of the run, which fails on findings of `fail_on` and worse.
    pub fn report(&self, fail_on: Severity) -> Report {
        let urdds: Vec<Urdd> = self
            .subjects
            .iter()
            .map(|subject| urdd(subject, fail_on))
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
        let stale = |ignore: &crate::settings::StaleIgnore| StaleIgnore {
            code: ignore.code.map(|code| code.to_string()),
            path: ignore.path.clone(),
        };
        Report {
            tool: Tool {
                name: "urdd".to_owned(),
                version: env!("CARGO_PKG_VERSION").to_owned(),
            },
            spec_version: SPEC_VERSION.to_owned(),
            urdds,
            stale_ignores: self.stale_ignores.iter().map(stale).collect(),
            totals,
        }
    }
}

fn urdd(subject: &Subject, fail_on: Severity) -> Urdd {
    let unreadable = Urdd {
        kind: match subject.kind {
            crate::Kind::Urdd => Kind::Urdd,
            crate::Kind::Urdf => Kind::Urdf,
        },
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
        not_checked: Vec::new(),
        geometry_not_verified: Vec::new(),
        model_not_verified: None,
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
    let checks: Vec<CheckStatus> = examined.checks.iter().map(check).collect();
    let failed = findings.iter().any(|finding| finding.severity >= fail_on);
    let module = |module: &crate::ExaminedModule| Module {
        name: module.name.clone(),
        path: module.path.clone(),
        version: module.version.clone(),
        profile: module.profile.map(|profile| profile.as_str().to_owned()),
    };
    Urdd {
        name: examined.robot_name.clone(),
        reason: examined.crashed.as_ref().map(|message| {
            format!(
                "the program crashed: {message}; this is a fault of the program, please report it"
            )
        }),
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
        not_checked: not_checked(&checks),
        geometry_not_verified: links_not_verified(examined),
        model_not_verified: model_not_verified(examined),
        checks,
        findings,
        ..unreadable
    }
}

fn check(check: &Check) -> CheckStatus {
    let (status, reason, skipped) = match &check.outcome {
        Outcome::Passed => (Status::Passed, None, None),
        Outcome::Failed => (Status::Failed, None, None),
        Outcome::Skipped(reason) => {
            let kind = match reason {
                SkipReason::Ignored(_) => Skipped::Ignored,
                reason if reason.is_absence() => Skipped::Absent,
                reason if reason.is_for_others() => Skipped::OtherFormat,
                _ => Skipped::NotVerified,
            };
            (Status::Skipped, Some(reason.to_string()), Some(kind))
        }
        Outcome::Crashed(message) => (Status::Crashed, Some(message.clone()), None),
    };
    CheckStatus {
        code: check.rule.code.to_string(),
        status,
        reason,
        skipped,
    }
}

/// What rules could not verify, by reason.
fn not_checked(checks: &[CheckStatus]) -> Vec<NotChecked> {
    let mut by_reason: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    let open = |check: &&CheckStatus| check.skipped == Some(Skipped::NotVerified);
    for check in checks.iter().filter(open) {
        let reason = check.reason.as_deref().unwrap_or_default();
        by_reason
            .entry(reason)
            .or_default()
            .push(check.code.clone());
    }
    let of_reason = |(reason, codes): (&str, Vec<String>)| NotChecked {
        codes,
        reason: reason.to_owned(),
    };
    by_reason.into_iter().map(of_reason).collect()
}

/// The links of which some mesh or shape was not verified.
fn links_not_verified(examined: &Examined) -> Vec<LinkNotVerified> {
    let links = examined.links_not_verified().into_iter();
    let link = |(link, whys): (usize, BTreeSet<_>)| {
        let codes: BTreeSet<_> = whys.iter().map(|(code, _)| *code).collect();
        let reasons: BTreeSet<String> = whys.into_iter().map(|(_, why)| why).collect();
        LinkNotVerified {
            link: count(link),
            codes: codes.iter().map(ToString::to_string).collect(),
            reasons: reasons.into_iter().collect(),
        }
    };
    links.map(link).collect()
}

/// Why the rates of the self-collision model were not verified.
fn model_not_verified(examined: &Examined) -> Option<ModelNotVerified> {
    let whys = examined.model_not_verified();
    let codes: BTreeSet<_> = whys.iter().map(|(code, _)| *code).collect();
    let reasons: BTreeSet<String> = whys.into_iter().map(|(_, why)| why).collect();
    (!codes.is_empty()).then(|| ModelNotVerified {
        codes: codes.iter().map(ToString::to_string).collect(),
        reasons: reasons.into_iter().collect(),
    })
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
            a_module,
            Reverse(a.severity),
            a_code,
            &a.file,
            a.line,
            a.column,
            &a.pointer,
        );
        a.cmp(&(
            b_module,
            Reverse(b.severity),
            b_code,
            &b.file,
            b.line,
            b.column,
            &b.pointer,
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
    let first = Occurrence {
        place: found.place.clone(),
        message: None,
        expected: found.expected.clone(),
        actual: found.actual.clone(),
        magnitude: found.magnitude,
    };
    let places: Vec<Place> = std::iter::once(&first)
        .chain(&found.more)
        .map(place)
        .collect();
    let here = place(&first);
    Finding {
        code: check.rule.code.to_string(),
        name: check.rule.name.to_owned(),
        severity: check.severity,
        default_severity: check.rule.severity,
        clause: check.rule.clause.to_owned(),
        consequence: check.rule.consequence,
        module,
        file: here.file,
        pointer: here.pointer,
        line: here.line,
        column: here.column,
        subject: here.subject,
        message: found.message.clone(),
        expected: here.expected,
        actual: here.actual,
        tolerance: found.tolerance,
        magnitude: here.magnitude,
        count: count(found.count),
        places_cut: count(found.count.saturating_sub(places.len())),
        places,
    }
}

fn place(found: &Occurrence) -> Place {
    let position = found.place.position;
    Place {
        file: found.place.file.clone(),
        pointer: found.place.pointer.clone(),
        line: position.map(|position| Count(position.line)),
        column: position.map(|position| Count(position.column)),
        // The same on both sides says nothing.
        expected: found
            .expected
            .clone()
            .filter(|_| found.expected != found.actual),
        actual: found
            .actual
            .clone()
            .filter(|_| found.expected != found.actual),
        subject: found.place.subject.clone(),
        message: found.message.clone(),
        magnitude: found.magnitude.map(|magnitude| Magnitude {
            value: Some(magnitude.value).filter(|value| value.is_finite()),
            unit: magnitude.unit.to_owned(),
        }),
    }
}

/// A number of things, as far as the report can say it.
fn count(number: usize) -> Count {
    Count(u32::try_from(number).unwrap_or(u32::MAX))
}
