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
        }
    }
}
