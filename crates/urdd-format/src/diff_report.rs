//! The output of `urdd diff --format json`: how two robots differ.

use super::index::Count;
use super::meshes::GeometryKind;
use super::report::{Kind, Severity, Tool, Verdict};
use super::types::module;

/// Version of the format.
pub const DIFF_REPORT_VERSION: &str = "1.3.0";

module! {
    /// How two robots differ in meaning. Values are texts, as a URDF would have them; numbers are in
    /// their shortest form that reads back as the same 64-bit number.
    pub struct DiffReport {
        /// The program.
        pub tool: Tool,
        /// The first robot: before.
        pub before: DiffSide,
        /// The second robot: after.
        pub after: DiffSide,
        /// Whether nothing differs in meaning: every list below but `notes` is empty.
        pub same: bool,
        /// Differences of the robot itself: its name and its URDF version.
        pub robot: Vec<ValueChange>,
        /// Links that differ, in the order of the first robot, then of the second.
        pub links: Vec<LinkDifference>,
        /// Joints that differ, in the same order.
        pub joints: Vec<PartDifference>,
        /// Materials at the top of the URDF that differ.
        pub materials: Vec<PartDifference>,
        /// Other elements at the top of the URDF that differ (transmission, gazebo, ros2_control, …).
        pub other_elements: Vec<PartDifference>,
        /// What closes kinematic loops, couplings between DOFs, and which DOFs move freely. Since 1.3.0.
        pub loops: Vec<PartDifference>,
        /// Where the links are with all joints at zero; null if no link that both have is elsewhere, or
        /// where the joints of one robot form no tree.
        pub poses: Option<PoseDifference>,
        /// DOFs that are new, gone or at another index, or whose bounds do not follow from their joints.
        pub dofs: Vec<DofDifference>,
        /// Pairs of links that collision checks gain or lose; null where one robot states no skips.
        pub pairs: Option<Vec<PairDifference>>,
        /// Named configurations that are new or gone, or have other positions (fields named as their DOFs); null where
        /// neither is a URDD, or one is a URDF that was not imported. Since 1.1.0.
        pub configurations: Option<Vec<PartDifference>>,
        /// What the SRDFs beside two URDFs, or those of imports, say differently: pairs that are not checked, named
        /// configurations, groups; null where one of the two is a URDD, or an SRDF cannot be read. Since 1.2.0.
        pub srdf: Option<Vec<PartDifference>>,
        /// What the files `NAME.export.toml` beside the robots, or those of imports, say differently: gains, the base,
        /// frictions; null where that of a URDD is missing, or one cannot be read. Since 1.2.0.
        pub setup: Option<Vec<PartDifference>>,
        /// What the imports of two descriptions lose in another number; null unless both are imported. Since 1.2.0.
        pub lost: Option<Vec<PartDifference>>,
        /// Modules that are new or gone, of another version, or with other content. What other lists of this
        /// report compare in detail is not repeated here. Null where one of the two is a URDF.
        pub modules: Option<Vec<ModuleDifference>>,
        /// Findings of `urdd validate` that are new or gone; null where they were not asked for.
        pub findings: Option<Vec<FindingDifference>>,
        /// What was not compared, and what differs without a difference in meaning.
        pub notes: Vec<String>,
    }

    /// One of the two robots.
    pub struct DiffSide {
        /// Its path as given.
        pub path: String,
        /// Whether it is a URDD or a URDF.
        pub kind: Kind,
        /// Name of the robot.
        pub name: String,
        /// Number of links.
        pub links: Count,
        /// Number of joints.
        pub joints: Count,
        /// Number of degrees of freedom.
        pub dofs: Count,
        /// What came of validating it; null where findings were not asked for.
        pub verdict: Option<Verdict>,
    }

    /// What became of a part.
    pub enum Presence {
        /// Only the second robot has it.
        Added = "added",
        /// Only the first robot has it.
        Removed = "removed",
        /// Both have it, and it differs.
        Changed = "changed",
    }

    /// A value that differs.
    pub struct ValueChange {
        /// Which value: `limit.lower`, `origin.xyz`, `visual[0].scale`. An index is that of the first
        /// robot, or of the second where only that has the element.
        pub field: String,
        /// The value of the first robot; null where it has none.
        pub before: Option<String>,
        /// The value of the second robot; null where it has none.
        pub after: Option<String>,
        /// Unit of both; empty for texts and ratios.
        pub unit: String,
    }

    /// A joint, a material or another element that differs.
    pub struct PartDifference {
        /// Its name.
        pub name: String,
        /// What became of it.
        pub presence: Presence,
        /// The values that differ, if both robots have it.
        pub changes: Vec<ValueChange>,
    }

    /// A link that differs.
    pub struct LinkDifference {
        /// Its name.
        pub name: String,
        /// What became of it.
        pub presence: Presence,
        /// The values that differ, except for those of geometry.
        pub changes: Vec<ValueChange>,
        /// Its visual geometry and its collision geometry, if they differ.
        pub geometry: Vec<GeometryDifference>,
    }

    /// The visual or the collision geometry of a link that differs.
    pub struct GeometryDifference {
        /// Which of the two.
        pub geometry: GeometryKind,
        /// The values that differ.
        pub changes: Vec<ValueChange>,
        /// Bounding box in the first robot; null without geometry, or where a mesh could not be read.
        pub bounds_before: Option<DiffBox>,
        /// Bounding box in the second robot.
        pub bounds_after: Option<DiffBox>,
    }

    /// A box along the axes of the link's frame, metres.
    pub struct DiffBox {
        /// Smallest x, y, z.
        pub min: [f64; 3],
        /// Largest x, y, z.
        pub max: [f64; 3],
    }

    /// Links that are elsewhere, relative to the root link, with all joints at zero.
    pub struct PoseDifference {
        /// Names of the links that are in both robots and are elsewhere or turned, in the order of the first.
        pub links: Vec<String>,
        /// The link whose origin is the farthest from where it was.
        pub farthest: String,
        /// How far that is, metres.
        pub distance: f64,
        /// The largest angle by which a link is turned, radians.
        pub angle: f64,
    }

    /// A DOF that differs.
    pub struct DofDifference {
        /// Its name: that of its joint, with a suffix where the joint has several.
        pub name: String,
        /// What became of it.
        pub presence: Presence,
        /// Its index in the first robot.
        pub index_before: Option<Count>,
        /// Its index in the second robot.
        pub index_after: Option<Count>,
        /// What differs without following from the URDF.
        pub changes: Vec<ValueChange>,
    }

    /// What becomes of a pair of links in collision checks.
    pub enum PairChange {
        /// It was skipped and is checked now.
        Gained = "gained",
        /// It was checked and is skipped now.
        Lost = "lost",
        /// Other pieces of the two links are checked.
        Pieces = "pieces",
    }

    /// A pair of links whose collision checks differ.
    pub struct PairDifference {
        /// Names of the two links, in the order of the first robot.
        pub links: [String; 2],
        /// What becomes of it.
        pub change: PairChange,
        /// The kinds of shapes for which this is so: `hulls`, `boxes`, `spheres`, `pieces`, `piece-boxes`,
        /// `piece-spheres`.
        pub shapes: Vec<String>,
    }

    /// A module that differs.
    pub struct ModuleDifference {
        /// Its name.
        pub name: String,
        /// What became of it.
        pub presence: Presence,
        /// Its version in the first URDD.
        pub version_before: Option<String>,
        /// Its version in the second URDD.
        pub version_after: Option<String>,
        /// Whether its document differs.
        pub document: bool,
        /// Whether its files differ, by the hashes in `urdd.json`.
        pub files: bool,
    }

    /// A finding that is new or gone.
    pub struct FindingDifference {
        /// `added` or `removed`.
        pub presence: Presence,
        /// Code of the rule.
        pub code: String,
        /// Name of the rule.
        pub name: String,
        /// How bad it is.
        pub severity: Severity,
        /// What it is about: links, joints or DOFs by name, else the file and the place in it. The first, where it
        /// is about several.
        pub subject: Option<String>,
        /// What is wrong, and what to do.
        pub message: String,
        /// How many places are new or gone.
        pub count: Count,
    }
}
