//! The formats, and the distributions of ROS 2 that MoveIt's is for.

urdd_format::words! {
    /// An export format.
    pub enum Format "is no format" {
        /// Pairs of links that need no check, for MoveIt.
        Srdf "srdf",
        /// URDF of the robot, with the URDD's shapes as collision geometry.
        Urdf "urdf",
        /// The same for Drake, with collision filter groups.
        Drake "drake",
        /// For MuJoCo: bodies, joints, shapes, excluded pairs.
        Mjcf "mjcf",
        /// Spheres and ignored pairs per link, for cuRobo.
        Curobo "curobo",
        /// Spheres per link, in Foam's format.
        Foam "foam",
        /// URDF of the robot, with these spheres as collision geometry.
        Spherized "spherized",
        /// A configuration package for MoveIt 2: a folder.
        Moveit "moveit",
        /// For Gazebo and Drake: links, joints, shapes.
        Sdf "sdf",
        /// For Isaac, Newton and Omniverse: a `.usda` of rigid bodies, joints, shapes, filtered pairs.
        Usd "usd",
        /// URDF of the robot with what closes its loops, as URDF+ has it.
        UrdfPlus "urdf-plus",
        /// URDF of the robot, and a YAML beside it with what closes its loops, as Extended URDF has it.
        ExtendedUrdf "extended-urdf",
    }
}

impl Format {
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
            Format::Usd => "USD",
            Format::UrdfPlus => "URDF+",
            Format::ExtendedUrdf => "Extended URDF",
        }
    }

    /// Whether it is a URDF of links and joints, without pairs and settings of a program.
    pub(super) fn is_plain_urdf(self) -> bool {
        matches!(self, Format::Urdf | Format::UrdfPlus | Format::ExtendedUrdf)
    }

    pub(super) fn has_spheres(self) -> bool {
        matches!(self, Format::Curobo | Format::Foam | Format::Spherized)
    }
}

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

/// A limit that MoveIt needs of each joint that it moves, in the order of a joint's limits.
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
}
