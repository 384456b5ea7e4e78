use crate::rules::prelude::*;

declare_rule! {
    /// A file in a module's folder has a name that is not UTF-8.
    ///
    /// No document can name it, archives garble it, and on other systems it cannot even be made.
    /// Most often it was unpacked from an archive with names in an old encoding.
    ///
    /// Rename it; derived files are named by link index and ASCII letters.
    DIR024 "name-not-utf8", Error, clause "2.9", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for module in entries::known_modules(context) {
        let mut bad = context.listing().below(&module.folder).filter(|entry| !entry.utf8);
        if let Some(first) = bad.next() {
            let message = "the name is not UTF-8 (shown with replacement characters): rename it";
            Finding::in_file(&first.path, message).count(1 + bad.count()).report(findings);
        }
    }
    Some(())
}
