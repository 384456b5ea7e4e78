use super::duplicate_link_name::repeated;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;

declare_rule! {
    /// Two joints have one name.
    ///
    /// Mimics, joint states, commands and controllers say which joint they mean by its name. With
    /// two of one name the wrong motor may turn. (A joint and a link may share a name.)
    ///
    /// Give every joint a different name in the URDF, and write the URDD again.
    URD003 "duplicate-joint-name", Error, clause "6.1.3", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    let names = robot.joints.iter().map(|joint| joint.name.as_str());
    for (index, first, name) in repeated(names) {
        findings.report(
            Finding::at(
                file.clone(),
                format!("/joints/{index}/name"),
                format!("there is a joint `{name}` already; give this one a name of its own"),
            )
            .expected("a name that no other joint has")
            .actual(format!("`{name}`, the name of /joints/{first} too")),
        );
    }
}
