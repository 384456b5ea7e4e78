//! The formats that are imported.

use urdd_xml::root_name;

/// A format that is imported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// The XML of MuJoCo.
    Mjcf,
    /// The simulation description format of Gazebo.
    Sdf,
}

impl Format {
    /// All of them, in the order of the table in docs/import.md.
    pub const ALL: [Format; 2] = [Format::Mjcf, Format::Sdf];

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Format::Mjcf => "mjcf",
            Format::Sdf => "sdf",
        }
    }

    /// The format of a text, by its outermost element; none of a URDF, and of anything else.
    pub fn of(text: &str) -> Option<Self> {
        match root_name(text)? {
            "mujoco" => Some(Format::Mjcf),
            "sdf" | "gazebo" => Some(Format::Sdf),
            _ => None,
        }
    }
}
