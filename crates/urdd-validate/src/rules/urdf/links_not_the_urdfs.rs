use super::parts::Part;
use super::source_differences;
use crate::rules::prelude::*;

declare_rule! {
    /// What `urdf_module` says of a link, or of the robot, is not what the carried URDF says.
    ///
    /// Shapes and where they are, masses, inertias, joint dynamics and the elements that URDF does not
    /// define must be those of the file. A collision shape that lost its origin is in the wrong place,
    /// and the robot collides there. What the URDF leaves out must be null, never a default. Numbers
    /// may differ by rounding in the tenth digit. (Joints, and which links there are: URD001.
    /// Materials: URD014.)
    ///
    /// Modules of legacy versions are held to the conventions of their time: there, what is absent
    /// is written as zeros, and elements that URDF does not define are lost.
    ///
    /// Write `urdf_module`, and what is derived from it, again from the URDF that is carried; or
    /// carry the URDF from which the module was written.
    URD013 "links-not-the-urdfs", Error, clause "6.1.2", since "0.1.0",
    phase References, consequence WrongPlace, needs [
        Module(Kind::Urdf), CarriedUrdf, Passed(URD011), Passed(URD002), Passed(URD003),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    source_differences::report(context, findings, Part::Rest)
}
