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
    phase References, needs [Module(Kind::Urdf)], of Robot, check |described, findings| report(described, "link", findings),

    /// Two joints have one name.
    ///
    /// Mimics, joint states, commands and controllers say which joint they mean by its name. With
    /// two of one name the wrong motor may turn. (A joint and a link may share a name.)
    ///
    /// Give every joint a different name in the URDF, and write the URDD again.
    URD003 "duplicate-joint-name", Error, clause "6.1.3", since "0.1.0",
    phase References, needs [Module(Kind::Urdf)], of Robot, check |described, findings| report(described, "joint", findings),
}

/// Reports each repeated name of a `link` or a `joint`.
fn report(described: &Described, one: &str, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    let names: Vec<&str> = match one {
        "link" => robot.links.iter().map(|link| link.name.as_str()).collect(),
        _ => robot.joints.iter().map(|joint| joint.name.as_str()).collect(),
    };
    for (index, first, name) in repeated(names.into_iter()) {
        let at = |index: usize, message: String| {
            finding_in(described, format!("/{one}s/{index}/name"), message)
        };
        let message =
            format!("another {one} is already named `{name}`; give this one a name of its own");
        at(index, message)
            .values(format!("a name that no other {one} has"), format!("`{name}`"))
            .related(at(first, format!("the first {one} of this name")))
            .report(findings);
    }
    Some(())
}
