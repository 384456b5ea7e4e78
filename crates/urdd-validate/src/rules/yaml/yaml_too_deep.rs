use crate::rules::prelude::*;

declare_rule! {
    /// A `module.yaml` is nested more than 100 deep.
    ///
    /// No document of this format comes near that, and readers that follow the nesting run out of stack.
    ///
    /// Write it again from `module.json`.
    YML008 "yaml-too-deep", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_yaml(context, &[TextFaultKind::YamlTooDeep], &[], findings)
}
