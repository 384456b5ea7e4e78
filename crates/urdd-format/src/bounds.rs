//! `bounds_module`: lower and upper bound of each DOF.

use super::types::module;

module! {
    /// Bounds of the configuration space, per DOF: rad or m as `dofs` of `dof_module` says.
    /// Every bound is finite.
    pub struct BoundsModule {
        /// Lower and upper bound of each DOF.
        pub bounds: Vec<[f64; 2]> where { unit: "rad or m", length: "dofs" },
        /// Lower bound of each DOF: the first elements of `bounds`.
        pub dof_lower_bounds: Vec<f64> where { unit: "rad or m", length: "dofs" },
        /// Upper bound of each DOF: the second elements of `bounds`.
        pub dof_upper_bounds: Vec<f64> where { unit: "rad or m", length: "dofs" },
        /// For each DOF, whether the source limits it. A DOF without limits has the bounds
        /// [-pi, pi] if it is an angle and [-1, 1] if it is a length; a rotation vector's norm is
        /// at most pi.
        pub dof_limited: Vec<bool> where { length: "dofs" },
        /// For each DOF, the largest speed (rad/s or m/s); null where the source has none.
        pub dof_velocity_limits: Vec<Option<f64>> where { unit: "rad/s or m/s", length: "dofs" },
        /// For each DOF, the largest effort (N m or N); null where the source has none.
        pub dof_effort_limits: Vec<Option<f64>> where { unit: "N*m or N", length: "dofs" },
    }
}
