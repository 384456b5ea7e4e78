//! The result of a run over URDDs or URDFs.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::description::Description;
use super::examined::Examined;
use super::report;
use super::settings::Settings;
use urdd_format::report::Report;

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
            report: report::fill(examined, settings),
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
