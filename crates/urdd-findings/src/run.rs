//! The result of a run over URDDs or URDFs: its report, and where they are. Reports contain no absolute paths: tools that
//! show one beside the files get them relative to the working directory.

use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};
use std::path::{Component, Path, PathBuf};

use crate::answer::{self, Answer};
use crate::check::{Check, Examined, Outcome};
use crate::code::Code;
use crate::description::Description;
use crate::finding::Finding as Found;
use crate::part::SkipReason;
use crate::settings::Settings;
use urdd_format::index::Count;
use urdd_format::registry::SPEC_VERSION;
use urdd_format::report::{
    CheckStatus, Finding, Module, NotChecked, Place, Report, Severity, Skipped, Status, Tool,
    Totals, Urdd, Verdict,
};

/// The result of a run.
pub struct Run {
    /// The report.
    pub report: Report,
    /// The folder of each URDD of the report. The report itself has no absolute paths.
    pub folders: Vec<PathBuf>,
    /// Number of URDDs that the settings exclude.
    pub excluded: usize,
    /// What else is there that a person may want to know, a line each. Nothing fails for it.
    pub asides: Vec<String>,
    rules: BTreeMap<&'static str, &'static Description>,
}

impl Run {
    /// The report on what was examined in these folders, with the settings applied.
    pub fn of(
        examined: Vec<Examined>,
        folders: Vec<PathBuf>,
        excluded: usize,
        settings: &Settings,
    ) -> Run {
        let checks = examined.iter().flat_map(|one| &one.checks);
        Run {
            rules: checks.map(|check| (check.rule.code.as_str(), check.rule)).collect(),
            report: fill(examined, settings),
            folders,
            excluded,
            asides: Vec::new(),
        }
    }

    /// What a rule that ran says of itself, by its code.
    pub fn rule(&self, code: &str) -> Option<&'static Description> {
        self.rules.get(code).copied()
    }
}

/// The report on examined URDDs, with severities, ignores and the selection of the settings applied.
fn fill(mut examined: Vec<Examined>, settings: &Settings) -> Report {
    let stale_ignores = settings.apply(&mut examined);
    for one in &mut examined {
        let is_import = one.report.imported.is_some();
        let findings = one.checks.iter_mut().flat_map(|check| &mut check.findings);
        findings.flat_map(Found::places_mut).for_each(|place| in_original(place, is_import));
    }
    let fail_on = settings.fail_on.unwrap_or(Severity::Error);
    let urdds: Vec<Urdd> = examined.into_iter().map(|examined| urdd(examined, fail_on)).collect();
    let not_examined = urdds.iter().filter(|urdd| urdd.not_examined.is_some()).count();
    let examined = |verdicts: &[Verdict]| {
        let all = urdds.iter().filter(|urdd| urdd.not_examined.is_none());
        Count::saturating(all.filter(|urdd| verdicts.contains(&urdd.verdict)).count())
    };
    let total = |severity: Severity| {
        let findings = urdds.iter().flat_map(|urdd| &urdd.findings);
        let alike = findings.filter(|finding| finding.severity == severity);
        Count::saturating(alike.map(|finding| finding.count.get()).sum())
    };
    Report {
        tool: Tool::urdd(),
        spec_version: SPEC_VERSION.to_owned(),
        stale_ignores,
        totals: Totals {
            urdds: Count::saturating(urdds.len()),
            passed: examined(&[Verdict::Pass]),
            failed: examined(&[Verdict::Fail, Verdict::Incomplete]),
            not_examined: Count::saturating(not_examined),
            error: total(Severity::Error),
            warning: total(Severity::Warning),
            info: total(Severity::Info),
        },
        urdds,
    }
}

