//! What the validator finds of a URDF that is only the rounding of its printed numbers.

use std::collections::{HashMap, HashSet};

use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_findings::part::SkipReason;
use urdd_findings::places::retain;
use urdd_xml::Node;

use crate::subject::{Subject, part_of};
use crate::vocabulary::{child, number};

/// Numbers with few digits are not taken for rounded ones beyond this part.
const MOST: f64 = 1e-3;

/// Leaves out mimic joints that leave their limits by the rounding of these (SRC002).
pub fn leave_out(urdf: &Subject, checks: &mut [Check]) {
    let is_it = |check: &&mut Check| check.rule.code == Code::SRC002 && !check.findings.is_empty();
    let Some(check) = checks.iter_mut().find(is_it) else { return };
    let names = urdf.joints.iter().filter_map(|joint| Some((joint.attribute("name")?, *joint)));
    let by_name: HashMap<&str, Node> = names.collect();
    let is_of_rounding = |joint: &&Node| {
        let parts = || {
            let mimic = child(**joint, "mimic")?;
            let driver = by_name.get(mimic.attribute("joint")?.trim())?;
            let is_last = child(*driver, "mimic").is_none();
            let driver = child(*driver, "limit").filter(|_| is_last)?;
            Some(is_rounded(mimic, child(**joint, "limit")?, driver))
        };
        parts() == Some(true)
    };
    let rounded = urdf.joints.iter().filter(is_of_rounding);
    let rounded: HashSet<String> = rounded.filter_map(|joint| part_of(*joint)).collect();
    retain(check, SkipReason::obstacle(""), |_, place| {
        !place.subject.as_ref().is_some_and(|subject| rounded.contains(subject))
    });
    if check.findings.is_empty() {
        check.outcome = Outcome::Passed;
    }
}

/// Whether what a mimic joint reaches is within its own limits but for half a unit in the last place of each number.
fn is_rounded(mimic: Node, own: Node, driver: Node) -> bool {
    let value = |node: Node, key, default: f64| {
        number(node, key).map_or((default, 0.0), |value| {
            (value, half_unit(node.attribute(key).unwrap_or_default()))
        })
    };
    let (multiplier, of_multiplier) = value(mimic, "multiplier", 1.0);
    let (offset, of_offset) = value(mimic, "offset", 0.0);
    let reached = ["lower", "upper"].map(|key| {
        let (end, of_end) = value(driver, key, 0.0);
        let slack = (multiplier * of_end).abs() + (end * of_multiplier).abs() + of_offset;
        (multiplier * end + offset, slack)
    });
    let [lower, upper] = ["lower", "upper"].map(|key| value(own, key, 0.0));
    let within = |at: f64, slack: f64, end: (f64, f64), sign: f64| {
        let allowed = (slack + end.1).min(MOST * at.abs().max(end.0.abs()));
        sign * (at - end.0) <= allowed
    };
    reached
        .iter()
        .all(|(at, slack)| within(*at, *slack, lower, -1.0) && within(*at, *slack, upper, 1.0))
}

/// Half a unit in the last place of a number as it is written; 0 of a whole one.
pub fn half_unit(text: &str) -> f64 {
    let mut parts = text.trim().split(['e', 'E']);
    let places = parts.next().and_then(|digits| digits.split_once('.'));
    let places = places.map_or(0, |(_, digits)| i32::try_from(digits.len()).unwrap_or(i32::MAX));
    let exponent = parts.next().and_then(|text| text.parse::<i32>().ok()).unwrap_or(0);
    if places == 0 { 0.0 } else { 0.5 * 10_f64.powi(exponent.saturating_sub(places)) }
}
