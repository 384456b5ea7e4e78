use crate::rules::prelude::*;

declare_rule! {
    /// A `module.yaml` does not say what `module.json` says.
    ///
    /// Readers of the one and of the other see two robots. Most often one of the two was edited, or
    /// written again, and the other was not.
    ///
    /// Write both from one source; where a person edits, edit `module.json`, which is the one that counts,
    /// and write `module.yaml` from it.
    YML007 "yaml-differs", Error, clause "3.2.1", since "0.1.0",
    phase Syntax, needs [],
}

/// Faults that end the reading: what the YAML then lacks follows from them.
const UNREAD: &[TextFaultKind] =
    &[TextFaultKind::YamlSyntax, TextFaultKind::YamlNotUtf8, TextFaultKind::YamlTooDeep];

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_yaml(context, &[TextFaultKind::YamlDiffers], UNREAD, findings)
}
