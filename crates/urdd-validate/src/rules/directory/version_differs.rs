use crate::rules::prelude::*;

declare_rule! {
    /// `urdd.json` and a module's `VERSION` name different versions.
    ///
    /// Programs read the one or the other, and then read the same document by different rules. Most
    /// often a module was written again by a newer program, and `urdd.json` was not.
    ///
    /// Write the version of the format that the module has into both.
    DIR007 "version-differs", Error, clause "2.5", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
}

/// The folders of the modules whose versions differ.
pub fn folders(context: &Context) -> HashSet<&str> {
    let entries = entries::all(context);
    let differing = entries.iter().filter_map(differing);
    differing.map(|(module, _)| module.folder.as_str()).collect()
}

/// The module and the version in its `VERSION` file, if that is a version and differs from the one in `urdd.json`.
fn differing<'a>(entry: &Entry<'a>) -> Option<(&'a Module, &'a str)> {
    let module = entry.module?;
    match &module.version_file {
        VersionFile::Text(text)
            if Version::new(text.as_str()).is_some() && text != entry.entry.version.as_str() =>
        {
            Some((module, text))
        }
        _ => None,
    }
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for entry in listed_modules(context)? {
        if let Some((module, version)) = differing(&entry) {
            let message = format!(
                "{} says {version}: write the version of the module's format into both",
                module.file("VERSION")
            );
            let finding = finding_in(&entry, "version", message);
            findings.report(finding.values(version, &entry.entry.version));
        }
    }
    Some(())
}
