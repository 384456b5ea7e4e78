//! The settings that count for a document: those of the editor, of the nearest `urdd.toml`, and a baseline.

use std::path::Path;
use std::sync::Arc;

use lsp_types::DiagnosticSeverity;

use crate::diagnostics::{Found, at_the_top, further, line_of};
use crate::document::Snapshot;
use urdd_directory::cancellation::Cancellation;
use urdd_findings::baseline::Baseline;
use urdd_findings::check::Examined;
use urdd_findings::settings_file::{SettingsFile, SettingsFileError, nearest};
use urdd_lint::{LintSettings, declared, seen_from};
use urdd_source::robots_of;

/// The settings that count for a document.
pub struct Project {
    pub settings: LintSettings,
    /// What is wrong with the settings, shown in the document.
    pub faults: Vec<Found>,
    /// The document's path from the folder of `urdd.toml`: patterns match it.
    seen: String,
}

impl Project {
    /// Reads the settings. They are read for each analysis: a change needs no restart.
    pub fn of(snapshot: &Snapshot, cancellation: &Cancellation) -> Self {
        let mut settings = snapshot.options.lint_settings(cancellation);
        let mut faults = Vec::new();
        // `None` for a text that is not saved, without an open folder.
        let nearest = nearest(&snapshot.folder);
        let read = nearest.as_deref().map(SettingsFile::read).transpose();
        let file = read.unwrap_or_else(|error| {
            faults.push(broken(snapshot, &error));
            None
        });
        let file = file.unwrap_or_default();
        // An editor shows one robot of a file: the first.
        let robots = declared(&file);
        let first =
            snapshot.path.clone().and_then(|path| robots_of(path, &robots).into_iter().next());
        let arguments = first.map(|robot| robot.arguments).unwrap_or_default();
        settings.source = settings.source.with_declared(&arguments);
        settings.report = file.settings;
        // The user's own comes first.
        let baseline = snapshot.options.baseline.clone().or(file.baseline);
        match baseline.as_deref().map(Baseline::read).transpose() {
            Ok(baseline) => settings.baseline = baseline.map(Arc::new),
            Err(error) => {
                let message = format!("{error}; all findings are shown");
                faults.push(at_the_top(snapshot, DiagnosticSeverity::WARNING, &message));
            }
        }
        let folder = nearest.as_deref().and_then(Path::parent).map(Path::to_owned);
        let path = snapshot.path.as_deref();
        let seen = path.map(|path| seen_from(path, folder.as_slice()));
        Project { settings, faults, seen: seen.unwrap_or_else(|| snapshot.name()) }
    }

    pub fn is_excluded(&self) -> bool {
        let mut excludes = self.settings.report.excludes.iter();
        excludes.any(|exclude| exclude.matches(&self.seen))
    }

    /// The result of the rules without what the settings leave out.
    pub fn apply(&self, snapshot: &Snapshot, mut examined: Examined) -> Examined {
        let path = snapshot.path.as_deref();
        // Those that are declared of it, by which a baseline tells robots of one file apart.
        examined.report.xacro_arguments.clone_from(&self.settings.source.xacro.arguments);
        self.settings.apply(path, self.seen.clone(), examined)
    }
}

fn broken(snapshot: &Snapshot, error: &SettingsFileError) -> Found {
    let message = format!("{error}; until it is mended, the defaults count");
    let mut found = at_the_top(snapshot, DiagnosticSeverity::WARNING, &message);
    let line = error.at.map_or(1, |at| at.line as usize);
    let place = line_of(&error.file, line);
    let related = place.map(|place| vec![further(place, &error.fault.to_string())]);
    found.diagnostic.related_information = related;
    found
}
