//! The formats.

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

    /// Whether its shapes are fitted spheres.
    pub(super) fn has_spheres(self) -> bool {
        matches!(self, Format::Curobo | Format::Foam | Format::Spherized)
    }
}
