use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::entries;
use urdd_document::module::is_extension;

declare_rule! {
    /// A module is neither in the specification nor an extension.
    ///
    /// It is not checked, and no other program will know it. Nothing is wrong with that.
    ///
    /// To have it checked, make it an extension: name its folder `x_<vendor>_<name>_module`, of
    /// lower-case letters, digits and `_`, put it into the root, and give it a `schema.json`.
    DIR022 "unknown-module", Info, clause "11.2", since "0.1.0",
    phase Files, needs [],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let mut told = HashSet::new();
    for module in context.modules() {
        if !entries::is_known(context, module) {
            told.insert(module.folder.as_str());
            findings.report(Finding::in_file(&module.folder, message(&module.folder)));
        }
    }
    // Folders that only the list calls modules.
    for entry in entries::all(context) {
        let folder = entry.entry.path.as_str();
        let known = entry.kind.is_some() || is_extension(folder);
        if !known && context.listing().has_folder(folder) && told.insert(folder) {
            findings.report(Finding::in_file(folder, message(folder)));
        }
    }
}

fn message(folder: &str) -> &'static str {
    let name = folder.rsplit('/').next().unwrap_or(folder);
    if is_extension(name) {
        "this extension is not checked, because it is not in the root folder: move it there"
    } else if name.starts_with("x_") {
        "this module is not checked: the folder of an extension is named x_<vendor>_<name>_module, of lower-case letters, digits and `_`"
    } else {
        "this module is not known and not checked; if it is yours, name its folder x_<vendor>_<name>_module and give it a schema.json"
    }
}
