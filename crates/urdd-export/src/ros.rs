//! Distributions of ROS 2.

/// A distribution of ROS 2, whose MoveIt and ros2_control read a package.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub enum Ros {
    /// Humble: MoveIt 2.5, ros2_control 2.
    Humble,
    /// Jazzy: MoveIt 2.12, ros2_control 4. Kilted reads the same files.
    #[default]
    Jazzy,
}

impl Ros {
    /// All distributions.
    pub const ALL: &[Ros] = &[Ros::Humble, Ros::Jazzy];

    /// Its word for users.
    pub fn word(self) -> &'static str {
        match self {
            Ros::Humble => "humble",
            Ros::Jazzy => "jazzy",
        }
    }

    /// The distribution of a word.
    pub fn named(word: &str) -> Option<Ros> {
        Ros::ALL.iter().copied().find(|ros| ros.word() == word)
    }

    /// What MoveIt does with a joint without a limit of velocity or acceleration.
    pub(super) fn without_limit(self) -> &'static str {
        match self {
            Ros::Humble => "MoveIt of Humble takes 1 (rad or m, per s or s²) for each",
            Ros::Jazzy => "MoveIt of Jazzy then fails every plan that moves them",
        }
    }
}

/// Where a limit that MoveIt needs can be written.
pub(super) fn limit_of(what: &str) -> &'static str {
    match what {
        "velocity" => "`velocity` into the URDF, or limits into config/joint_limits.yaml",
        _ => {
            "`acceleration` into `[limits]` of the file of `urdd export init`, or limits into config/joint_limits.yaml"
        }
    }
}
