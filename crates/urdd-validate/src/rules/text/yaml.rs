use super::faults::report_yaml;
use crate::rules::prelude::*;
use urdd_directory::text_fault::TextFaultKind::{self, *};

declare_rule! {
    /// A `module.yaml` is not plain YAML: not well-formed, not UTF-8, with a byte order mark, a
    /// directive, more than one document, or keys that are not strings.
    ///
    /// Readers of YAML differ most in what is unusual. A file in this plain form is the same to all of them.
    ///
    /// Mend it at the place that is given, or write it again from `module.json`.
    YML001 "not-yaml", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, KINDS, &[], findings),

    /// A `module.yaml` holds a tag, such as `!Mesh`.
    ///
    /// Safe readers (PyYAML's `safe_load`, most readers in other languages) refuse a file with a tag that
    /// they do not know, and a tagged value is not what `module.json` says.
    ///
    /// Write the choice as `module.json` has it, as a mapping of one key: `geometry: {Mesh: {...}}`.
    YML002 "yaml-tag", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlTag], &[], findings),

    /// A `module.yaml` holds an anchor (`&a`) or an alias (`*a`).
    ///
    /// JSON has nothing like it, not every reader knows it, and a few lines of aliases can stand for
    /// gigabytes. (Aliases are not followed here.)
    ///
    /// Write the value out at each place. Programs that make anchors by themselves have an option against
    /// it (PyYAML: a dumper whose `ignore_aliases` is true).
    YML003 "yaml-anchor", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlAnchorOrAlias], &[], findings),

    /// A `module.yaml` holds a merge key (`<<`).
    ///
    /// It is a habit of YAML 1.1 and was never part of YAML 1.2: to some readers it is a key named `<<`.
    ///
    /// Write the keys out at each place.
    YML004 "yaml-merge-key", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlMergeKey], &[], findings),

    /// A `module.yaml` has a key twice in one mapping.
    ///
    /// Some readers keep the first value, some the last, and some refuse the file.
    ///
    /// Remove one of the two.
    YML005 "yaml-repeated-key", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlDuplicateKey], &[], findings),

    /// A `module.yaml` holds a word that YAML 1.1 and YAML 1.2 read differently.
    ///
    /// To PyYAML and to every other reader of YAML 1.1 `1e-7` is a string and `no` is false; to readers of
    /// YAML 1.2 `1e-7` is a number and `no` is a string. A program gets text where it wants a bound, or a
    /// link named false.
    ///
    /// Write numbers with a point and a signed exponent (`1.0e-7`), and put quotes around strings that
    /// look like something else (`"no"`, `"1:30"`, `"0x1"`).
    YML006 "yaml-ambiguous", Error, clause "3.2.3", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlAmbiguousScalar], &[], findings),

    /// A `module.yaml` does not say what `module.json` says.
    ///
    /// Readers of the one and of the other see two robots. Most often one of the two was edited, or
    /// written again, and the other was not.
    ///
    /// Write both from one source; where a person edits, edit `module.json`, which is the one that counts,
    /// and write `module.yaml` from it.
    YML007 "yaml-differs", Error, clause "3.2.1", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlDiffers], UNREAD, findings),

    /// A `module.yaml` is nested more than 100 deep.
    ///
    /// No document of this format comes near that, and readers that follow the nesting run out of stack.
    ///
    /// Write it again from `module.json`.
    YML008 "yaml-too-deep", Error, clause "3.2.2", since "0.1.0",
    phase Syntax, needs [], check |context, findings| report_yaml(context, &[YamlTooDeep], &[], findings),
}

const KINDS: &[TextFaultKind] = &[
    YamlSyntax,
    YamlNotUtf8,
    YamlByteOrderMark,
    YamlDirective,
    YamlSeveralDocuments,
    YamlNonStringKey,
];

/// Faults that end the reading: what the YAML then lacks follows from them.
const UNREAD: &[TextFaultKind] = &[YamlSyntax, YamlNotUtf8, YamlTooDeep];
