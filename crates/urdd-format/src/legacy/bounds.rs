//! `bounds_module` 0.0.1: lower and upper bound of each DOF.

use crate::types::module;

module! {
    /// Bounds of the configuration space, per DOF: rad or m. Taken from the joint's limit; where its
    /// two ends are equal the upper one is written 1e-7 higher, so that a continuous joint without
    /// limits has [0, 1e-7]. Every DOF of a floating joint repeats the joint's one limit.
    pub struct BoundsModule {
        /// Lower and upper bound of each DOF.
        pub bounds: Vec<[f64; 2]>,
        /// Lower bound of each DOF: the first elements of `bounds`.
        pub dof_lower_bounds: Vec<f64>,
        /// Upper bound of each DOF: the second elements of `bounds`.
        pub dof_upper_bounds: Vec<f64>,
    }
}
