use crate::rules::prelude::*;

declare_rule! {
    /// Two names in one folder differ only in letter case.
    ///
    /// On Windows, on macOS and in many archives the two are one: when the URDD is copied or unpacked
    /// there, one file silently takes the place of the other, and the hashes in `urdd.json` no longer
    /// hold.
    ///
    /// Rename one of the two, and name it in the documents as it is called then.
    DIR027 "names-differ-in-case", Error, clause "2.9", since "0.2.0",
    phase Files, needs [Version1],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let source = source(context).map(|file| file.path.as_str());
    // Other files in the root do not belong to the URDD.
    let is_of_urdd = |path: &str| {
        let folders = entries::known_modules(context).map(|module| module.folder.as_str());
        path == ROOT_METADATA
            || Some(path) == source
            || folders
                .into_iter()
                .any(|folder| path == folder || is_in(path, folder) || is_in(folder, path))
    };
    let mut alike: BTreeMap<(&str, String), Vec<&str>> = BTreeMap::new();
    for entry in &context.listing().entries {
        let (folder, name) = entry.path.rsplit_once('/').unwrap_or(("", &entry.path));
        let paths = alike.entry((folder, name.to_lowercase())).or_default();
        paths.push(&entry.path);
    }
    for paths in alike.values() {
        if let [first, second, ..] = paths.as_slice()
            && paths.iter().any(|path| is_of_urdd(path))
        {
            let message = format!(
                "this name differs from that of {first} only in letter case, and many file systems treat the two as one: rename one"
            );
            Finding::in_file(*second, message).count(paths.len() - 1).report(findings);
        }
    }
    Some(())
}

/// Whether a path is below a folder.
fn is_in(path: &str, folder: &str) -> bool {
    let rest = path.strip_prefix(folder);
    rest.is_some_and(|rest| rest.starts_with('/'))
}
