//! Wording shared by several renderers.

use urdd_format::report::{Kind, Report, Urdd};

/// A list of codes; if there are many, their number and families.
pub(super) fn list(codes: &[String]) -> String {
    const MOST: usize = 8;
    if codes.len() <= MOST {
        return codes.join(" ");
    }
    let mut families: Vec<&str> = codes.iter().map(|code| &code[..code.len().min(3)]).collect();
    families.sort_unstable();
    families.dedup();
    format!("{} ({})", plural(codes.len(), "rule"), families.join(", "))
}

/// What a report is about.
pub(super) fn unit(report: &Report) -> &'static str {
    let is_urdf = |urdd: &Urdd| urdd.kind == Kind::Urdf;
    if !report.urdds.is_empty() && report.urdds.iter().all(is_urdf) { "URDF" } else { "URDD" }
}

/// A count with its unit.
pub(super) fn plural(count: usize, unit: &str) -> String {
    // `dynamics` is its own plural.
    let stays = count == 1 || unit.ends_with('s');
    format!("{count} {unit}{}", if stays { "" } else { "s" })
}
