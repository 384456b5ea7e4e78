//! What was not verified of a URDD's geometry and of its self-collision model.

use std::collections::{BTreeMap, BTreeSet};

use super::Examined;
use super::code::Code;
use super::engine::{Check, Outcome};
use super::part::{Part, Why};
use super::rule::Phase;
use super::skip::SkipReason;
use urdd_format::registry::ModuleKind;

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

    /// The links with a mesh that was not verified, with the rules and reasons. All links, if a fault prevented a rule
    /// about geometry.
    pub fn links_not_verified(&self) -> BTreeMap<usize, BTreeSet<(Code, String)>> {
        let mut links: BTreeMap<usize, BTreeSet<(Code, String)>> = BTreeMap::new();
        for (part, whys) in self.not_verified() {
            let whys = whys.into_iter().map(|(code, why)| (code, why.to_string()));
            links.entry(part.link()).or_default().extend(whys);
        }
        for check in &self.checks {
            let why = match &check.outcome {
                Outcome::Skipped(reason) if reason.is_obstacle() => reason.to_string(),
                Outcome::Crashed(_) => format!("{} crashed", check.rule.code),
                _ => continue,
            };
            if check.rule.phase == Phase::Geometry {
                for link in 0..self.size.links.unwrap_or_default() {
                    let whys = links.entry(link).or_default();
                    whys.insert((check.rule.code, why.clone()));
                }
            }
        }
        links
    }

    /// The rules that did not verify the rates of the self-collision model, with reasons. Empty if they verified or
    /// refuted them, or if there is no model.
    pub fn model_not_verified(&self) -> BTreeSet<(Code, String)> {
        let name = ModuleKind::SelfCollisionModel.name();
        let counting = [Code::LRN010, Code::LRN011];
        let checks = self.checks.iter();
        let checks: Vec<_> = checks
            .filter(|check| counting.contains(&check.rule.code))
            .collect();
        let mut failed = checks.iter().map(|check| &check.outcome);
        if failed.any(|outcome| *outcome == Outcome::Failed)
            || self.modules.iter().all(|module| module.name != name)
        {
            return BTreeSet::new();
        }
        let why = |check: &&Check| match &check.outcome {
            Outcome::Skipped(SkipReason::Ignored(_)) => None,
            Outcome::Skipped(reason) if reason.is_for_others() => None,
            Outcome::Skipped(reason) => Some((check.rule.code, reason.to_string())),
            Outcome::Crashed(_) => {
                let code = check.rule.code;
                Some((code, format!("{code} crashed")))
            }
            Outcome::Passed | Outcome::Failed => None,
        };
        checks.iter().filter_map(why).collect()
    }
}
