//! `dof_module`: the degrees of freedom, and how they determine the joint values.

use super::index::{Count, DofIdx, JointIdx};
use super::types::module;

module! {
    /// The robot's degrees of freedom (DOFs), in joint order, and the position of every joint as a
    /// function of them.
    pub struct DofModule {
        /// Number of DOFs: the length of a configuration vector.
        pub num_dofs: Count,
        /// For each DOF, its joint.
        pub dof_idx_to_joint_idx_mapping: Vec<JointIdx> where { length: "dofs" },
        /// For each joint, its DOFs, ascending; empty for fixed and for mimic joints.
        pub joint_idx_to_dof_idxs_mapping: Vec<Vec<DofIdx>> where { length: "joints" },
        /// For each joint, how it follows a DOF if it is a mimic joint, else null. Chains of mimics
        /// are resolved.
        pub joint_idx_to_mimic_mapping: Vec<Option<ResolvedMimic>> where { length: "joints" },
        /// What each DOF is.
        pub dofs: Vec<Dof> where { length: "dofs" },
    }

    /// What a mimic joint's position is: `multiplier * q[dof_idx] + offset`.
    pub struct ResolvedMimic {
        /// The DOF that drives the joint; null where the chain of mimics ends in a fixed joint,
        /// and the position is `offset` at all times.
        pub dof_idx: Option<DofIdx>,
        /// Factor: the product of the factors along the chain of mimics.
        pub multiplier: f64 where { unit: "1 or rad/m or m/rad" },
        /// Offset, rad or m, accumulated along the chain of mimics.
        pub offset: f64 where { unit: "rad or m" },
    }

    /// A degree of freedom.
    pub struct Dof {
        /// Name: the joint's name where the joint has one DOF; else that name, a slash, and
        /// `trans_x`, `trans_y`, `trans_z`, `rot_x`, `rot_y`, `rot_z` or (planar) `rot`.
        pub name: String,
        /// The joint that it moves.
        pub joint_idx: JointIdx,
        /// Name of that joint.
        pub joint_name: String,
        /// What it measures.
        pub quantity: Quantity,
    }

    /// What a DOF measures.
    pub enum Quantity {
        /// An angle, or a component of a rotation vector: radians.
        Angle,
        /// A length: metres.
        Length,
    }
}
