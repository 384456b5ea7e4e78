use super::duplicate_link_name::repeated;
use crate::rules::prelude::*;

declare_rule! {
    /// Two joints have one name.
    ///
    /// Mimics, joint states, commands and controllers say which joint they mean by its name. With
    /// two of one name the wrong motor may turn. (A joint and a link may share a name.)
    ///
    /// Give every joint a different name in the URDF, and write the URDD again.
    URD003 "duplicate-joint-name", Error, clause "6.1.3", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    let names = robot.joints.iter().map(|joint| joint.name.as_str());
    for (index, first, name) in repeated(names) {
        let pointer = format!("/joints/{index}/name");
        let message =
            format!("another joint is already named `{name}`; give this one a name of its own");
        Finding::at(&file, pointer, message)
            .expected("a name that no other joint has")
            .actual(format!("`{name}`, the name of /joints/{first} too"))
            .report(findings);
    }
    Some(())
}
