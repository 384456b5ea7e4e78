use crate::rules::prelude::*;

declare_rule! {
    /// A `module.yaml` holds a word that YAML 1.1 and YAML 1.2 read differently.
    ///
    /// To PyYAML and to every other reader of YAML 1.1 `1e-7` is a string and `no` is false; to readers of
    /// YAML 1.2 `1e-7` is a number and `no` is a string. A program gets text where it wants a bound, or a
    /// link named false.
    ///
    /// Write numbers with a point and a signed exponent (`1.0e-7`), and put quotes around strings that
    /// look like something else (`"no"`, `"1:30"`, `"0x1"`).
    YML006 "yaml-ambiguous", Error, clause "3.2.3", since "0.1.0",
    phase Syntax, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_yaml(context, &[TextFaultKind::YamlAmbiguousScalar], &[], findings)
}
