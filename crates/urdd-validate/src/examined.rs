//! What examining one URDD, or a URDF by itself, gives.

use super::engine::{Check, Outcome};
use urdd_format::registry::Profile;

/// A module of an examined URDD.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExaminedModule {
    /// Its name.
    pub name: String,
    /// Its folder, relative to the URDD's root.
    pub path: String,
    /// Its version; `None` where it has none.
    pub version: Option<String>,
    /// The family of formats it is of; `None` for extensions and unknown modules.
    pub profile: Option<Profile>,
}

/// A URDD, or a URDF by itself, that was examined.
pub struct Examined {
    /// How it is called: its path from the folder that was searched.
    pub name: String,
    /// How the program crashed outside of any rule, where it did.
    pub crashed: Option<String>,
    /// The robot's name, where a module says it.
    pub robot_name: Option<String>,
    /// Number of links, joints and DOFs, where modules say them.
    pub size: RobotSize,
    /// Its modules.
    pub modules: Vec<ExaminedModule>,
    /// Every rule and what became of it, in order of code; settings applied.
    pub checks: Vec<Check>,
}

/// How large a robot is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RobotSize {
    /// Number of links.
    pub links: Option<usize>,
    /// Number of joints.
    pub joints: Option<usize>,
    /// Number of degrees of freedom.
    pub dofs: Option<usize>,
}

impl Examined {
    /// Whether the program crashed, so that the URDD was not fully examined.
    pub fn incomplete(&self) -> bool {
        let mut checks = self.checks.iter();
        self.crashed.is_some() || checks.any(|check| matches!(check.outcome, Outcome::Crashed(_)))
    }
}
