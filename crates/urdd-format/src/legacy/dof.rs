//! `dof_module` 0.0.1 and 0.0.2: the degrees of freedom. Both versions have the same structure.

use crate::index::{Count, DofIdx, JointIdx};
use crate::types::module;

module! {
    /// The robot's degrees of freedom (DOFs), in joint order. Revolute, continuous and prismatic
    /// joints have one, planar and spherical ones three, floating ones six. In version 0.0.1 a mimic
    /// joint has DOFs of its own; in 0.0.2 it has none, and its position must be worked out from
    /// `urdf_module`.
    pub struct DofModule {
        /// Number of DOFs: the length of a configuration vector.
        pub num_dofs: Count,
        /// For each DOF, its joint.
        pub dof_idx_to_joint_idx_mapping: Vec<JointIdx>,
        /// For each joint, its DOFs, ascending; empty for a joint without any.
        pub joint_idx_to_dof_idxs_mapping: Vec<Vec<DofIdx>>,
    }
}
