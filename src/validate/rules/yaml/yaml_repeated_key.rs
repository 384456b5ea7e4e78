use crate::directory::text_fault::TextFaultKind;
use crate::validate::context::Context;
use crate::validate::finding::Findings;
use crate::validate::rule::declare_rule;
use crate::validate::views::text_faults;

declare_rule! {
    /// A `module.yaml` has a key twice in one mapping.
    ///
    /// Some readers keep the first value, some the last, and some refuse the file.
    ///
    /// Remove one of the two.
    YML005 "yaml-repeated-key", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [],
    check check,
}

const KINDS: &[TextFaultKind] = &[TextFaultKind::YamlDuplicateKey];

fn check(context: &Context, findings: &mut Findings) {
    text_faults::report_yaml(context, KINDS, findings);
}
