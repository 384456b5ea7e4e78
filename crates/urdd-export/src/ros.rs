//! Distributions of ROS 2.

urdd_format::words! {
    /// A distribution of ROS 2, whose MoveIt and ros2_control read a package.
    #[derive(Default)]
    pub enum Ros "is no distribution" {
        /// MoveIt 2.5, ros2_control 2.
        Humble "humble",
        /// MoveIt 2.12, ros2_control 4; Kilted reads the same files.
        #[default]
        Jazzy "jazzy",
    }
}

impl Ros {
    /// What MoveIt does with a joint without a limit of velocity or acceleration.
    pub(super) fn without_limit(self) -> &'static str {
        match self {
            Ros::Humble => "MoveIt of Humble takes 1 (rad or m, per s or s²) for each",
            Ros::Jazzy => "MoveIt of Jazzy then fails every plan that moves them",
        }
    }
}

/// A limit that MoveIt needs of each joint that it moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Limited {
    /// Of velocity.
    Velocity,
    /// Of acceleration.
    Acceleration,
}

impl Limited {
    /// All of them, in the order of their notes.
    pub(super) const ALL: [Limited; 2] = [Limited::Velocity, Limited::Acceleration];

    /// Its word for users.
    pub fn word(self) -> &'static str {
        match self {
            Limited::Velocity => "velocity",
            Limited::Acceleration => "acceleration",
        }
    }

    /// Where it can be written.
    pub(super) fn place(self) -> &'static str {
        match self {
            Limited::Velocity => {
                "`velocity` into the URDF, or limits into config/joint_limits.yaml"
            }
            Limited::Acceleration => {
                "`acceleration` into `[limits]` of the file of `urdd export init`, or limits into config/joint_limits.yaml"
            }
        }
    }

    /// Its index among the limits of a joint: velocity, acceleration and jerk.
    pub(super) fn index(self) -> usize {
        match self {
            Limited::Velocity => 0,
            Limited::Acceleration => 1,
        }
    }
}
