use super::annotated::report;
use crate::rules::prelude::*;
use crate::views::annotated::Judged;

declare_rule! {
    /// A number in the document of an extension is not an index of what its schema says.
    ///
    /// The schema annotates the number with `x-index`: it is the index of a link, a joint, a DOF and so
    /// on. There is none of this index, so a program that looks it up fails. Most often the extension is
    /// stale: it was written before a link or joint was added or removed.
    ///
    /// Write the extension again for the robot as it is now, or correct `x-index` in `schema.json`.
    EXT003 "extension-index-out-of-range", Error, clause "11.5", since "1.0.0",
    phase References, needs [MESHES_LISTED, NotFailed(DOF001)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report(context, Judged::Index, findings)
}
