//! `composition_module`: how a robot was composed of others.

use super::annotations::lengths;
use super::index::{JointIdx, LinkIdx, RobotIdx};
use super::object::{module, object};
use super::root_metadata::Sha256;
use super::tagged::tagged;

module! {
    /// How this robot was combined from others, its parts. The robot itself is defined by the URDF
    /// that the URDD carries; this module says which part each of its links and joints came from.
    pub struct CompositionModule {
        /// The link that carries all parts and belongs to none of them; null where a part is the root.
        pub base: Option<CompositionBase>,
        /// The parts, in the order in which they stand in the URDF. The place in this list is the part's
        /// index.
        #[schemars(transform = lengths("parts"))]
        pub parts: Vec<CompositionPart>,
    }
}

object! {
    /// A link that carries all parts and belongs to none of them.
    pub struct CompositionBase {
        /// The link.
        #[schemars(extend("x-index" = "link or other"))]
        pub link_idx: LinkIdx,
    }
}

object! {
    /// A robot that became a part of another.
    pub struct CompositionPart {
        /// By what name the recipe knows it; unique among the parts.
        pub id: String,
        /// Name of the robot that the part was.
        pub name: String,
        /// What it was taken from, with a digest.
        pub source: PartSource,
        /// What stands before the part's names of links and joints in this robot; empty for nothing.
        pub prefix: String,
        /// The part's links that are in this robot, in link order.
        pub links: Vec<PartLink>,
        /// The part's joints that are in this robot, in joint order.
        pub joints: Vec<PartJoint>,
        /// Names of the part's links that were left out, in the part's order.
        pub dropped_links: Vec<String>,
        /// Names of the part's joints that were left out, in the part's order.
        pub dropped_joints: Vec<String>,
        /// The part's joints that were made fixed, in joint order.
        pub frozen_joints: Vec<FrozenJoint>,
        /// What it hangs on; null for the part that is the root.
        pub attachment: Option<PartAttachment>,
        /// How the part itself was combined; null where it was not combined, or where this is not known.
        pub composition: Option<PartComposition>,
    }
}

tagged! {
    /// The source of a part: the SHA-256 of the file that identifies it.
    pub enum PartSource {
        /// A URDD: of its `urdd.json`, which has the hashes of all its files.
        Urdd(Sha256),
        /// A URDF, or a file that makes one: of the file.
        Urdf(Sha256),
    }
}

object! {
    /// A link of a part.
    pub struct PartLink {
        /// Its name in the part.
        pub name: String,
        /// The link of this robot.
        #[schemars(extend("x-index" = "link or other"))]
        pub link_idx: LinkIdx,
    }
}

object! {
    /// A joint of a part.
    pub struct PartJoint {
        /// Its name in the part.
        pub name: String,
        /// The joint of this robot.
        #[schemars(extend("x-index" = "joint or other"))]
        pub joint_idx: JointIdx,
    }
}

object! {
    /// A joint that moved in the part, and is fixed in this robot.
    pub struct FrozenJoint {
        /// The joint.
        #[schemars(extend("x-index" = "joint or other"))]
        pub joint_idx: JointIdx,
        /// Where it was made fixed: a value for each DOF that it had, rad or m.
        #[schemars(extend("x-unit" = "rad or m"))]
        pub position: Vec<f64>,
    }
}

object! {
    /// What a part hangs on.
    pub struct PartAttachment {
        /// The part that carries it; null for the base.
        #[schemars(extend("x-index" = "part or other"))]
        pub part_idx: Option<RobotIdx>,
        /// The link that carries it.
        #[schemars(extend("x-index" = "link or other"))]
        pub link_idx: LinkIdx,
        /// The joint between that link and the part's root link.
        #[schemars(extend("x-index" = "joint or other"))]
        pub joint_idx: JointIdx,
    }
}

object! {
    /// How a part itself was combined, as the part's own `composition_module` says. Its indices are
    /// those of the part's own modules.
    pub struct PartComposition {
        /// The link that carries all parts and belongs to none of them; null where a part is the root.
        pub base: Option<CompositionBase>,
        /// The parts.
        pub parts: Vec<CompositionPart>,
    }
}

impl From<CompositionModule> for PartComposition {
    fn from(module: CompositionModule) -> Self {
        let CompositionModule { base, parts } = module;
        PartComposition { base, parts }
    }
}
