//! Which rule compares which values of `urdf_module` with the carried URDF.

/// The parts of a robot; one rule compares each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The set of links and joints, and everything that affects kinematics: URD001.
    Joints,
    /// Materials: URD014.
    Materials,
    /// Everything else: URD013.
    Rest,
}

impl Part {
    /// The part to which the value at a JSON Pointer of `urdf_module` belongs.
    pub fn of(pointer: &str) -> Part {
        let parts: Vec<&str> = pointer.split('/').skip(1).collect();
        match parts.as_slice() {
            // Whether a quaternion counts depends on the version.
            ["links" | "joints" | "version"] | ["links" | "joints", _, "name", ..] => Part::Joints,
            [
                "joints",
                _,
                "joint_type" | "origin" | "parent" | "child" | "axis" | "limit" | "mimic",
                ..,
            ] => Part::Joints,
            ["materials", ..] | ["links", _, "visual", _, "material", ..] => Part::Materials,
            _ => Part::Rest,
        }
    }
}

/// The origin or material of a visual or collision element that contains a JSON Pointer's value. Differences within it
/// are one finding.
pub fn element_part(pointer: &str) -> Option<&str> {
    let mut ends = pointer.match_indices('/').map(|(at, _)| at).skip(1);
    // /links/3/visual/0/origin/xyz/2
    let mut parts = pointer.split('/').skip(1);
    let is_shape = parts.next() == Some("links")
        && matches!(parts.nth(1), Some("visual" | "collision"))
        && matches!(parts.nth(1), Some("origin" | "material"));
    let end = ends.nth(4).unwrap_or(pointer.len());
    is_shape.then(|| &pointer[..end])
}
