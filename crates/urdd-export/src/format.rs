//! The formats.

use std::str::FromStr;

use urdd_format::word::{UnknownWord, with_word};

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
    /// USD, for Isaac, Newton and Omniverse.
    Usd,
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
        Format::Usd,
    ];

    /// Its word for users, and its name in messages and comments.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Format::Srdf => ("srdf", "SRDF"),
            Format::Urdf => ("urdf", "URDF"),
            Format::Drake => ("drake", "URDF for Drake"),
            Format::Mjcf => ("mjcf", "MJCF"),
            Format::Curobo => ("curobo", "cuRobo's YAML"),
            Format::Foam => ("foam", "Foam's JSON"),
            Format::Spherized => ("spherized", "URDF with spheres"),
            Format::Moveit => ("moveit", "MoveIt's configuration"),
            Format::Sdf => ("sdf", "SDF"),
            Format::Usd => ("usd", "USD"),
        }
    }

    /// Whether its shapes are fitted spheres.
    pub(super) fn has_spheres(self) -> bool {
        matches!(self, Format::Curobo | Format::Foam | Format::Spherized)
    }

    /// Its name in messages and comments.
    pub fn name(self) -> &'static str {
        self.words().1
    }

    /// Its word on the command line and in Python.
    pub fn word(self) -> &'static str {
        self.words().0
    }
}

impl FromStr for Format {
    type Err = UnknownWord;

    fn from_str(word: &str) -> Result<Format, UnknownWord> {
        with_word(word, Format::ALL, Format::word, "is no format")
    }
}
