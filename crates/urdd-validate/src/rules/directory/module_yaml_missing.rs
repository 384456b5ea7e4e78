use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::entries;
use urdd_document::module::{JsonFile, Mirror};

declare_rule! {
    /// A module has no `module.yaml`.
    ///
    /// YAML is what people read and what some programs load; a URDD that lacks it in places works
    /// for some readers and not for others.
    ///
    /// Write the same document as `module.json`, as YAML, beside it.
    DIR010 "module-yaml-missing", Warning, clause "2.4", since "0.1.0",
    phase Files, needs [],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    // Of a file that is listed and not there, DIR011 tells.
    let entries = entries::all(context);
    let listed: HashSet<&str> = entries
        .iter()
        .flat_map(|entry| &entry.entry.files)
        .map(|file| file.path.as_str())
        .collect();
    for module in entries::known_modules(context) {
        let file = module.file("module.yaml");
        if matches!(module.mirror, Mirror::Missing)
            && !matches!(module.json, JsonFile::Missing)
            && !listed.contains(file.as_str())
        {
            findings.report(Finding::in_file(
                file,
                "the module has no module.yaml: write the document of module.json as YAML too",
            ));
        }
    }
}
