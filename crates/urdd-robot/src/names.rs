//! Names of links, joints and DOFs, and their indices.

use super::Robot;
use super::error::RobotError;
use urdd_format::nearest::nearest;

/// Names of links, joints and DOFs, in the order of their indices.
///
/// Each method fails if `chain_module` or `dof_module` is missing or unusable, and one that is given a name with
/// [`RobotError::Unknown`] if there is none such, with the nearest name.
impl Robot {
    /// The name of each link.
    pub fn link_names(&self) -> Result<&[String], RobotError> {
        Ok(&self.motion()?.links)
    }

    /// The index of the root link, whose frame poses are in.
    pub fn root_link(&self) -> Result<usize, RobotError> {
        Ok(self.motion()?.kinematics.root())
    }

    /// The index of a link.
    pub fn link(&self, name: &str) -> Result<usize, RobotError> {
        index("link", self.link_names()?, name)
    }

    /// The name of each joint.
    pub fn joint_names(&self) -> Result<&[String], RobotError> {
        Ok(&self.motion()?.joints)
    }

    /// The index of a joint.
    pub fn joint(&self, name: &str) -> Result<usize, RobotError> {
        index("joint", self.joint_names()?, name)
    }

    /// The name of each DOF: that of its joint, with the coordinate if the joint has several DOFs.
    pub fn dof_names(&self) -> Result<&[String], RobotError> {
        Ok(&self.motion()?.dofs)
    }

    /// The index of a DOF.
    pub fn dof(&self, name: &str) -> Result<usize, RobotError> {
        index("DOF", self.dof_names()?, name)
    }

    /// The unit of each DOF: `rad` or `m`.
    pub fn dof_units(&self) -> Result<&[&'static str], RobotError> {
        Ok(&self.motion()?.units)
    }
}

/// # Errors
/// [`RobotError::OutOfRange`] if there are at most `link` links.
pub(super) fn check_link(link: usize, count: usize) -> Result<(), RobotError> {
    match link < count {
        true => Ok(()),
        false => Err(RobotError::OutOfRange { what: "link", index: link, count }),
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
