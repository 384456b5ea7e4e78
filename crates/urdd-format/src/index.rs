//! Index spaces and counts. Each has its own Rust type, so that a link index cannot be used as a
//! joint index.

use super::object::integer;

integer! {
    /// Index of a link: its place in `links` of `urdf_module`, from 0.
    pub struct LinkIdx says "x-index" = "link";

    /// Index of a joint: its place in `joints` of `urdf_module`, from 0.
    pub struct JointIdx says "x-index" = "joint";

    /// Index of a degree of freedom (DOF): its place in a configuration vector, from 0.
    pub struct DofIdx says "x-index" = "dof";

    /// Index of a convex piece among the pieces of one link, from 0.
    pub struct PieceIdx says "x-index" = "piece";

    /// Index of a `visual` or `collision` element within its link, from 0.
    pub struct ElementIdx says "x-index" = "visual or collision";

    /// A number of things.
    pub struct Count says "x-unit" = "1";

    /// Number of a sampled configuration: `k` of SPEC's sequence, from 0.
    pub struct SampleIdx says "x-index" = "sample";

    /// Index of a level of spheres, from 0.
    pub struct LevelIdx says "x-index" = "other";

    /// Index of a sphere among those of one link in one level, from 0.
    pub struct SphereIdx says "x-index" = "other";

    /// Index of a robot among those that a robot was combined from, from 0.
    pub struct RobotIdx says "x-index" = "part";
}

impl Count {
    /// The count, or the largest one that a document can hold.
    pub fn saturating(count: usize) -> Self {
        Count(u32::try_from(count).unwrap_or(u32::MAX))
    }
}
