use crate::rules::prelude::*;
use crate::views::lists::repeated;

declare_rule! {
    /// Two links have one name.
    ///
    /// Joints, skips and most programs say which link they mean by its name. With two of one name
    /// each reader takes the one it finds first, or last.
    ///
    /// Give every link a different name in the URDF, and write the URDD again.
    URD002 "duplicate-link-name", Error, clause "6.1.3", since "0.1.0",
    phase References, needs [Module(Kind::Urdf)], check duplicate_link_name,

    /// Two joints have one name.
    ///
    /// Mimics, joint states, commands and controllers say which joint they mean by its name. With
    /// two of one name the wrong motor may turn. (A joint and a link may share a name.)
    ///
    /// Give every joint a different name in the URDF, and write the URDD again.
    URD003 "duplicate-joint-name", Error, clause "6.1.3", since "0.1.0",
    phase References, needs [Module(Kind::Urdf)], check duplicate_joint_name,
}

fn duplicate_link_name(context: &Context, findings: &mut Findings) -> Option<()> {
    let links = context.robot()?.links.iter();
    let names = links.map(|link| link.name.as_str());
    report(context, "links", "link", names, findings)
}

fn duplicate_joint_name(context: &Context, findings: &mut Findings) -> Option<()> {
    let joints = context.robot()?.joints.iter();
    let names = joints.map(|joint| joint.name.as_str());
    report(context, "joints", "joint", names, findings)
}

/// Reports each repeated name of `list`: `links` or `joints`, of which one is `one`.
fn report<'a>(
    context: &Context,
    list: &str,
    one: &str,
    names: impl Iterator<Item = &'a str>,
    findings: &mut Findings,
) -> Option<()> {
    for (index, first, name) in repeated(names) {
        let message =
            format!("another {one} is already named `{name}`; give this one a name of its own");
        finding_in(context, format!("/{list}/{index}/name"), message)
            .values(format!("a name that no other {one} has"), format!("`{name}`"))
            .related(finding_in(
                context,
                format!("/{list}/{first}/name"),
                format!("the first {one} of this name"),
            ))
            .report(findings);
    }
    Some(())
}
