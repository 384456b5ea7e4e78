use super::repeated_names;
use crate::rules::prelude::*;

declare_rule! {
    /// Two links have one name.
    ///
    /// Joints, skips and most programs say which link they mean by its name. With two of one name
    /// each reader takes the one it finds first, or last.
    ///
    /// Give every link a different name in the URDF, and write the URDD again.
    URD002 "duplicate-link-name", Error, clause "6.1.3", since "0.1.0",
    phase References, needs [Module(Kind::Urdf)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let links = context.robot()?.links.iter();
    let names = links.map(|link| link.name.as_str());
    repeated_names::report(context, "links", "link", names, findings)
}
