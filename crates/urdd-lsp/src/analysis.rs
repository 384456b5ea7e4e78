//! Finds what is wrong with a document.

use std::collections::BTreeSet;

use lsp_types::DiagnosticSeverity;

use crate::diagnostics::{Found, at_the_top, failures, of_check};
use crate::document::Snapshot;
use crate::kind::FileKind;
use crate::project::Project;
use crate::urdd_documents;
use crate::xacro;
use urdd_directory::cancellation::Cancellation;
use urdd_findings::check::Outcome;
use urdd_findings::report::programs;
use urdd_lint::settings::WITHOUT_MESHES;
use urdd_lint::{LintSettings, lint_text};

/// How much is examined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Only the text: while somebody types.
    Text,
    /// Mesh files too, and what xacro makes of the file: when it is opened or saved.
    Files,
}

/// What was found in a version of a document.
#[derive(Debug, Default)]
pub struct Analysis {
    pub found: Vec<Found>,
    /// The rules that only [`Depth::Files`] runs; those of the last run stay until then.
    pub postponed: Postponed,
    /// What programs do with a URDF, a line for those that do the same.
    pub programs: Vec<String>,
}

/// The rules that were not run.
#[derive(Debug, Default, PartialEq, Eq)]
pub enum Postponed {
    /// Every rule was run.
    #[default]
    None,
    /// These.
    Codes(BTreeSet<&'static str>),
    /// All that [`Depth::Files`] finds.
    All,
}

impl Analysis {
    /// Findings of a run of every rule.
    pub fn of(found: Vec<Found>) -> Self {
        Analysis { found, ..Analysis::default() }
    }

    /// Examines a document. `None` if it is cancelled.
    pub fn new(snapshot: &Snapshot, depth: Depth, cancellation: &Cancellation) -> Option<Self> {
        let analysis = match (snapshot.kind, snapshot.excess()) {
            (FileKind::Other, _) => Analysis::default(),
            (_, Some(excess)) => return Some(too_large(snapshot, excess)),
            (FileKind::Urdf | FileKind::Xacro, None) => of_xml(snapshot, depth, cancellation),
            (FileKind::Urdd { schema, is_yaml }, None) => {
                let found = urdd_documents::check(snapshot, schema, is_yaml);
                Analysis::of(found.into_iter().map(Found::from).collect())
            }
        };
        (!cancellation.is_cancelled()).then_some(analysis)
    }
}

fn too_large(snapshot: &Snapshot, excess: &str) -> Analysis {
    let command = match snapshot.kind {
        FileKind::Urdd { .. } => "urdd validate",
        _ => "urdd lint",
    };
    let message =
        format!("the file is too large for the editor: {excess}; `{command}` examines it");
    Analysis::of(vec![at_the_top(snapshot, DiagnosticSeverity::WARNING, &message)])
}

fn of_xml(snapshot: &Snapshot, depth: Depth, cancellation: &Cancellation) -> Analysis {
    let project = Project::of(snapshot, cancellation);
    if project.is_excluded() {
        return Analysis::default();
    }
    let mut analysis = match (&snapshot.kind, depth) {
        (FileKind::Xacro, Depth::Text) => {
            let found = xacro::of_text(snapshot);
            Analysis { found, postponed: Postponed::All, ..Analysis::default() }
        }
        (FileKind::Xacro, Depth::Files) => Analysis::of(xacro::of_files(snapshot, &project)),
        _ => of_urdf(snapshot, depth, &project),
    };
    analysis.found.extend(project.faults);
    analysis
}

fn of_urdf(snapshot: &Snapshot, depth: Depth, project: &Project) -> Analysis {
    let settings =
        LintSettings { without_meshes: depth == Depth::Text, ..project.settings.clone() };
    let text = snapshot.text.content();
    let examined = lint_text(text, &snapshot.name(), &snapshot.folder, &settings);
    let examined = project.apply(snapshot, examined);
    let checks = examined.checks.iter();
    let mut found: Vec<Found> =
        checks.clone().flat_map(|check| of_check(snapshot, check)).collect();
    found.extend(failures(snapshot, &examined));
    let waiting = checks.filter(|check| check.outcome == Outcome::Skipped(WITHOUT_MESHES));
    let postponed = match depth {
        Depth::Text => Postponed::Codes(waiting.map(|check| check.rule.code.as_str()).collect()),
        Depth::Files => Postponed::None,
    };
    Analysis { found, postponed, programs: programs::lines(examined) }
}
