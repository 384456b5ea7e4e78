//! Faults in the text of documents, recorded when the documents were read.

use crate::context::Context;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::text_fault::{TextFault, TextFaultKind, TextFaults};
use urdd_document::entries;
use urdd_document::module::Mirror;
use urdd_findings::finding::{Finding, Findings, KEPT_PLACES, Place};
use urdd_format::index::Count;

/// Reports the faults of this kind in `urdd.json` and every `module.json`: one finding per file, with their
/// number.
pub(super) fn report_json(
    context: &Context,
    kind: TextFaultKind,
    findings: &mut Findings,
) -> Option<()> {
    if let Some(faults) = context.metadata_file().json.faults() {
        report(ROOT_METADATA, faults, &[kind], findings);
    }
    for module in entries::known_modules(context) {
        if let Some(faults) = module.json.faults() {
            report(&module.file("module.json"), faults, &[kind], findings);
        }
    }
    Some(())
}

/// Like [`report_json`] of several kinds, for every `module.yaml` without a fault of the kinds in `unless`.
pub(super) fn report_yaml(
    context: &Context,
    kinds: &[TextFaultKind],
    unless: &[TextFaultKind],
    findings: &mut Findings,
) -> Option<()> {
    for module in entries::known_modules(context) {
        if let Mirror::Compared(faults) = &module.mirror
            && unless.iter().all(|kind| faults.total(*kind) == 0)
        {
            report(&module.file("module.yaml"), faults, kinds, findings);
        }
    }
    Some(())
}

fn report(file: &str, faults: &TextFaults, kinds: &[TextFaultKind], findings: &mut Findings) {
    for kind in kinds {
        let mut kept = faults.iter().filter(|fault| fault.kind == *kind);
        let Some(first) = kept.next() else { continue };
        let mut finding = Finding::in_file(file, first.message.clone());
        finding.place = place(file, first);
        finding.count = faults.total(*kind);
        finding.more = kept.take(KEPT_PLACES - 1).map(|fault| place(file, fault)).collect();
        findings.report(finding);
    }
}

fn place(file: &str, fault: &TextFault) -> Place {
    Place {
        file: Some(file.to_owned()),
        pointer: fault.pointer.clone(),
        line: fault.position.map(|position| Count(position.line)),
        column: fault.position.map(|position| Count(position.column)),
        expected: fault.expected.clone(),
        actual: fault.found.clone(),
        ..Place::default()
    }
}
