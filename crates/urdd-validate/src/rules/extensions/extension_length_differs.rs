use super::annotated::report;
use crate::rules::prelude::*;
use crate::views::annotated::Judged;

declare_rule! {
    /// A list in the document of an extension has not as many elements as its schema says.
    ///
    /// The schema annotates the list with `x-length`: it has an element for each link, joint, DOF and so
    /// on, and the place in the list is the index. Where an element is missing or too many, every later
    /// one belongs to another link. Most often the extension is stale.
    ///
    /// Write the extension again for the robot as it is now, or correct `x-length` in `schema.json`.
    EXT004 "extension-length-differs", Error, clause "11.5", since "1.0.0",
    phase References, needs [MESHES_LISTED, NotFailed(DOF001)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    report(context, Judged::Length, findings)
}
