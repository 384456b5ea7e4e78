//! What a person can choose of an import.

/// What a person can choose of an import.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ImportOptions {
    /// The body of an MJCF that is the root of the robot. By default it is told by the structure.
    pub body: Option<String>,
    /// The model of an SDF. By default it is the only one.
    pub model: Option<String>,
    /// Whether a ball is written as three revolute joints.
    pub has_revolute_balls: bool,
    /// Whether links between the joints of one body get a tiny mass, which MuJoCo asks of what moves.
    pub has_tiny_masses: bool,
}
