use super::parts::Part;
use super::source_differences;
use crate::rules::prelude::*;

declare_rule! {
    /// The links or joints of `urdf_module` are not those of the carried URDF.
    ///
    /// The kinematics of all other modules are derived from this one, and a consumer that trusts it
    /// never opens the URDF. Links and joints must be those of the file, in its order; and type,
    /// origin, parent, child, axis, limits and mimic of each joint too. What the URDF leaves out
    /// must be null, never a default: a missing limit is not a limit of 0. Numbers may differ by
    /// rounding in the tenth digit. (The rest of the module: URD013, and
    /// materials: URD014.)
    ///
    /// Modules of legacy versions are held to the conventions of their time: there, what is absent
    /// is written as zeros.
    ///
    /// Write `urdf_module`, and what is derived from it, again from the URDF that is carried; or
    /// carry the URDF from which the module was written.
    URD001 "joints-not-the-urdfs", Error, clause "6.1.2", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf), CarriedUrdf, Passed(URD011), Passed(URD002), Passed(URD003), ROBOT_SOUND,
        Passed(URD005), Passed(URD007), Passed(URD008), Passed(URD009), Passed(URD010), Passed(URD012),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    source_differences::report(context, findings, Part::Joints)
}
