//! Finds what is wrong with a document.

use std::collections::BTreeSet;

use lsp_types::DiagnosticSeverity;

use crate::diagnostics::{Found, at_the_top, of_check};
use crate::document::Snapshot;
use crate::failures::failures;
use crate::kind::Kind;
use crate::project::Project;
use crate::urdd_documents;
use crate::xacro;
use urdd_directory::cancellation::Cancellation;
use urdd_findings::check::Outcome;
use urdd_findings::examined::Examined;
use urdd_lint::skip::WITHOUT_MESHES;
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
    /// The findings.
    pub found: Vec<Found>,
    /// The rules that only [`Depth::Files`] runs; those of the last run stay until then.
    pub postponed: Postponed,
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
    /// Examines a document. `None` if it is cancelled.
    pub fn new(snapshot: &Snapshot, depth: Depth, cancellation: &Cancellation) -> Option<Self> {
        if snapshot.kind == Kind::Other {
            return Some(Analysis::default());
        }
        if let Some(excess) = snapshot.excess() {
            return Some(too_large(snapshot, excess));
        }
        let analysis = match &snapshot.kind {
            Kind::Urdf | Kind::Xacro => of_xml(snapshot, depth, cancellation),
            Kind::Urdd { schema, is_yaml } => {
                let found = urdd_documents::check(snapshot, *schema, *is_yaml);
                Analysis {
                    found: found.into_iter().map(Found::from).collect(),
                    postponed: Postponed::None,
                }
            }
            Kind::Other => Analysis::default(),
        };
        (!cancellation.is_cancelled()).then_some(analysis)
    }
}

fn too_large(snapshot: &Snapshot, excess: &str) -> Analysis {
    let command = match snapshot.kind {
        Kind::Urdd { .. } => "urdd validate",
        _ => "urdd lint",
    };
    let message =
        format!("the file is too large for the editor: {excess}; `{command}` examines it");
    Analysis {
        found: vec![at_the_top(snapshot, DiagnosticSeverity::WARNING, &message)],
        postponed: Postponed::None,
    }
}

fn of_xml(snapshot: &Snapshot, depth: Depth, cancellation: &Cancellation) -> Analysis {
    let project = Project::of(snapshot, cancellation);
    if project.is_excluded() {
        return Analysis::default();
    }
    let mut analysis = match (&snapshot.kind, depth) {
        (Kind::Xacro, Depth::Text) => {
            Analysis { found: xacro::of_text(snapshot), postponed: Postponed::All }
        }
        (Kind::Xacro, Depth::Files) => {
            Analysis { found: xacro::of_files(snapshot, &project), postponed: Postponed::None }
        }
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
    let waiting =
        examined.checks.iter().filter(|check| check.outcome == Outcome::Skipped(WITHOUT_MESHES));
    Analysis {
        postponed: match depth {
            Depth::Text => {
                Postponed::Codes(waiting.map(|check| check.rule.code.as_str()).collect())
            }
            Depth::Files => Postponed::None,
        },
        found: found(snapshot, &examined),
    }
}

/// The findings of a report, and that a rule crashed.
fn found(snapshot: &Snapshot, examined: &Examined) -> Vec<Found> {
    let checks = examined.checks.iter();
    let mut found: Vec<Found> = checks.flat_map(|check| of_check(snapshot, check)).collect();
    found.extend(failures(snapshot, examined));
    found
}
