use crate::rules::prelude::*;
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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut reported = HashSet::new();
    for module in context.modules() {
        if !entries::is_known(context, module) {
            reported.insert(module.folder.as_str());
            Finding::in_file(&module.folder, message(&module.folder)).report(findings);
        }
    }
    // Folders that are modules only according to urdd.json.
    for entry in entries::all(context) {
        let folder = entry.entry.path.as_str();
        let known = entry.kind.is_some() || is_extension(folder);
        if !known && context.listing().has_folder(folder) && reported.insert(folder) {
            Finding::in_file(folder, message(folder)).report(findings);
        }
    }
    Some(())
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
