//! How many differences a report has.

use urdd_format::diff_report::DiffReport;

/// Number of differences: entries of all lists but the notes.
pub(super) fn count(report: &DiffReport) -> usize {
    let lists = [
        report.robot.len(),
        report.links.len(),
        report.joints.len(),
        report.materials.len(),
        report.other_elements.len(),
        usize::from(report.poses.is_some()),
        report.dofs.len(),
        report.pairs.as_ref().map_or(0, Vec::len),
        report.srdf.as_ref().map_or(0, Vec::len),
        report.setup.as_ref().map_or(0, Vec::len),
        report.lost.as_ref().map_or(0, Vec::len),
        report.configurations.as_ref().map_or(0, Vec::len),
        report.modules.as_ref().map_or(0, Vec::len),
        report.findings.as_ref().map_or(0, Vec::len),
    ];
    lists.iter().sum()
}
