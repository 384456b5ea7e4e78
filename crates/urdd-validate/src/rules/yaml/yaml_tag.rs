use crate::rules::prelude::*;

declare_rule! {
    /// A `module.yaml` holds a tag, such as `!Mesh`.
    ///
    /// Safe readers (PyYAML's `safe_load`, most readers in other languages) refuse a file with a tag that
    /// they do not know, and a tagged value is not what `module.json` says.
    ///
    /// Write the choice as `module.json` has it, as a mapping of one key: `geometry: {Mesh: {...}}`.
    YML002 "yaml-tag", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_yaml(context, &[TextFaultKind::YamlTag], &[], findings)
}
