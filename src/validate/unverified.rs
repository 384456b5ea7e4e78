//! What was not verified of a URDD's geometry.

use std::collections::{BTreeMap, BTreeSet};

use super::Examined;
use super::code::Code;
use super::engine::Outcome;
use super::part::{Part, Why};
use super::rule::Phase;

impl Examined {
    /// Every part that some rule did not verify: which rules, and why not.
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

    /// The links of which some mesh was not verified, each once: all of them where a rule about
    /// geometry did not run because of a fault.
    pub fn links_not_verified(&self) -> BTreeSet<usize> {
        let mut links: BTreeSet<usize> =
            self.not_verified().keys().map(|part| part.link()).collect();
        let skipped = self.checks.iter().any(|check| match &check.outcome {
            Outcome::Skipped(reason) => check.rule.phase == Phase::Geometry && reason.is_obstacle(),
            Outcome::Crashed(_) => check.rule.phase == Phase::Geometry,
            _ => false,
        });
        if let (true, Some(all)) = (skipped, self.size.links) {
            links.extend(0..all);
        }
        links
    }
}
