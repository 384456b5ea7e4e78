use super::parts::Part;
use super::source_differences;
use crate::rules::prelude::*;

declare_rule! {
    /// A material in `urdf_module` is not the one in the carried URDF.
    ///
    /// The robot is shown in another colour, or in none. Nothing else depends on it: where shapes and
    /// masses differ, URD013 says so. What the URDF leaves out must be null. (Legacy modules write an
    /// absent name as an empty string.)
    ///
    /// Write `urdf_module` again from the URDF that is carried, or carry the URDF from which the module
    /// was written.
    URD014 "materials-not-the-urdfs", Error, clause "6.1.2", since "0.2.0",
    phase References, consequence Appearance, needs [
        Module(Kind::Urdf), CarriedUrdf, Passed(URD011), Passed(URD002), Passed(URD003),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    source_differences::report(context, findings, Part::Materials)
}
