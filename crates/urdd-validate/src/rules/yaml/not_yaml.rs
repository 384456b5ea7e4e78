use crate::rules::prelude::*;

declare_rule! {
    /// A `module.yaml` is not plain YAML: not well-formed, not UTF-8, with a byte order mark, a
    /// directive, more than one document, or keys that are not strings.
    ///
    /// Readers of YAML differ most in what is unusual. A file in this plain form is the same to all of them.
    ///
    /// Mend it at the place that is given, or write it again from `module.json`.
    YML001 "not-yaml", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [],
}

const KINDS: &[TextFaultKind] = &[
    TextFaultKind::YamlSyntax,
    TextFaultKind::YamlNotUtf8,
    TextFaultKind::YamlByteOrderMark,
    TextFaultKind::YamlDirective,
    TextFaultKind::YamlSeveralDocuments,
    TextFaultKind::YamlNonStringKey,
];

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report_yaml(context, KINDS, &[], findings)
}
