//! Names of links, joints and DOFs, and their indices.

use super::Robot;
use super::error::RobotError;
use urdd_format::nearest::nearest;

impl Robot {
    /// The name of each link.
    ///
    /// # Errors
    /// If `chain_module` or `dof_module` is missing or unusable.
    pub fn link_names(&self) -> Result<&[String], RobotError> {
        Ok(&self.motion()?.links)
    }

    /// The index of the root link, whose frame poses are in.
    ///
    /// # Errors
    /// As [`Robot::link_names`].
    pub fn root_link(&self) -> Result<usize, RobotError> {
        Ok(self.motion()?.kinematics.root())
    }

    /// The index of a link.
    ///
    /// # Errors
    /// [`RobotError::Unknown`], with the nearest name; and as [`Robot::link_names`].
    pub fn link(&self, name: &str) -> Result<usize, RobotError> {
        index("link", self.link_names()?, name)
    }

    /// The name of each joint.
    ///
    /// # Errors
    /// As [`Robot::link_names`].
    pub fn joint_names(&self) -> Result<&[String], RobotError> {
        Ok(&self.motion()?.joints)
    }

    /// The index of a joint.
    ///
    /// # Errors
    /// [`RobotError::Unknown`], with the nearest name; and as [`Robot::link_names`].
    pub fn joint(&self, name: &str) -> Result<usize, RobotError> {
        index("joint", self.joint_names()?, name)
    }

    /// The name of each DOF: that of its joint, with the coordinate if the joint has several DOFs.
    ///
    /// # Errors
    /// As [`Robot::link_names`].
    pub fn dof_names(&self) -> Result<&[String], RobotError> {
        Ok(&self.motion()?.dofs)
    }

    /// The index of a DOF.
    ///
    /// # Errors
    /// [`RobotError::Unknown`], with the nearest name; and as [`Robot::link_names`].
    pub fn dof(&self, name: &str) -> Result<usize, RobotError> {
        index("DOF", self.dof_names()?, name)
    }

    /// The unit of each DOF: `rad` or `m`.
    ///
    /// # Errors
    /// As [`Robot::link_names`].
    pub fn dof_units(&self) -> Result<&[&'static str], RobotError> {
        Ok(&self.motion()?.units)
    }
}

pub(super) fn index(
    what: &'static str,
    names: &[impl AsRef<str>],
    name: &str,
) -> Result<usize, RobotError> {
    names.iter().position(|known| known.as_ref() == name).ok_or_else(|| RobotError::Unknown {
        what,
        name: name.to_owned(),
        nearest: nearest(names.iter().map(AsRef::as_ref), name),
    })
}
