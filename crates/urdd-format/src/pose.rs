//! Rigid transforms.

use super::types::types;

types! {
    /// A rigid transform: where a frame lies, and how it is turned, seen from another frame.
    /// It takes coordinates of the inner frame to the outer one: `p_outer = R * p_inner + position`.
    pub struct Pose {
        /// Origin of the inner frame in the outer frame, metres: x, y, z.
        pub position: [f64; 3] where { unit: "m" },
        /// Rotation from the inner to the outer frame as a unit quaternion: w, x, y, z, with `w >= 0`.
        pub quaternion_wxyz: [f64; 4] where { unit: "1" },
    }
}