/// Moves a place to where the original of an import or an expansion has what it is about: nobody has the URDF that was made
/// of it. Until here, places in that URDF tell which findings follow from others.
fn in_original(place: &mut Place, is_import: bool) {
    match &place.written_at {
        Some(at) => {
            place.file = Some(at.file.clone());
            (place.line, place.column) = (at.line, at.column);
        }
        None if is_import => (place.line, place.column) = (None, None),
        None => {}
    }
    // It speaks of xacro.
    if is_import || place.line.is_none() {
        place.written_at = None;
    }
    place.related.iter_mut().for_each(|related| in_original(related, is_import));
    // An element of which the fault that it has is told at one literal: there.
    let is_literal =
        |place: &Place| place.written_at.as_ref().is_some_and(|at| at.used_at.is_some());
    if place.written_at.is_some() && !is_literal(place) {
        let mut literals = place.related.iter().filter(|related| is_literal(related));
        if let (Some(only), None) = (literals.next(), literals.next()) {
            (place.file, place.line, place.column, place.written_at) =
                (only.file.clone(), only.line, only.column, only.written_at.clone());
        }
    }
}

pub(crate) fn urdd(examined: Examined, fail_on: Severity) -> Urdd {
    let geometry_not_verified = examined.links_not_verified();
    let model_not_verified = examined.model_not_verified();
    let Examined { report, checks } = examined;
    let statuses: Vec<CheckStatus> = checks.iter().map(status).collect();
    let findings = findings(&report.modules, checks);
    let open = by_reason(&statuses, Skipped::NotVerified).into_iter();
    let open = open.map(|(reason, codes)| NotChecked { codes, reason: reason.to_owned() });
    let not_checked = open.collect();
    let mut urdd = Urdd {
        not_checked,
        checks: statuses,
        findings,
        geometry_not_verified,
        model_not_verified,
        ..report
    };
    urdd.verdict = match (&urdd.not_examined, Answer::of_rules(&urdd, fail_on)) {
        (Some(why), _) => answer::verdict(why),
        (None, Answer::Passes(_)) => Verdict::Pass,
        (None, Answer::Fails) => Verdict::Fail,
        (None, Answer::Crashed) => Verdict::Incomplete,
        (None, Answer::NotExamined) => {
            let why = answer::no_rule_looked(&urdd);
            answer::verdict(urdd.not_examined.insert(why))
        }
    };
    urdd.reason = urdd.not_examined.as_ref().map(|why| why.reason.clone());
    urdd
}

fn status(check: &Check) -> CheckStatus {
    let (status, reason, skipped) = match &check.outcome {
        Outcome::Passed => (Status::Passed, None, None),
        Outcome::Failed => (Status::Failed, None, None),
        Outcome::Skipped(reason) => {
            let kind = match reason {
                SkipReason::Ignored(_) => Skipped::Ignored,
                SkipReason::Absent(_) => Skipped::Absent,
                SkipReason::ForOthers(_) => Skipped::OtherFormat,
                _ => Skipped::NotVerified,
            };
            (Status::Skipped, Some(reason.to_string()), Some(kind))
        }
        Outcome::Crashed(message) => (Status::Crashed, Some(message.clone()), None),
    };
    CheckStatus { code: check.rule.code.to_string(), status, reason, skipped }
}

/// The rules that were skipped in this way, by reason.
pub(crate) fn by_reason(checks: &[CheckStatus], how: Skipped) -> BTreeMap<&str, Vec<String>> {
    let mut by_reason: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for check in checks.iter().filter(|check| check.skipped == Some(how)) {
        let reason = check.reason.as_deref().unwrap_or_default();
        let codes = by_reason.entry(reason).or_default();
        codes.push(check.code.clone());
    }
    by_reason
}

