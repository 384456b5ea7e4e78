use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::root::ReadError;
use urdd_document::entries;
use urdd_format::root_metadata::Source;

declare_rule! {
    /// A file that `urdd.json` lists is not there.
    ///
    /// The URDD is not whole: a file was deleted or renamed, or left out of an archive or a commit
    /// (see what `.gitignore` says of mesh files). It may also never have been written.
    ///
    /// Bring the file back, or write `urdd.json` again from what is there.
    DIR011 "listed-file-missing", Error, clause "2.7", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let missing = |path: &str| entries::look(context, path) == Err(ReadError::Missing);
    let report = |findings: &mut Findings, pointer: String, path: &str, message: &str| {
        findings.report(
            Finding::at(ROOT_METADATA, pointer, message)
                .expected("a file")
                .actual(format!("nothing at {path}")),
        );
    };
    let source = context
        .metadata()
        .and_then(|metadata| metadata.source.as_ref());
    if let Some(Source::Urdf(file)) = source
        && missing(&file.path)
    {
        report(
            findings,
            "/source/Urdf/path".to_owned(),
            &file.path,
            "the source URDF is missing: put it into the root folder",
        );
    }
    for entry in entries::all(context) {
        // Of a folder that is not there, DIR002 tells; of VERSION and module.json, DIR005 and DIR004.
        if context.listing().get(&entry.entry.path).is_none() {
            continue;
        }
        for (place, file) in entry.entry.files.iter().enumerate() {
            let own = file.path.strip_prefix(entry.entry.path.as_str());
            let told = entry.module.is_some() && matches!(own, Some("/VERSION" | "/module.json"));
            if !told && missing(&file.path) {
                report(
                    findings,
                    entry.pointer(&format!("files/{place}/path")),
                    &file.path,
                    "the file is missing: restore it, or write urdd.json again from the files that exist",
                );
            }
        }
    }
}
