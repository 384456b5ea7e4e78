//! The programs.

use crate::effect::{Effects, Reading};
use crate::file::File;
use crate::unknown::{self, Names, Reads};
use crate::{drake, mujoco, pinocchio, pybullet, three, urdfdom, usd, yourdfpy};

/// A program that reads URDFs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Program {
    /// ROS lyrical and rolling.
    Urdfdom6,
    /// ROS jazzy and kilted.
    Urdfdom4,
    /// ROS noetic, humble and iron.
    Urdfdom3,
    /// Pinocchio.
    Pinocchio,
    /// Drake.
    Drake,
    /// `PyBullet`.
    PyBullet,
    /// urdf-usd-converter.
    Usd,
    /// urdf-loader of three.js.
    UrdfLoader,
    /// yourdfpy.
    Yourdfpy,
    /// MuJoCo 4.
    MuJoCo,
    /// MuJoCo 3.3.
    MuJoCo33,
}

/// Names in settings, and the programs' own.
const NAMES: [(&str, &str); 13] = [
    ("ros", "urdfdom6"),
    ("lyrical", "urdfdom6"),
    ("rolling", "urdfdom6"),
    ("jazzy", "urdfdom4"),
    ("kilted", "urdfdom4"),
    ("noetic", "urdfdom3"),
    ("humble", "urdfdom3"),
    ("iron", "urdfdom3"),
    ("mujoco3.3", "mujoco33"),
    ("gazebo", "sdformat"),
    ("isaac", "usd"),
    ("newton", "usd"),
    ("three", "urdf_loader"),
];

/// Those that are asked only by name, as newer ones are there.
const OLD: [&str; 3] = ["urdfdom4", "urdfdom3", "mujoco33"];

/// What MuJoCo 3.3 never reads, and 4 but for the first: only visuals can lose a shape, as a collision without one is
/// refused.
const MUJOCO_33: &[&str] = &[
    "mimic",
    "safety_controller",
    "calibration",
    "velocity",
    "acceleration",
    "deceleration",
    "jerk",
    "version",
    "quat_xyzw",
    "texture",
    "visual",
    "material",
    "color",
    "geometry",
    "box",
    "cylinder",
    "sphere",
    "capsule",
    "mesh",
];
const MUJOCO: &[&str] = MUJOCO_33.split_at(1).1;

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
    pub const ALL: [Program; 11] = [
        Program::Urdfdom6,
        Program::Urdfdom4,
        Program::Urdfdom3,
        Program::Pinocchio,
        Program::Drake,
        Program::MuJoCo,
        Program::MuJoCo33,
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
                name: "ROS jazzy and kilted (urdfdom 4)",
                version: "4.0.1",
                read: urdfdom::read_four,
            },
            Program::Urdfdom3 => Facts {
                id: "urdfdom3",
                name: "ROS noetic, humble and iron (urdfdom 3)",
                version: "3.0.1",
                read: urdfdom::read_three,
            },
            Program::Pinocchio => Facts {
                id: "pinocchio",
                name: "Pinocchio",
                version: "4.1.0",
                read: pinocchio::read,
            },
            Program::Drake => {
                Facts { id: "drake", name: "Drake", version: "1.51.1", read: drake::read }
            }
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
            Program::MuJoCo => {
                Facts { id: "mujoco", name: "MuJoCo 4", version: "4.0.0", read: mujoco::read_four }
            }
            Program::MuJoCo33 => Facts {
                id: "mujoco33",
                name: "MuJoCo 3.3",
                version: "3.3.7",
                read: mujoco::read_three,
            },
        }
    }

    /// The program that settings name: `ros`, `humble`, `urdf-rs`, or by its `id`.
    pub fn of_name(name: &str) -> Option<Program> {
        let named = NAMES.iter().find(|(one, _)| *one == name).map(|(_, id)| *id);
        let id = named.map_or_else(|| name.replace('-', "_"), str::to_owned);
        Program::ALL.into_iter().find(|program| program.id() == id)
    }

    /// The name of settings for it.
    pub fn setting(self) -> String {
        let named = NAMES.iter().find(|(_, id)| *id == self.id()).map(|(name, _)| *name);
        named.map_or_else(|| self.id().replace('_', "-"), str::to_owned)
    }

    /// Whether it is asked if nobody says which programs matter.
    pub fn is_asked(self) -> bool {
        !OLD.contains(&self.id())
    }

    /// As reports and the table name it.
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
        if effects.loads() {
            unknown::find(file.bytes, self.reads(), &mut effects);
        }
        effects
    }

    /// What of URDF it reads at all.
    fn reads(self) -> Reads {
        let names = match self.id() {
            "urdf_loader" => Names::AnyCase,
            "urdf_rs" => Names::AnyPrefix,
            _ => Names::Exact,
        };
        let never: &[&str] = match self.id() {
            "drake" => &[
                "safety_controller",
                "calibration",
                "acceleration",
                "deceleration",
                "jerk",
                "version",
                "quat_xyzw",
            ],
            "pinocchio" => &[
                "mimic",
                "safety_controller",
                "calibration",
                "acceleration",
                "deceleration",
                "jerk",
            ],
            "mujoco" => MUJOCO,
            "mujoco33" => MUJOCO_33,
            "pybullet" => &[
                "mimic",
                "safety_controller",
                "calibration",
                "acceleration",
                "deceleration",
                "jerk",
                "version",
                "quat_xyzw",
                "texture",
                "inertia",
                "ixx",
                "ixy",
                "ixz",
                "iyy",
                "iyz",
                "izz",
            ],
            "usd" => &["acceleration", "deceleration", "jerk", "version", "quat_xyzw"],
            "yourdfpy" => &[
                "texture",
                "reference_position",
                "acceleration",
                "deceleration",
                "jerk",
                "version",
                "quat_xyzw",
            ],
            "urdf_loader" => &[
                "collision",
                "dynamics",
                "damping",
                "friction",
                "safety_controller",
                "calibration",
                "acceleration",
                "deceleration",
                "jerk",
                "version",
                "quat_xyzw",
            ],
            _ => &[],
        };
        Reads { names, never }
    }
}
