//! The result of examining one URDD or URDF, and what was not verified: geometry, and the rates of the self-collision model.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::check::{Check, Outcome, panic_message};
use super::code::Code;
use super::description::Phase;
use super::part::{Part, Why};
use super::skip::SkipReason;
use urdd_format::index::Count;
use urdd_format::registry::ModuleKind;
use urdd_format::report::{Kind, LinkNotVerified, ModelNotVerified, Size, Urdd, Verdict};

/// Rules, and their reasons.
type Whys = BTreeSet<(Code, String)>;

/// One examined URDD or URDF.
pub struct Examined {
    /// Its report, still without the results of the checks.
    pub report: Urdd,
    /// The result of every rule, in order of code.
    pub checks: Vec<Check>,
}

impl Examined {
    /// One that could not be examined, for this reason.
    pub fn without_checks(kind: Kind, name: &str, verdict: Verdict, reason: String) -> Self {
        let report = Urdd { verdict, reason: Some(reason), ..blank(kind, name) };
        Examined { report, checks: Vec::new() }
    }

    /// Examines a URDD or URDF. If it cannot be read, or if the program crashes outside a rule, its report says so; others
    /// still have their reports.
    pub fn caught<E: Display>(
        kind: Kind,
        name: &str,
        examine: impl FnOnce() -> Result<Examined, E>,
    ) -> Examined {
        let without_checks =
            |verdict, reason| Examined::without_checks(kind, name, verdict, reason);
        match catch_unwind(AssertUnwindSafe(examine)) {
            Ok(Ok(examined)) => examined,
            Ok(Err(error)) => without_checks(Verdict::Unreadable, error.to_string()),
            Err(panic) => {
                let message = panic_message(&*panic);
                let reason = format!(
                    "the program crashed: {message}; this is a bug in the program, please report it"
                );
                without_checks(Verdict::Incomplete, reason)
            }
        }
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
        verdict: Verdict::Pass,
        reason: None,
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
