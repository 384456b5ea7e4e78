//! What a run did not verify: geometry, and the rates of the self-collision model.

use std::collections::{BTreeMap, BTreeSet};

use super::check::{Check, Outcome};
use super::code::Code;
use super::description::Phase;
use super::examined::Examined;
use super::part::{Part, Why};
use super::skip::SkipReason;
use urdd_format::index::Count;
use urdd_format::registry::ModuleKind;
use urdd_format::report::{LinkNotVerified, ModelNotVerified};

/// Rules, and their reasons.
type Whys = BTreeSet<(Code, String)>;

impl Examined {
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

/// The codes and the reasons, each once and in order.
fn codes_and_reasons(whys: Whys) -> (Vec<String>, Vec<String>) {
    let (codes, reasons): (BTreeSet<Code>, BTreeSet<String>) = whys.into_iter().unzip();
    let codes = codes.iter().map(ToString::to_string).collect();
    (codes, reasons.into_iter().collect())
}
