use crate::rules::prelude::*;

declare_rule! {
    /// A file that `urdd.json` lists is not there.
    ///
    /// The URDD is not whole: a file was deleted or renamed, or left out of an archive or a commit
    /// (see what `.gitignore` says of mesh files). It may also never have been written.
    ///
    /// Bring the file back, or write `urdd.json` again from what is there.
    DIR011 "listed-file-missing", Error, clause "2.7", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut look = |pointer: String, path: &str, message: &str| {
        if entries::look(context, path) == Err(ReadError::Missing) {
            Finding::at(ROOT_METADATA, pointer, message)
                .values("a file", format!("nothing at {path}"))
                .report(findings);
        }
    };
    if let Some(file) = source(context) {
        let message = "the source URDF is missing: put it into the root folder";
        look("/source/Urdf/path".to_owned(), &file.path, message);
    }
    for entry in listed_modules(context)? {
        // DIR002 reports a missing folder; DIR004 and DIR005 report missing module.json and VERSION files.
        if context.listing().get(&entry.entry.path).is_none() {
            continue;
        }
        for (place, file) in entry.entry.files.iter().enumerate() {
            let own = file.path.strip_prefix(entry.entry.path.as_str());
            if entry.module.is_none() || !matches!(own, Some("/VERSION" | "/module.json")) {
                let pointer = entry.pointer(&format!("files/{place}/path"));
                let message = "the file is missing: restore it, or write urdd.json again from the files that exist";
                look(pointer, &file.path, message);
            }
        }
    }
    Some(())
}
