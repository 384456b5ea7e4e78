use crate::rules::prelude::*;
use urdd_document::module::JsonFile;

declare_rule! {
    /// The URDD has no `urdd.json`.
    ///
    /// The root metadata says which robot this is, which version of the specification to read it
    /// by, what it was made from, and what belongs to it. Without it a reader can only guess, and
    /// cannot tell whether a file was changed or left out.
    ///
    /// Write `urdd.json` into the root folder; `urdd schema show root_metadata@1.0.0` shows its schema. Where
    /// the URDD is from before version 1, none of its modules may be of version 1.
    DIR001 "root-metadata-missing", Error, clause "2.2", since "0.1.0",
    phase Files, needs [Version1],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    if matches!(context.metadata_file().json, JsonFile::Missing) {
        let message = "there is no urdd.json: write the root metadata beside the module folders";
        Finding::in_file(ROOT_METADATA, message).report(findings);
    }
    Some(())
}
