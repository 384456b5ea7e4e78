//! A robot by one of its descriptions, as rules about the robot itself see it: that of a URDD, or of a URDF alone.

use std::sync::OnceLock;

use super::reference::urdf_text;
use urdd_document::carried_urdf::{CarriedUrdf, NoUrdf};
use urdd_document::mechanism::Mechanism;
use urdd_document::module::Module;
use urdd_document::robot::{self, Robot};
use urdd_document::tree::{Mimics, RigidGroups};

/// What a URDF says, parsed on first use; `None` if there is no URDF.
#[derive(Default)]
pub struct UrdfText(OnceLock<Option<urdf_text::Reading>>);

impl UrdfText {
    /// What somebody has parsed, if anybody has.
    pub(super) fn known(reading: Option<urdf_text::Reading>) -> Self {
        UrdfText(reading.map_or_else(OnceLock::new, |reading| Some(reading).into()))
    }

    /// What the URDF says, if there is one.
    pub(super) fn of(&self, urdf: Result<&CarriedUrdf, &NoUrdf>) -> Option<&urdf_text::Reading> {
        self.0.get_or_init(|| Some(urdf_text::read(&urdf.ok()?.text))).as_ref()
    }

    /// The robot of the URDF; `None` if it cannot be read (URD011).
    pub(super) fn robot(&self, urdf: Result<&CarriedUrdf, &NoUrdf>) -> Option<Robot> {
        let is_utf8 = urdf.is_ok_and(|urdf| urdf.not_utf8_at.is_none());
        let reading = self.of(urdf).filter(|reading| is_utf8 && reading.problems.is_empty())?;
        reading.robot.as_ref().map(robot::of_urdf)
    }
}

/// A robot by one of its descriptions, with the URDF.
#[derive(Clone, Copy)]
pub struct Described<'a> {
    pub(super) mechanism: Option<&'a Mechanism>,
    /// The module that describes it, unless the URDF does.
    pub(super) module: Option<&'a Module>,
    /// The source URDF, or why it is not available.
    pub urdf: Result<&'a CarriedUrdf, &'a NoUrdf>,
    pub(super) text: &'a UrdfText,
}

impl<'a> Described<'a> {
    /// The robot.
    pub fn robot(&self) -> Option<&'a Robot> {
        self.mechanism.map(Mechanism::robot)
    }

    /// Its rigid groups; `None` if its joints do not form a tree.
    pub fn rigid_groups(&self) -> Option<&'a RigidGroups> {
        self.mechanism?.rigid_groups()
    }

    /// Its resolved mimic joints; `None` if they cannot be resolved.
    pub fn mimics(&self) -> Option<&'a Mimics> {
        self.mechanism?.mimics()
    }

    /// The file that the robot was read from.
    pub fn robot_file(&self) -> String {
        match self.module {
            Some(module) => module.file("module.json"),
            None => self.urdf.map_or_else(|_| String::new(), |urdf| urdf.path.clone()),
        }
    }

    /// The parsed source URDF; `None` if none is carried. Only meaningful if URD011 passed.
    pub fn urdf_text(&self) -> Option<&'a urdf_text::Reading> {
        self.text.of(self.urdf)
    }
}
