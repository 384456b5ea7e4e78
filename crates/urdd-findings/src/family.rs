//! The families of rules: what the first three letters of a code stand for.

use crate::code::Code;

/// A family of rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Family {
    /// The three letters with which its codes begin.
    pub code: &'static str,
    /// Its name, in lower case.
    pub name: &'static str,
    /// What its rules check, as a sentence.
    pub about: &'static str,
}

/// A line for each family.
macro_rules! families {
    ($($code:ident $name:literal $about:literal;)*) => {
        &[$(Family { code: stringify!($code), name: $name, about: $about }),*]
    };
}

/// The families, in the order of [`Code::ALL`]; without that of the rule that only tests have.
pub const FAMILIES: &[Family] = families! {
    DIR "directory" "Which files and folders a URDD has, and what `urdd.json` says of them.";
    JSN "JSON" "Whether JSON documents can be read, and mean the same to every reader.";
    YML "YAML" "Whether YAML documents can be read, and say what the JSON beside them says.";
    SCH "schemas" "Whether each document has the form that its module's schema asks for.";
    EXT "extensions" "Modules of your own: their schemas, indices and lengths.";
    URD "kinematic structure" "Links and joints: names, one root, no circle, mimics, and that they are the URDF's.";
    SRC "physics in the URDF" "Masses, inertias, limits and mimics that are impossible or missing.";
    DOF "degrees of freedom" "Which joints move, and which position belongs to which joint.";
    CHN "kinematic chain" "Parents, children, axes, origins and levels of the tree.";
    CON "connections" "The stored paths between links.";
    BND "bounds" "Limits of each DOF: positions, velocities, efforts.";
    CMP "composition" "What a combined robot says of the parts it was made of.";
    MSH "meshes" "Mesh files, hulls and convex pieces, compared with what they stand for.";
    SHP "collision shapes" "Boxes, spheres, skipped pairs of links and distances between links.";
    LRN "learned model" "The learned model of self-collisions, and how often it is wrong.";
    SPH "spheres of links" "Spheres that stand for links: whether they cover, how well they fit, and how often they are right.";
    KIN "kinematics" "Stored poses of links, computed again from the joints.";
    CNF "named configurations" "Configurations with a name, such as `home`.";
    LOP "loops" "Kinematic loops: what holds them, whether they close, and which DOFs move freely.";
    LEG "legacy" "URDDs from before version 1.";
    LNT "lint" "What programs refuse, leave out or read otherwise in a URDF. Only `urdd lint` has them.";
};

impl Family {
    /// The family of a code; `None` for the rule that only tests have.
    pub fn of(code: Code) -> Option<&'static Family> {
        FAMILIES.iter().find(|family| family.code == code.family())
    }
}
