use crate::rules::prelude::*;

declare_rule! {
    /// A `module.yaml` holds a merge key (`<<`).
    ///
    /// It is a habit of YAML 1.1 and was never part of YAML 1.2: to some readers it is a key named `<<`.
    ///
    /// Write the keys out at each place.
    YML004 "yaml-merge-key", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_yaml(context, &[TextFaultKind::YamlMergeKey], &[], findings)
}
