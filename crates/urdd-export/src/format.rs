//! The formats, and kinds of actuators in them.

use std::str::FromStr;

use thiserror::Error;

/// A word that is none of a list.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there {what} `{}`; there are: {}", .word.escape_debug(), .known.join(", "))]
pub struct UnknownWord {
    /// What there is none of, with its verb.
    what: &'static str,
    word: String,
    known: Vec<&'static str>,
}

/// The one of these with a word.
pub(super) fn with_word<T: Copy>(
    word: &str,
    all: &[T],
    word_of: fn(T) -> &'static str,
    what: &'static str,
) -> Result<T, UnknownWord> {
    let found = all.iter().copied().find(|one| word_of(*one) == word);
    found.ok_or_else(|| {
        let known = all.iter().map(|one| word_of(*one)).collect();
        UnknownWord { what, word: word.to_owned(), known }
    })
}

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

/// What an actuator is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ActuatorKind {
    /// A position, rad or m.
    Position,
    /// A velocity, rad/s or m/s.
    Velocity,
    /// A torque or a force, N m or N.
    Motor,
}

impl ActuatorKind {
    /// All kinds.
    pub const ALL: &[ActuatorKind] =
        &[ActuatorKind::Position, ActuatorKind::Velocity, ActuatorKind::Motor];

    /// Its word for users, which is MuJoCo's too.
    pub fn word(self) -> &'static str {
        match self {
            ActuatorKind::Position => "position",
            ActuatorKind::Velocity => "velocity",
            ActuatorKind::Motor => "motor",
        }
    }
}

impl FromStr for ActuatorKind {
    type Err = UnknownWord;

    fn from_str(word: &str) -> Result<ActuatorKind, UnknownWord> {
        with_word(word, ActuatorKind::ALL, ActuatorKind::word, "are no actuators")
    }
}
