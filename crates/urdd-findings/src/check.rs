//! What became of a rule, and of all rules over one URDD or URDF: outcomes, findings, and what was not verified.

use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::answer::not_examined;
use super::code::Code;
use super::description::{Description, Phase};
use super::finding::{Finding, Findings};
use super::part::{Faulted, NotVerified, Part, Scope, SkipReason, Why};
use urdd_directory::position::Position;
use urdd_format::index::Count;
use urdd_format::registry::ModuleKind;
use urdd_format::report::{
    Cause, Kind, LinkNotVerified, ModelNotVerified, NotExamined, Place, Severity, Size, Urdd,
    Verdict,
};

/// The outcome of a rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// It ran and found nothing.
    Passed,
    /// It ran and found something.
    Failed,
    /// It did not run to its end, for this reason.
    Skipped(SkipReason),
    /// The rule itself is faulty; the message says how.
    Crashed(String),
}

/// A rule and its outcome.
pub struct Check {
    /// What the rule says of itself.
    pub rule: &'static Description,
    /// Severity of its findings: the rule's, unless settings change it.
    pub severity: Severity,
    /// Its outcome.
    pub outcome: Outcome,
    /// Its findings.
    pub findings: Vec<Finding>,
    /// Which of these follow from findings of other rules.
    pub effects: Vec<FollowsFrom>,
    /// The parts of the robot that it did not verify.
    pub not_verified: Vec<NotVerified>,
    /// The parts with findings.
    pub faulted: Faulted,
    /// The parts that it was to judge.
    pub scope: Scope,
}

/// A finding of a rule that goes away when the fault of another one is mended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FollowsFrom {
    /// Where it is.
    pub at: Position,
    /// What it says.
    pub message: String,
    /// The finding that it follows from: its rule, and where it is.
    pub cause: (Code, Position),
}

impl Check {
    /// What a rule found.
    pub fn new(rule: &'static Description, outcome: Outcome, findings: Vec<Finding>) -> Self {
        Check {
            rule,
            severity: rule.severity,
            outcome,
            findings,
            effects: Vec::new(),
            not_verified: Vec::new(),
            faulted: Faulted::default(),
            scope: Scope::default(),
        }
    }

    /// All places of its findings, each with what it says.
    pub fn said(&self) -> impl Iterator<Item = (&Place, &str)> {
        self.findings.iter().flat_map(Finding::said)
    }

    /// A rule that does not run.
    pub fn skipped(rule: &'static Description, reason: SkipReason) -> Self {
        Check::new(rule, Outcome::Skipped(reason), Vec::new())
    }

    /// The result of a rule's check, whatever it judges. `None` from it without a reason given to [`Findings::skip`] is a
    /// fault of the rule. Places are left as the rule gave them.
    pub fn caught(
        rule: &'static Description,
        findings: &mut Findings,
        check: impl FnOnce(&mut Findings) -> Option<()>,
    ) -> Check {
        let crashed = |message| Check::new(rule, Outcome::Crashed(message), Vec::new());
        let completed = match catch_unwind(AssertUnwindSafe(|| check(findings))) {
            Ok(completed) => completed.is_some(),
            Err(panic) => return crashed(panic_message(&*panic)),
        };
        let undeclared = !completed && findings.skipped.is_none();
        if undeclared && cfg!(debug_assertions) {
            let code = rule.code;
            return crashed(format!("{code} takes something that it does not declare in `needs`"));
        }
        let scope = &findings.scope;
        let undeclared = || undeclared.then_some(SkipReason::UndeclaredNeed);
        let nothing_left = || scope.nothing_left().map(SkipReason::Failed);
        let skipped = findings.skipped.clone().or_else(undeclared).or_else(nothing_left);
        let (not_verified, scope) = (scope.not_verified(), scope.afresh());
        let faulted = findings.faulted.clone();
        let mut found = findings.take();
        found.iter_mut().for_each(worst_first);
        let outcome = match (found.is_empty(), skipped) {
            (false, _) => Outcome::Failed,
            (true, Some(reason)) => Outcome::Skipped(reason),
            (true, None) => Outcome::Passed,
        };
        Check { not_verified, scope, faulted, ..Check::new(rule, outcome, found) }
    }
}

fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "unknown".to_owned())
}

/// Puts the worst place of a finding first, by magnitude.
pub(super) fn worst_first(finding: &mut Finding) {
    // A magnitude that is not finite is the worst.
    let size = |place: &Place| match &place.magnitude {
        None => f64::NEG_INFINITY,
        Some(magnitude) => magnitude.value.unwrap_or(f64::INFINITY),
    };
    finding.more.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let Some(worst) = finding.more.first_mut() else {
        return;
    };
    if size(worst) > size(&finding.place) {
        std::mem::swap(&mut finding.place, worst);
        if let Some(message) = finding.place.message.take() {
            let first = std::mem::replace(&mut finding.message, message);
            for other in &mut finding.more {
                match &other.message {
                    None => other.message = Some(first.clone()),
                    Some(same) if *same == finding.message => other.message = None,
                    Some(_) => {}
                }
            }
        }
        // Sorts the former first place in among the others.
        finding.more.sort_by(|a, b| size(b).total_cmp(&size(a)));
    }
}

