//! Module versions published before the specification, as their converter wrote them. They are
//! frozen: faults are documented, not corrected.
//!
//! Common to all: lengths in metres, angles in radians; rotations as fixed-axis roll, pitch, yaw. A
//! *shape index* counts the links that have a mesh, in link order, or their convex pieces, in link
//! order then piece order. Mesh paths start with a robot's folder name and are relative to the
//! folder above the URDD, which also contains the parts of a composed robot.
//!
//! `link_shapes_max_distance_from_origin_module` 0.0.3 has the structure of version 1.0.0.

pub mod composition;
pub mod kinematics;
pub mod meshes;
pub mod shapes;
pub mod urdf;

use crate::types::module;

module! {
    /// Says that a person has looked at the robot in the converter's viewer. No robot data.
    pub struct FirstLookVisModule {
        /// Always null.
        pub done: (),
    }
}
