use crate::rules::prelude::*;

declare_rule! {
    /// A `module.yaml` has a key twice in one mapping.
    ///
    /// Some readers keep the first value, some the last, and some refuse the file.
    ///
    /// Remove one of the two.
    YML005 "yaml-repeated-key", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_yaml(context, &[TextFaultKind::YamlDuplicateKey], &[], findings)
}
