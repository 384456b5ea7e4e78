//! `composition_module`: how a robot was composed of others.

use super::index::{JointIdx, LinkIdx, RobotIdx};
use super::root_metadata::Sha256;
use super::types::module;

module! {
    /// How this robot was combined from others, its parts. The robot itself is defined by the URDF
    /// that the URDD carries; this module says which part each of its links and joints came from.
    pub struct CompositionModule {
        /// The link that carries all parts and belongs to none of them; null where a part is the root.
        pub base: Option<CompositionBase>,
        /// The parts, in the order in which they stand in the URDF. The place in this list is the part's
        /// index.
        pub parts: Vec<CompositionPart> where { length: "parts" },
    }

    /// A link that carries all parts and belongs to none of them.
    pub struct CompositionBase {
        /// The link.
        pub link_idx: LinkIdx where { index: "link or other" },
    }

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

    /// The source of a part: the SHA-256 of the file that identifies it.
    pub enum PartSource {
        /// A URDD: of its `urdd.json`, which has the hashes of all its files.
        Urdd(Sha256),
        /// A URDF, or a file that makes one: of the file.
        Urdf(Sha256),
    }

    /// A link of a part.
    pub struct PartLink {
        /// Its name in the part.
        pub name: String,
        /// The link of this robot.
        pub link_idx: LinkIdx where { index: "link or other" },
    }

    /// A joint of a part.
    pub struct PartJoint {
        /// Its name in the part.
        pub name: String,
        /// The joint of this robot.
        pub joint_idx: JointIdx where { index: "joint or other" },
    }

    /// A joint that moved in the part, and is fixed in this robot.
    pub struct FrozenJoint {
        /// The joint.
        pub joint_idx: JointIdx where { index: "joint or other" },
        /// Where it was made fixed: a value for each DOF that it had, rad or m.
        pub position: Vec<f64> where { unit: "rad or m" },
    }

    /// What a part hangs on.
    pub struct PartAttachment {
        /// The part that carries it; null for the base.
        pub part_idx: Option<RobotIdx> where { index: "part or other" },
        /// The link that carries it.
        pub link_idx: LinkIdx where { index: "link or other" },
        /// The joint between that link and the part's root link.
        pub joint_idx: JointIdx where { index: "joint or other" },
    }

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
