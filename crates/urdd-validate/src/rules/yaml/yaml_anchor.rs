use crate::rules::prelude::*;

declare_rule! {
    /// A `module.yaml` holds an anchor (`&a`) or an alias (`*a`).
    ///
    /// JSON has nothing like it, not every reader knows it, and a few lines of aliases can stand for
    /// gigabytes. (Aliases are not followed here.)
    ///
    /// Write the value out at each place. Programs that make anchors by themselves have an option against
    /// it (PyYAML: a dumper whose `ignore_aliases` is true).
    YML003 "yaml-anchor", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_yaml(context, &[TextFaultKind::YamlAnchorOrAlias], &[], findings)
}
