//! The programs.

use crate::effect::Effects;
use crate::file::{About, File};
use crate::{drake, mujoco, pinocchio, pybullet, sdformat, three, urdfdom, usd};

/// A program that reads URDFs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Program {
    /// ROS lyrical and rolling.
    Urdfdom6,
    /// ROS jazzy and kilted.
    Urdfdom4,
    /// ROS noetic, humble and iron.
    Urdfdom3,
    /// Gazebo Fortress, by libsdformat 12.
    Fortress,
    /// Gazebo Harmonic, by libsdformat 14.
    Harmonic,
    /// Gazebo Jetty, by libsdformat 16.
    Jetty,
    /// MuJoCo 4.
    MuJoCo,
    /// MuJoCo 3.3.
    MuJoCo33,
    /// Pinocchio.
    Pinocchio,
    /// Drake.
    Drake,
    /// `PyBullet`.
    PyBullet,
    /// urdf-usd-converter.
    Isaac,
    /// urdf-loader of three.js.
    Three,
}

impl Program {
    /// All, in the order in which they are reported.
    pub const ALL: [Program; 13] = [
        Program::Urdfdom6,
        Program::Urdfdom4,
        Program::Urdfdom3,
        Program::Fortress,
        Program::Harmonic,
        Program::Jetty,
        Program::MuJoCo,
        Program::MuJoCo33,
        Program::Pinocchio,
        Program::Drake,
        Program::PyBullet,
        Program::Isaac,
        Program::Three,
    ];

    const fn about(self) -> &'static About {
        match self {
            Program::Urdfdom6 => &urdfdom::SIX,
            Program::Urdfdom4 => &urdfdom::FOUR,
            Program::Urdfdom3 => &urdfdom::THREE,
            Program::Fortress => &sdformat::FORTRESS,
            Program::Harmonic => &sdformat::HARMONIC,
            Program::Jetty => &sdformat::JETTY,
            Program::MuJoCo => &mujoco::FOUR,
            Program::MuJoCo33 => &mujoco::THREE,
            Program::Pinocchio => &pinocchio::ABOUT,
            Program::Drake => &drake::ABOUT,
            Program::PyBullet => &pybullet::ABOUT,
            Program::Isaac => &usd::ABOUT,
            Program::Three => &three::ABOUT,
        }
    }

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
        let _ = (self.about().read)(file, &mut effects);
        if effects.loads() {
            let ignored = file.unknown(self.about().names);
            ignored.iter().for_each(|found| found.add(self.about().never, &mut effects));
        }
        effects
    }
}
