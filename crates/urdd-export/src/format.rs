//! The formats.

/// An export format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// MoveIt's Semantic Robot Description Format.
    Srdf,
    /// URDF with the URDD's shapes as collision geometry.
    Urdf,
    /// URDF for Drake.
    Drake,
    /// MuJoCo's XML.
    Mjcf,
    /// cuRobo's spheres, YAML.
    Curobo,
    /// Foam's spheres, JSON.
    Foam,
    /// URDF with spheres as collision geometry, as Foam writes them.
    Spherized,
    /// A configuration package of MoveIt 2.
    Moveit,
    /// SDF, for Gazebo and Drake.
    Sdf,
}

impl Format {
    /// All formats.
    pub const ALL: &[Format] = &[
        Format::Srdf,
        Format::Urdf,
        Format::Drake,
        Format::Mjcf,
        Format::Curobo,
        Format::Foam,
        Format::Spherized,
        Format::Moveit,
        Format::Sdf,
    ];

    /// Its name in messages and comments.
    pub fn name(self) -> &'static str {
        match self {
            Format::Srdf => "SRDF",
            Format::Urdf => "URDF",
            Format::Drake => "URDF for Drake",
            Format::Mjcf => "MJCF",
            Format::Curobo => "cuRobo's YAML",
            Format::Foam => "Foam's JSON",
            Format::Spherized => "URDF with spheres",
            Format::Moveit => "MoveIt's configuration",
            Format::Sdf => "SDF",
        }
    }
}