/// The findings of all checks: by module, then by severity, code and place.
fn findings(modules: &[Module], checks: Vec<Check>) -> Vec<Finding> {
    let paths = modules.iter().map(|module| module.path.as_str());
    let folders: HashMap<&str, usize> = paths.zip(0..).collect();
    let mut findings: Vec<(Option<usize>, Code, Finding)> = Vec::new();
    for mut check in checks {
        for found in std::mem::take(&mut check.findings) {
            let file = found.place.file.as_deref();
            let module = file.and_then(|file| module_of(file, &folders));
            let name = module.map(|idx| modules[idx].name.clone());
            findings.push((module, check.rule.code, finding(name, &check, found)));
        }
    }
    fn order<'a>(
        (module, code, finding): &'a (Option<usize>, Code, Finding),
    ) -> impl Ord + use<'a> {
        let Finding { severity, file, line, column, pointer, .. } = finding;
        (module, Reverse(severity), code, file, line, column, pointer)
    }
    findings.sort_by(|a, b| order(a).cmp(&order(b)));
    findings.into_iter().map(|(_, _, finding)| finding).collect()
}

/// Index of the module whose folder contains a file, or is that path itself.
fn module_of(file: &str, folders: &HashMap<&str, usize>) -> Option<usize> {
    let parents = file.match_indices('/').map(|(end, _)| &file[..end]);
    parents.chain([file]).find_map(|folder| folders.get(folder).copied())
}

fn finding(module: Option<String>, check: &Check, found: Found) -> Finding {
    let here = told(found.place);
    let mut places = vec![here.clone()];
    places.extend(found.more.into_iter().map(told));
    Finding {
        code: check.rule.code.to_string(),
        name: check.rule.name.to_owned(),
        severity: found.severity.unwrap_or(check.severity),
        default_severity: check.rule.severity,
        clause: check.rule.clause.map(str::to_owned),
        consequence: found.consequence.unwrap_or(check.rule.consequence),
        module,
        file: here.file,
        pointer: here.pointer,
        line: here.line,
        column: here.column,
        subject: here.subject,
        message: found.message,
        expected: here.expected,
        actual: here.actual,
        tolerance: found.tolerance,
        magnitude: here.magnitude,
        count: Count::saturating(found.count),
        places_cut: Count::saturating(found.count.saturating_sub(places.len())),
        places,
        programs: here.programs,
    }
}

/// A place without what is expected and found if they are equal: that says nothing.
fn told(mut place: Place) -> Place {
    if place.expected == place.actual {
        (place.expected, place.actual) = (None, None);
    }
    place
}

/// The folder of every URDD of a run, relative to `current`, with forward slashes: empty if it is `current` itself. For
/// a URDD outside of `current`, its name.
pub fn places(run: &Run, current: &Path) -> Vec<String> {
    let urdds = run.report.urdds.iter().zip(&run.folders);
    let place = |(urdd, folder): (&Urdd, &PathBuf)| {
        relative(folder, current).unwrap_or_else(|| urdd.path.clone())
    };
    urdds.map(place).collect()
}

/// Path of a file of the URDD at `place`, relative to the same folder as `place`. The URDD's folder if `file` is `None`
/// or leads outside of that folder.
pub fn file_in(place: &str, file: Option<&str>) -> String {
    let folder = |place: &str| match place {
        "" => "./".to_owned(),
        place => format!("{place}/"),
    };
    let Some(file) = file else {
        return folder(place);
    };
    let mut parts: Vec<&str> = place.split('/').filter(|part| !part.is_empty()).collect();
    for part in file.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                if parts.pop().is_none() {
                    return folder(place);
                }
            }
            part => parts.push(part),
        }
    }
    if parts.is_empty() { folder(place) } else { parts.join("/") }
}

/// Whether a file of the URDD at `place` is in the folder that `place` is relative to: tools show no other.
pub fn is_inside(place: &str, file: Option<&str>) -> bool {
    file.is_none() || !file_in(place, file).ends_with('/')
}

/// A path as seen from the current folder, with `/`. None if it is outside.
#[doc(hidden)]
pub fn relative(path: &Path, current: &Path) -> Option<String> {
    let whole = plain(&current.join(path));
    let inside = whole.strip_prefix(plain(current)).ok()?;
    let parts: Vec<_> =
        inside.components().map(|part| part.as_os_str().to_string_lossy()).collect();
    Some(parts.join("/"))
}

/// Resolves `.` and `..` in a path.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}
