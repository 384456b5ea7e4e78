use super::repeated_names;
use crate::rules::prelude::*;

declare_rule! {
    /// Two joints have one name.
    ///
    /// Mimics, joint states, commands and controllers say which joint they mean by its name. With
    /// two of one name the wrong motor may turn. (A joint and a link may share a name.)
    ///
    /// Give every joint a different name in the URDF, and write the URDD again.
    URD003 "duplicate-joint-name", Error, clause "6.1.3", since "0.1.0",
    phase References, needs [Module(Kind::Urdf)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let joints = context.robot()?.joints.iter();
    let names = joints.map(|joint| joint.name.as_str());
    repeated_names::report(context, "joints", "joint", names, findings)
}
