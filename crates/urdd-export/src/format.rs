//! The formats, and kinds of actuators in them.

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

    /// The format of a word.
    pub fn named(word: &str) -> Option<Format> {
        Format::ALL.iter().copied().find(|format| format.word() == word)
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

    /// The kind of a word.
    pub fn named(word: &str) -> Option<ActuatorKind> {
        ActuatorKind::ALL.iter().copied().find(|kind| kind.word() == word)
    }
}
