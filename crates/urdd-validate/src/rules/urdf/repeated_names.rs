//! Reports each link or joint whose name another has.

use crate::rules::prelude::*;
use crate::views::repeated::repeated;

/// Reports each repeated name of `list`: `links` or `joints`, of which one is `one`.
pub(super) fn report<'a>(
    context: &Context,
    list: &str,
    one: &str,
    names: impl Iterator<Item = &'a str>,
    findings: &mut Findings,
) -> Option<()> {
    let file = context.robot_file()?;
    for (index, first, name) in repeated(names) {
        let message =
            format!("another {one} is already named `{name}`; give this one a name of its own");
        Finding::at(&file, format!("/{list}/{index}/name"), message)
            .values(format!("a name that no other {one} has"), format!("`{name}`"))
            .related(Finding::at(
                &file,
                format!("/{list}/{first}/name"),
                format!("the first {one} of this name"),
            ))
            .report(findings);
    }
    Some(())
}