type Whys = BTreeSet<(Code, String)>;

/// One examined URDD or URDF.
pub struct Examined {
    /// Its report, still without the results of the checks.
    pub report: Urdd,
    /// The result of every rule, in order of code.
    pub checks: Vec<Check>,
}

impl Examined {
    /// One that was not examined.
    pub fn without_checks(kind: Kind, name: &str, why: NotExamined) -> Self {
        let report = Urdd { not_examined: Some(why), ..blank(kind, name) };
        Examined { report, checks: Vec::new() }
    }

    /// Examines a URDD or URDF. If it cannot be read, or if the program crashes outside a rule, its report says so; others
    /// still have their reports.
    pub fn caught(
        kind: Kind,
        name: &str,
        examine: impl FnOnce() -> Result<Examined, NotExamined>,
    ) -> Examined {
        let why = match catch_unwind(AssertUnwindSafe(examine)) {
            Ok(Ok(examined)) => return examined,
            Ok(Err(why)) => why,
            Err(panic) => {
                let message = panic_message(&*panic);
                let reason = format!(
                    "the program crashed: {message}; this is a bug in the program, please report it"
                );
                not_examined(Cause::Crash, reason)
            }
        };
        Examined::without_checks(kind, name, why)
    }

    /// Every part that some rule did not verify, with the rules and reasons.
    pub fn not_verified(&self) -> BTreeMap<Part, Vec<(Code, Why)>> {
        let mut parts: BTreeMap<Part, Vec<(Code, Why)>> = BTreeMap::new();
        for check in &self.checks {
            for one in &check.not_verified {
                let why = (check.rule.code, one.why);
                parts.entry(one.part).or_default().push(why);
            }
        }
        parts
    }

    /// The links with a mesh or shape that was not verified. All links if a fault kept a rule about geometry from
    /// running.
    pub fn links_not_verified(&self) -> Vec<LinkNotVerified> {
        let mut links: BTreeMap<usize, Whys> = BTreeMap::new();
        for (part, whys) in self.not_verified() {
            let whys = whys.into_iter().map(|(code, why)| (code, why.to_string()));
            links.entry(part.link()).or_default().extend(whys);
        }
        for check in &self.checks {
            let why = match &check.outcome {
                Outcome::Skipped(reason) if reason.is_obstacle() => reason.to_string(),
                Outcome::Crashed(_) => SkipReason::Crashed(check.rule.code).to_string(),
                _ => continue,
            };
            if check.rule.phase == Phase::Geometry {
                for link in 0..self.report.size.links.map_or(0, Count::get) {
                    let whys = links.entry(link).or_default();
                    whys.insert((check.rule.code, why.clone()));
                }
            }
        }
        let link = |(link, whys)| {
            let (codes, reasons) = codes_and_reasons(whys);
            LinkNotVerified { link: Count::saturating(link), codes, reasons }
        };
        links.into_iter().map(link).collect()
    }

    /// Why the rates of the self-collision model were not verified. `None` if a rule verified them or found them wrong,
    /// and without a model.
    pub fn model_not_verified(&self) -> Option<ModelNotVerified> {
        let name = ModuleKind::SelfCollisionModel.name();
        let counting = [Code::LRN010, Code::LRN011];
        let checks = self.checks.iter().filter(|check| counting.contains(&check.rule.code));
        let mut failed = checks.clone().map(|check| &check.outcome);
        let mut modules = self.report.modules.iter();
        if failed.any(|outcome| *outcome == Outcome::Failed)
            || modules.all(|module| module.name != name)
        {
            return None;
        }
        let why = |check: &Check| match &check.outcome {
            Outcome::Skipped(SkipReason::Ignored(_) | SkipReason::ForOthers(_)) => None,
            Outcome::Skipped(reason) => Some((check.rule.code, reason.to_string())),
            Outcome::Crashed(_) => {
                Some((check.rule.code, SkipReason::Crashed(check.rule.code).to_string()))
            }
            Outcome::Passed | Outcome::Failed => None,
        };
        let (codes, reasons) = codes_and_reasons(checks.filter_map(why).collect());
        (!codes.is_empty()).then_some(ModelNotVerified { codes, reasons })
    }
}

/// The report on a URDD before anything is known about it. `path` is its path in the report.
pub fn blank(kind: Kind, path: &str) -> Urdd {
    Urdd {
        kind,
        path: path.to_owned(),
        name: None,
        xacro_arguments: Vec::new(),
        // Until its answer is known.
        verdict: Verdict::Unreadable,
        reason: None,
        not_examined: None,
        size: Size::default(),
        modules: Vec::new(),
        checks: Vec::new(),
        findings: Vec::new(),
        not_checked: Vec::new(),
        geometry_not_verified: Vec::new(),
        model_not_verified: None,
        programs: Vec::new(),
        imported: None,
    }
}

/// The codes and the reasons, each once and in order.
fn codes_and_reasons(whys: Whys) -> (Vec<String>, Vec<String>) {
    let (codes, reasons): (BTreeSet<Code>, BTreeSet<String>) = whys.into_iter().unzip();
    let codes = codes.iter().map(ToString::to_string).collect();
    (codes, reasons.into_iter().collect())
}
