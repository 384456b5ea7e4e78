//! What an actuator is told.

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
