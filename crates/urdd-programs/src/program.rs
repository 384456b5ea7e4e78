//! The programs.

use crate::effect::{Effects, Reading};
use crate::file::File;
use crate::{pybullet, three, urdfdom, usd, yourdfpy};

/// A program that reads URDFs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Program {
    Urdfdom6,
    Urdfdom4,
    PyBullet,
    Usd,
    UrdfLoader,
    Yourdfpy,
}

/// What is known of a program.
struct Facts {
    /// As reports and settings name it.
    id: &'static str,
    /// As people know it.
    name: &'static str,
    /// The version that its reader is held to.
    version: &'static str,
    read: fn(&File, &mut Effects) -> Reading<()>,
}

impl Program {
    /// All, in the order in which they are reported.
    pub const ALL: [Program; 6] = [
        Program::Urdfdom6,
        Program::Urdfdom4,
        Program::PyBullet,
        Program::Usd,
        Program::UrdfLoader,
        Program::Yourdfpy,
    ];

    const fn facts(self) -> Facts {
        match self {
            Program::Urdfdom6 => Facts {
                id: "urdfdom6",
                name: "ROS (urdfdom 6)",
                version: "6.0.0",
                read: urdfdom::read_six,
            },
            Program::Urdfdom4 => Facts {
                id: "urdfdom4",
                name: "ROS (urdfdom 4)",
                version: "4.0.1",
                read: urdfdom::read_four,
            },
            Program::PyBullet => {
                Facts { id: "pybullet", name: "PyBullet", version: "3.2.7", read: pybullet::read }
            }
            Program::Usd => Facts {
                id: "usd",
                name: "Isaac and Newton (urdf-usd-converter)",
                version: "0.3.4",
                read: usd::read,
            },
            Program::UrdfLoader => Facts {
                id: "urdf_loader",
                name: "three.js (urdf-loader)",
                version: "0.13.1",
                read: three::read,
            },
            Program::Yourdfpy => {
                Facts { id: "yourdfpy", name: "yourdfpy", version: "0.0.60", read: yourdfpy::read }
            }
        }
    }

    /// As reports and settings name it.
    pub fn id(self) -> &'static str {
        self.facts().id
    }

    /// As people know it.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// The version that its reader is held to.
    pub fn version(self) -> &'static str {
        self.facts().version
    }

    /// What it does with a file.
    pub fn read(self, file: &File) -> Effects {
        let mut effects = Effects::default();
        // What a reader refuses is among the effects.
        let _ = (self.facts().read)(file, &mut effects);
        effects
    }
}
