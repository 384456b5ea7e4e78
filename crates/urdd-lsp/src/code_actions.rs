//! Changes that mend findings: one by one, and all safe ones at once.

use std::collections::HashMap;

use lsp_types::{
    CodeAction, CodeActionKind, CodeActionOrCommand, CodeActionParams, OneOf,
    OptionalVersionedTextDocumentIdentifier, Range, TextDocumentEdit, TextEdit, WorkspaceEdit,
};

use crate::diagnostics::{Found, Repair};
use crate::document::Snapshot;

/// All safe fixes of a document, for editors that apply them on save.
pub const FIX_ALL: CodeActionKind = CodeActionKind::SOURCE_FIX_ALL;

/// The actions at a range. `has_versions` states whether the editor takes edits of a version of a document.
pub fn code_actions(
    snapshot: &Snapshot,
    found: &[Found],
    params: &CodeActionParams,
    has_versions: bool,
) -> Vec<CodeActionOrCommand> {
    let wanted = params.context.only.as_deref();
    let wants = |kind: &CodeActionKind| {
        wanted.is_none_or(|wanted| {
            wanted.iter().any(|one| {
                kind.as_str() == one.as_str()
                    || kind.as_str().starts_with(&format!("{}.", one.as_str()))
            })
        })
    };
    let edit = |edits: Vec<TextEdit>| workspace_edit(snapshot, edits, has_versions);
    let mut actions = Vec::new();
    if wants(&CodeActionKind::QUICKFIX) {
        for one in found.iter().filter(|one| touch(one.diagnostic.range, params.range)) {
            for (place, repair) in one.repairs.iter().enumerate() {
                actions.push(CodeAction {
                    title: repair.title.clone(),
                    kind: Some(CodeActionKind::QUICKFIX),
                    diagnostics: Some(vec![one.diagnostic.clone()]),
                    edit: Some(edit(repair.edits.clone())),
                    is_preferred: Some(repair.is_safe && place == 0),
                    ..CodeAction::default()
                });
            }
        }
    }
    let safe = all_safe(found);
    if !safe.is_empty() && wants(&FIX_ALL) {
        actions.push(CodeAction {
            title: format!("fix all safe findings ({})", safe.len()),
            kind: Some(FIX_ALL),
            edit: Some(edit(safe.into_iter().flatten().collect())),
            ..CodeAction::default()
        });
    }
    actions.into_iter().map(CodeActionOrCommand::CodeAction).collect()
}

/// The edits of the first safe fix of each finding, without those that overlap earlier ones.
fn all_safe(found: &[Found]) -> Vec<Vec<TextEdit>> {
    let mut taken: Vec<&Repair> = Vec::new();
    for one in found {
        let Some(repair) = one.repairs.iter().find(|repair| repair.is_safe) else {
            continue;
        };
        let overlaps = |other: &&Repair| {
            let pairs = other.edits.iter();
            let mut pairs = pairs.flat_map(|a| repair.edits.iter().map(move |b| (a, b)));
            pairs.any(|(a, b)| touch(a.range, b.range))
        };
        if !taken.iter().any(overlaps) {
            taken.push(repair);
        }
    }
    taken.into_iter().map(|repair| repair.edits.clone()).collect()
}

/// Whether two ranges overlap, or touch.
fn touch(a: Range, b: Range) -> bool {
    a.start <= b.end && b.start <= a.end
}

fn workspace_edit(snapshot: &Snapshot, edits: Vec<TextEdit>, has_versions: bool) -> WorkspaceEdit {
    let uri = snapshot.uri.clone();
    if has_versions {
        let version = Some(snapshot.version);
        let edit = TextDocumentEdit {
            text_document: OptionalVersionedTextDocumentIdentifier { uri, version },
            edits: edits.into_iter().map(OneOf::Left).collect(),
        };
        return WorkspaceEdit {
            document_changes: Some(lsp_types::DocumentChanges::Edits(vec![edit])),
            ..WorkspaceEdit::default()
        };
    }
    #[expect(clippy::mutable_key_type, reason = "the protocol's type; URIs are not changed")]
    let changes = HashMap::from([(uri, edits)]);
    WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() }
}
