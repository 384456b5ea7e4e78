use crate::rules::prelude::*;

declare_rule! {
    /// A module folder is there that `urdd.json` does not list.
    ///
    /// Programs that go by the list do not see the module, and programs that look for folders do: two
    /// readers see two robots. Its files have no hash either, so that a change of them is not noticed.
    ///
    /// Add the module to `modules` of `urdd.json`, or delete the folder.
    DIR003 "unlisted-module", Error, clause "2.3", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    // By name too: DIR021 reports an entry with the right name and a wrong path.
    let mut listed = HashSet::new();
    for entry in listed_modules(context)? {
        listed.insert(entry.entry.path.as_str());
        listed.insert(entry.entry.name.as_str());
    }
    for module in entries::known_modules(context) {
        if !listed.contains(module.folder.as_str()) && !listed.contains(module.name()) {
            let message =
                "urdd.json does not list this module: add it to `modules`, or delete the folder";
            Finding::in_file(&module.folder, message).report(findings);
        }
    }
    Some(())
}
