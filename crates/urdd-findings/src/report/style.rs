//! Appearance and wording that several renderers share.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use urdd_format::escape::line as safe;
use urdd_format::readable::{counted, first_of};
use urdd_format::report::{Kind, LinkNotVerified, Report, Severity, Urdd};

/// Appearance of the report for people.
#[derive(Debug, Clone, Copy)]
pub struct Style {
    /// Whether to use colours.
    pub color: bool,
    /// Whether to leave out URDDs without findings.
    pub quiet: bool,
    /// Whether to write every URDD in full, regardless of their number.
    pub full: bool,
    /// Maximum number of places per finding.
    pub max_places: usize,
    /// Whether to point to `urdd lint` below a URDF.
    pub suggests_lint: bool,
    /// Maximum line length of the summary, in characters.
    pub width: usize,
}

impl Default for Style {
    fn default() -> Self {
        Style {
            color: false,
            quiet: false,
            full: false,
            max_places: 3,
            suggests_lint: false,
            width: 100,
        }
    }
}

pub(super) const BOLD: &str = "\x1b[1m";
pub(super) const DIM: &str = "\x1b[2m";
pub(super) const RED: &str = "\x1b[31m";
pub(super) const GREEN: &str = "\x1b[32m";
pub(super) const YELLOW: &str = "\x1b[33m";
pub(super) const BLUE: &str = "\x1b[34m";
const PLAIN: &str = "\x1b[0m";

/// Every escape sequence that a report can contain.
pub const STYLES: &[&str] = &[BOLD, DIM, RED, GREEN, YELLOW, BLUE, PLAIN];

impl Style {
    pub(super) fn paint(self, code: &str, text: impl fmt::Display) -> String {
        if self.color { format!("{code}{text}{PLAIN}") } else { text.to_string() }
    }
}

/// The word for a severity, in its colour.
pub(super) fn severity(severity: Severity, style: Style) -> String {
    let color = match severity {
        Severity::Error => RED,
        Severity::Warning => YELLOW,
        Severity::Info => BLUE,
    };
    style.paint(color, severity.as_str())
}

/// A list of codes; if there are many, their number and families.
pub(super) fn list(codes: &[String]) -> String {
    const MOST: usize = 8;
    if codes.len() <= MOST {
        return codes.join(" ");
    }
    let mut families: Vec<&str> = codes.iter().map(|code| &code[..code.len().min(3)]).collect();
    families.sort_unstable();
    families.dedup();
    format!("{} ({})", counted(codes.len(), "rule"), families.join(", "))
}

/// What a report is about.
pub(super) fn unit(report: &Report) -> &'static str {
    let is_urdf = |urdd: &Urdd| urdd.kind == Kind::Urdf;
    if !report.urdds.is_empty() && report.urdds.iter().all(is_urdf) { "URDF" } else { "URDD" }
}

/// Whether rules could not look at a part of it: at meshes that are not there, at rates that were not counted.
pub(super) fn is_in_part(urdd: &Urdd) -> bool {
    !urdd.geometry_not_verified.is_empty() || urdd.model_not_verified.is_some()
}

/// Maximum number of links listed per reason.
const LINKS: usize = 8;

/// States how many links were not verified.
pub(super) fn not_verified(links: usize) -> String {
    format!("the geometry of {} was not verified", counted(links, "link"))
}

/// States that a self-collision model was not verified.
pub(super) const MODEL_NOT_VERIFIED: &str =
    "the rates of the self-collision model were not verified";

/// One line for the links that were not verified, and one for the self-collision model.
pub(super) fn unverified(urdd: &Urdd) -> Vec<String> {
    let model = urdd.model_not_verified.as_ref().map(|model| {
        let reasons = model.reasons.join(", ");
        format!("{MODEL_NOT_VERIFIED} (by {}: {})", list(&model.codes), safe(&reasons))
    });
    describe_links(urdd).into_iter().chain(model).collect()
}

/// The number of links that were not verified, and their indices by reason; `None` if all were verified.
fn describe_links(urdd: &Urdd) -> Option<String> {
    let links = &urdd.geometry_not_verified;
    if links.is_empty() {
        return None;
    }
    let mut by_reasons: BTreeMap<&[String], Vec<&LinkNotVerified>> = BTreeMap::new();
    for link in links {
        by_reasons.entry(&link.reasons).or_default().push(link);
    }
    let described = by_reasons.into_iter().map(|(reasons, links)| {
        let text = first_of(links.iter().map(|link| link.link), LINKS);
        let codes: BTreeSet<String> = links.iter().flat_map(|link| link.codes.clone()).collect();
        let codes = Vec::from_iter(codes);
        let word = if links.len() == 1 { "link" } else { "links" };
        let reasons = reasons.join(", ");
        format!("{word} {text} by {}: {}", list(&codes), safe(&reasons))
    });
    let described: Vec<String> = described.collect();
    Some(format!("{} ({})", not_verified(links.len()), described.join("; ")))
}
