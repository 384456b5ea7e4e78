//! The joints that move one link: what its pose and its Jacobian need, and nothing of the rest of the robot.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use super::error::ConfigurationError;
use super::forward::{ForwardKinematics, Step, is_finite};
use super::jacobian::{add_to, columns};
use super::joint::Motion;

/// The joints between the root and one link.
#[derive(Debug, Clone)]
pub struct Branch<'a> {
    kinematics: &'a ForwardKinematics,
    link: usize,
    /// From the root on.
    pub(super) steps: Vec<&'a Step>,
}

/// Where the link of a branch is. It is used again for the next configuration.
#[derive(Debug, Clone)]
pub struct Place {
    /// The pose of the link in the root link's frame.
    pub pose: Isometry3<f64>,
    /// Of each joint the rotation of its frame, and the place of its child.
    pub(super) joints: Vec<(UnitQuaternion<f64>, Vector3<f64>)>,
}

impl Default for Place {
    /// The identity, of no joint.
    fn default() -> Self {
        Self {
            pose: Isometry3::identity(),
            joints: Vec::new(),
        }
    }
}

impl ForwardKinematics {
    /// The joints that move a link; none for the root, and for a link that is not there.
    pub fn branch(&self, link: usize) -> Branch<'_> {
        let mut steps: Vec<&Step> = self.path(link).collect();
        steps.reverse();
        Branch {
            kinematics: self,
            link,
            steps,
        }
    }
}

impl Branch<'_> {
    /// Where the link is, for numbers of which it is known that there are enough.
    pub(super) fn place(&self, configuration: &[f64], place: &mut Place) {
        place.joints.clear();
        let mut pose = Isometry3::identity();
        for step in &self.steps {
            let frame = pose * step.origin;
            pose = match &step.motion {
                Motion::Fixed => frame,
                motion => frame * motion.at(configuration),
            };
            place.joints.push((frame.rotation, pose.translation.vector));
        }
        place.pose = pose;
    }

    /// The geometric Jacobian of a point of the link, given in the link's frame, metres: as
    /// [`ForwardKinematics::jacobian`], column after column of 6 numbers into `jacobian`, one for each DOF.
    ///
    /// # Errors
    /// A configuration of another length, or with a value that is not finite; or one so large that the link is out of
    /// the range of numbers.
    ///
    /// # Panics
    /// Where `jacobian` does not have 6 numbers for each DOF.
    pub fn jacobian_into(
        &self,
        configuration: &[f64],
        point: &Point3<f64>,
        place: &mut Place,
        jacobian: &mut [f64],
    ) -> Result<(), ConfigurationError> {
        self.kinematics.check(configuration)?;
        self.place(configuration, place);
        if !is_finite(&place.pose) {
            let link_idx = self.link;
            return Err(ConfigurationError::Overflow { link_idx });
        }
        let point = place.pose * point;
        jacobian.fill(0.0);
        // From the link on, as there, so that sums are the same to the bit.
        for (step, (frame, child)) in self.steps.iter().zip(&place.joints).rev() {
            columns(
                step,
                frame,
                child,
                &point,
                configuration,
                |dof, linear, angular| {
                    add_to(&mut jacobian[6 * dof..6 * dof + 6], linear, angular);
                },
            );
        }
        Ok(())
    }
}
