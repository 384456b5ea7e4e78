//! `bounds_module`: lower and upper bound of each DOF.

use super::annotations::lengths;
use super::object::module;

module! {
    /// Bounds of the configuration space, per DOF: rad or m as `dofs` of `dof_module` says.
    /// Every bound is finite.
    pub struct BoundsModule {
        /// Lower and upper bound of each DOF.
        #[schemars(transform = lengths("dofs"), extend("x-unit" = "rad or m"))]
        pub bounds: Vec<[f64; 2]>,
        /// Lower bound of each DOF: the first elements of `bounds`.
        #[schemars(transform = lengths("dofs"), extend("x-unit" = "rad or m"))]
        pub dof_lower_bounds: Vec<f64>,
        /// Upper bound of each DOF: the second elements of `bounds`.
        #[schemars(transform = lengths("dofs"), extend("x-unit" = "rad or m"))]
        pub dof_upper_bounds: Vec<f64>,
        /// For each DOF, whether the source limits it. A DOF without limits has the bounds
        /// [-pi, pi] if it is an angle and [-1, 1] if it is a length; a rotation vector's norm is
        /// at most pi.
        #[schemars(transform = lengths("dofs"))]
        pub dof_limited: Vec<bool>,
        /// For each DOF, the largest speed (rad/s or m/s); null where the source has none.
        #[schemars(transform = lengths("dofs"), extend("x-unit" = "rad/s or m/s"))]
        pub dof_velocity_limits: Vec<Option<f64>>,
        /// For each DOF, the largest effort (N m or N); null where the source has none.
        #[schemars(transform = lengths("dofs"), extend("x-unit" = "N*m or N"))]
        pub dof_effort_limits: Vec<Option<f64>>,
    }
}
