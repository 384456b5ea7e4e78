//! The programs.

use crate::effect::{Deed, Effects};
use crate::file::{About, File};
use crate::{control, drake, mujoco, pinocchio, pybullet, sdformat, three, urdfdom, usd};

/// Lists the programs in the order in which they are reported, each with what its reader says of it.
macro_rules! programs {
    ($($(#[$doc:meta])+ $name:ident: $about:path,)+) => {
        /// A program that reads URDFs.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Program {
            $($(#[$doc])+ $name,)+
        }

        impl Program {
            /// All, in the order in which they are reported.
            pub const ALL: [Program; 16] = [$(Program::$name),+];

            const fn about(self) -> &'static About {
                match self {
                    $(Program::$name => &$about,)+
                }
            }
        }
    };
}

programs! {
    /// ROS lyrical and rolling.
    Urdfdom6: urdfdom::SIX,
    /// ROS jazzy and kilted.
    Urdfdom4: urdfdom::FOUR,
    /// ROS noetic, humble and iron.
    Urdfdom3: urdfdom::THREE,
    /// Gazebo Fortress, by libsdformat 12.
    Fortress: sdformat::FORTRESS,
    /// Gazebo Harmonic, by libsdformat 14.
    Harmonic: sdformat::HARMONIC,
    /// Gazebo Jetty, by libsdformat 16.
    Jetty: sdformat::JETTY,
    /// MuJoCo 4.
    MuJoCo: mujoco::FOUR,
    /// MuJoCo 3.3.
    MuJoCo33: mujoco::THREE,
    /// Pinocchio.
    Pinocchio: pinocchio::ABOUT,
    /// Drake.
    Drake: drake::ABOUT,
    /// `PyBullet`.
    PyBullet: pybullet::ABOUT,
    /// urdf-usd-converter.
    Isaac: usd::ABOUT,
    /// urdf-loader of three.js.
    Three: three::ABOUT,
    /// ros2_control of ROS jazzy and later.
    Control4: control::FOUR,
    /// ros2_control of ROS humble.
    Control2: control::TWO,
    /// gz_ros2_control.
    GazeboControl: control::GAZEBO,
}

impl Program {
    /// The programs that a name in settings stands for: `ros`, `humble`, `isaac`; of `gazebo`, each version.
    pub fn of_name(name: &str) -> impl Iterator<Item = Program> {
        Program::ALL
            .into_iter()
            .filter(move |program| program.id() == name || program.about().settings.contains(&name))
    }

    /// The names of settings for it, the best first.
    pub fn settings(self) -> impl Iterator<Item = &'static str> {
        let about = self.about();
        let own = Some(about.id).filter(|_| about.settings.is_empty());
        about.settings.iter().copied().chain(own)
    }

    /// Whether it is asked if nobody says which programs matter.
    pub fn is_asked(self) -> bool {
        self.about().is_asked
    }

    /// Whether it has anything to do with a file: ros2_control with a `<ros2_control>`.
    pub fn is_for(self, file: &File) -> bool {
        self.about().is_for.is_none_or(|is_for| is_for(file))
    }

    /// As reports and the table name it.
    pub fn id(self) -> &'static str {
        self.about().id
    }

    /// As people know it.
    pub fn name(self) -> &'static str {
        self.about().name
    }

    /// Its name whatever its version: `ROS`.
    pub fn family(self) -> &'static str {
        self.about().family
    }

    /// The version that its reader is held to.
    pub fn version(self) -> &'static str {
        self.about().version
    }

    /// What it does with a file.
    pub fn read(self, file: &File) -> Effects {
        let mut effects = Effects::default();
        // What a reader refuses is among the effects.
        let is_read = (self.about().read)(file, &mut effects).is_ok();
        // An element of another name may be the one that is missing.
        if is_read && effects.lacks_files_alone() && self.about().is_for.is_none() {
            let (ignored, cut) = file.unknown(self.about().names);
            ignored.iter().for_each(|found| found.add(self.about().never, &mut effects));
            effects.count(*cut, Deed::Drops);
        }
        effects
    }
}
