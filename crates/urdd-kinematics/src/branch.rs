//! The joints that move one link: all that its pose and Jacobian need.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use super::error::ConfigurationError;
use super::forward::{ForwardKinematics, Step, is_finite};
use super::jacobian::{add_to, columns};
use super::joint::Motion;

/// The joints from the root to one link.
#[derive(Debug, Clone)]
pub struct Branch<'a> {
    kinematics: &'a ForwardKinematics,
    link: usize,
    /// In order from the root.
    pub(super) steps: Vec<&'a Step>,
}

/// The pose of a branch's link; reusable for further configurations.
#[derive(Debug, Clone)]
pub struct Place {
    /// The pose of the link in the root link's frame.
    pub pose: Isometry3<f64>,
    /// For each joint, the rotation of its frame and the position of its child link.
    pub(super) joints: Vec<(UnitQuaternion<f64>, Vector3<f64>)>,
}

impl Default for Place {
    /// The identity, without joints.
    fn default() -> Self {
        Self { pose: Isometry3::identity(), joints: Vec::new() }
    }
}

impl ForwardKinematics {
    /// The joints that move a link; none for the root or a link that does not exist.
    pub fn branch(&self, link: usize) -> Branch<'_> {
        let mut steps: Vec<&Step> = self.path(link).collect();
        steps.reverse();
        Branch { kinematics: self, link, steps }
    }

    /// For each link, the link nearest to the root that no DOF moves against it: links with the same one are one body.
    pub fn rigid_bodies(&self) -> Vec<usize> {
        let mut body: Vec<usize> = (0..self.num_links()).collect();
        // Parents come before children.
        for step in &self.steps {
            if step.motion.dofs().is_empty() {
                body[step.child] = body[step.parent];
            }
        }
        body
    }

    /// The DOFs that move one of two links against the other, ascending: those of the joints between them, and those
    /// that mimic joints between them follow.
    pub fn dofs_between(&self, a: usize, b: usize) -> Vec<usize> {
        let [of_a, of_b] = [a, b].map(|link| self.path(link).collect::<Vec<_>>());
        let only = |own: &[&Step], other: &[&Step]| -> Vec<usize> {
            let is_own = |step: &&&Step| !other.iter().any(|one| one.child == step.child);
            own.iter().filter(is_own).flat_map(|step| step.motion.dofs()).copied().collect()
        };
        let mut dofs = only(&of_a, &of_b);
        dofs.extend(only(&of_b, &of_a));
        dofs.sort_unstable();
        dofs.dedup();
        dofs
    }
}

impl Branch<'_> {
    /// Computes the pose of the link. The length of `configuration` must be checked already.
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

    /// The geometric Jacobian of a point of the link, as [`ForwardKinematics::jacobian`]. The point is in the link's
    /// frame, metres. `jacobian` is column-major, 6 numbers for each DOF.
    ///
    /// # Errors
    /// If the configuration has the wrong length or a value that is not finite, or if the link's pose overflows.
    ///
    /// # Panics
    /// If `jacobian` has fewer than 6 numbers for each DOF.
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
        // From the link to the root, as in `ForwardKinematics::jacobian`, so that sums are bit-identical.
        for (step, (frame, child)) in self.steps.iter().zip(&place.joints).rev() {
            columns(step, frame, child, &point, configuration, |dof, linear, angular| {
                add_to(&mut jacobian[6 * dof..6 * dof + 6], linear, angular);
            });
        }
        Ok(())
    }
}
